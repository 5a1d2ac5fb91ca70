#include "tabor/study/experiment.hpp"

#include <cmath>

#include "study/example_study.hpp"

namespace tabor::study {
namespace {

using test::Folder;
using test::message_of;
using testing::ElementsAre;
using testing::HasSubstr;

Experiment read(const std::string& text) {
  const Folder folder;
  test::put_bytes(folder / "measured.csv", text);
  return read_experiment(folder / "measured.csv");
}

TEST(ReadExperiment, TakesUnitsFromTheHeaderOrFromTheCells) {
  const Experiment header =
      read("mean_pressure_MPa,friction,error,lubricant_density_g_per_m2\n2,0.3,0.02,0.5\n");
  EXPECT_THAT(header.mean_pressure, ElementsAre(2e6));
  EXPECT_THAT(header.friction, ElementsAre(0.3));
  EXPECT_THAT(header.error, ElementsAre(0.02));
  EXPECT_THAT(header.lubricant_density, ElementsAre(0.5e-3));
  const Experiment cells = read("mean_pressure,friction\n2 MPa,0.3\n5000 kPa,0.2\n");
  EXPECT_THAT(cells.mean_pressure, ElementsAre(2e6, 5e6));
  EXPECT_TRUE(std::isnan(cells.error[0]));
  EXPECT_TRUE(std::isnan(cells.lubricant_density[1]));
}

TEST(ReadExperiment, NamesLineAndColumnOfAMistake) {
  EXPECT_THAT(message_of([] { read("mean_pressure,friction\n2 MPa,0.3\n5,0.2\n"); }),
              HasSubstr("measured.csv:3: mean_pressure"));
  EXPECT_THAT(message_of([] { read("mean_pressure_Pa,friction\n2e6,low\n"); }),
              HasSubstr("measured.csv:2: column friction"));
  EXPECT_THAT(message_of([] { read("friction\n0.2\n"); }), HasSubstr("mean_pressure"));
  EXPECT_THAT(message_of([] { read("mean_pressure_Pa\n2e6\n"); }), HasSubstr("friction"));
  EXPECT_THAT(message_of([] { read("mean_pressure_Pa,friction,mu\n2e6,1,1\n"); }),
              HasSubstr("unknown column 'mu'"));
  EXPECT_THAT(message_of([] { read("mean_pressure_Pa,friction\n-2,0.3\n"); }),
              HasSubstr("measured.csv:2"));
}

}  // namespace
}  // namespace tabor::study
