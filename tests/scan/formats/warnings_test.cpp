#include "tabor/topography/warnings.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "scan/formats/sample.hpp"
#include "tabor/topography/treatment.hpp"

namespace tabor::scan {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

/// Deterministic heights without any order.
Field noise(Index ny, Index nx) {
  Field field(ny, nx);
  std::uint64_t state = 1;
  for (Index i = 0; i < field.size(); ++i) {
    state = state * 6364136223846793005u + 1442695040888963407u;  // Knuth's MMIX generator
    field.data()[i] = static_cast<double>(state >> 11) * 0x1p-53;
  }
  return field;
}

topography::Topography map_of(Field height) {
  topography::Topography map;
  map.grid = {.nx = height.cols(),
              .ny = height.rows(),
              .lx = 1e-6 * static_cast<double>(height.cols()),
              .ly = 1e-6 * static_cast<double>(height.rows())};
  map.height = std::move(height);
  return map;
}

std::string all(const topography::Topography& map) {
  std::string text;
  for (const std::string& warning : texts_of(topography::warnings(map))) text += warning + "\n";
  return text;
}

TEST(HeightQuantum, IsTheStepOfRoundedHeights) {
  const double step = 3.7e-10;
  const Field height = 1e-5 + step * (1000 * noise(50, 60)).round();
  EXPECT_NEAR(topography::height_quantum(height), step, 1e-6 * step);
}

TEST(HeightQuantum, SurvivesHolesAndGapsInTheLevels) {
  Field height = 5e-9 * (40 * noise(30, 30)).round() * 3;
  height(3, 3) = 5e-9;  // one height off the multiples of three
  height(4, 4) = test::kNaN;
  EXPECT_NEAR(topography::height_quantum(height), 5e-9, 1e-15);
}

TEST(HeightQuantum, IsZeroForContinuousAndForConstantHeights) {
  EXPECT_EQ(topography::height_quantum(1e-6 * noise(50, 60)), 0);
  EXPECT_EQ(topography::height_quantum(Field::Constant(5, 5, 2.0)), 0);
  EXPECT_EQ(topography::height_quantum(Field::Constant(5, 5, test::kNaN)), 0);
}

TEST(Warnings, CountTheSpikesThatDespikeTakes) {
  Field height = 1e-9 * noise(64, 60);
  height(10, 10) = 1e-6;
  height(30, 40) = -1e-6;
  EXPECT_EQ(all(map_of(height)),
            "The surface has 2 spikes (0.052 % of pixels), which change slopes and contact; "
            "<despike=auto> removes them\n");
}

TEST(Warnings, AnOrdinaryMapRaisesNone) { EXPECT_EQ(all(map_of(1e-6 * noise(64, 60))), ""); }

TEST(Warnings, NameTiltHolesPixelsAndSteps) {
  Field tilted = 1e-8 * noise(64, 64);
  for (Index x = 0; x < 64; ++x) tilted.col(x) += 1e-7 * static_cast<double>(x);
  EXPECT_NE(all(map_of(tilted)).find("tilt"), std::string::npos);

  Field holes = noise(64, 64);
  holes(0, 0) = test::kNaN;
  EXPECT_NE(all(map_of(holes)).find("1 of 4096 pixels is missing"), std::string::npos);

  topography::Topography oblong = map_of(noise(64, 64));
  oblong.grid.ly *= 2;
  EXPECT_NE(all(oblong).find("not square"), std::string::npos);

  EXPECT_NE(all(map_of((4 * noise(64, 64)).round())).find("steps"), std::string::npos);
}

/// A map with its warnings as a reader would leave them, then treated.
std::vector<std::string> warnings_after(const topography::Treatment& treatment,
                                        const Field& height) {
  topography::Topography map = map_of(height);
  map.warnings = topography::warnings(map);
  map.warnings.push_back({.code = "file", .text = "the unit is a guess"});
  return texts_of(topography::apply(treatment, std::move(map)).warnings);
}

TEST(Warnings, ATreatmentDispelsThoseAboutTheHeightsItMends) {
  Field height = 1e-8 * noise(64, 37);
  for (Index x = 0; x < 37; ++x) height.col(x) += 1e-7 * static_cast<double>(x);
  height(20, 20) = test::kNaN;
  EXPECT_THAT(warnings_after({}, height), ElementsAre(HasSubstr("1 of 2368 pixels is missing"),
                                                      HasSubstr("tilt"), "the unit is a guess"));
  EXPECT_THAT(warnings_after({"level=plane"}, height),
              ElementsAre("the unit is a guess", HasSubstr("1 of 2368 pixels is missing")));
  EXPECT_THAT(warnings_after({"crop=0,0,32,64", "level=plane", "fill=harmonic"}, height),
              ElementsAre("the unit is a guess"));
}

TEST(Warnings, ATreatmentRaisesNewOnes) {
  EXPECT_THAT(warnings_after({"lowpass=gauss:1mm"}, 1e-8 * noise(64, 60)),
              Contains(HasSubstr("The cutoff of gauss:1000um is longer")));
}

TEST(Warnings, SpikesAreWarnedOfUntilAStepLooksForThem) {
  Field height = 1e-9 * noise(64, 64);
  height(10, 10) = 1e-6;
  EXPECT_THAT(warnings_after({"lowpass=gauss:20um"}, height), Contains(HasSubstr("1 spike")));
  EXPECT_THAT(warnings_after({"despike=8,7,median", "lowpass=gauss:20um"}, height),
              ElementsAre("the unit is a guess", HasSubstr("despike took 1 spike")));
}

TEST(Warnings, StepsOfTheHeightStayWhereAFilterHidesThem) {
  EXPECT_THAT(warnings_after({"lowpass=gauss:8um"}, 1e-9 * (4 * noise(64, 64)).round()),
              Contains(HasSubstr("Heights come in steps of 1 nm")));
}

}  // namespace
}  // namespace tabor::scan
