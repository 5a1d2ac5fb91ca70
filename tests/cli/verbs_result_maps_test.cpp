// convert --field: maps of results, of one scan and of a study.
#include <gmock/gmock.h>

#include "run_tabor.hpp"
#include "small_ball.hpp"
#include "support/folder.hpp"
#include "tabor/io/hdf5/hdf5.hpp"
#include "tabor/io/text/csv.hpp"

namespace tabor::test {
namespace {

using testing::HasSubstr;

constexpr const char* kStudy = R"(shear_strength = "70 MPa"
[material]
youngs_modulus = "70 GPa"
poissons_ratio = 0.33
[sweep]
mean_pressure = ["5 MPa", "9 MPa"]
lubricant_density = ["0.1 g/m^2", "0.2 g/m^2"]
[[scan]]
file = "a.h5"
[[scan]]
file = "b.h5"
)";

class ResultMapsVerb : public testing::Test {
 protected:
  void SetUp() override {
    for (const auto& [name, seed] : {std::pair{"a.h5", "1"}, {"b.h5", "2"}}) {
      run({"generate", "self-affine", "--pixels", "16", "--pixel", "1um", "--rms-height", "0.2um",
           "-o", file(name), "--seed", seed});
    }
  }

  std::string file(const std::string& name) const { return folder_ / name; }

  static void run(const Words& words) {
    const Outcome outcome = run_tabor(words);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }

  /// Dry and wet friction under two pressures.
  void solve(const std::string& output) const {
    run({"friction", file("a.h5"), "--pressure", "5MPa,9MPa", "--youngs-modulus", "70GPa",
         "--poisson-ratio", "0.33", "--density", "0.1g/m^2,0.2g/m^2", "--shear-strength", "70MPa",
         "--double", "-o", file(output)});
  }

  static void expect_one_line(const Words& words, int code, const std::string& part) {
    const Outcome outcome = run_tabor(words);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_EQ(count_lines(outcome.err), 1u) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(part));
  }

  Folder folder_;
};

TEST_F(ResultMapsVerb, MakeTheDisplacementThatTheFileLeavesOut) {
  solve("f.h5");
  run({"convert", file("f.h5"), file("all.csv"), "--field", "all", "--state", "3"});
  const io::CsvTable table = io::read_csv(file("all.csv"));
  const io::Hdf5Reader reader(file("f.h5"));
  const Field height = reader.field("/surface/height"), gap = reader.field("/states/0003/gap");
  const Field pressure = reader.field("/states/0003/pressure");
  const double separation = reader.number("/states/0003", "separation_m");
  ASSERT_EQ(table.rows.size(), 256u);
  for (std::size_t i = 0; i < 256; ++i) {
    const auto at = static_cast<Index>(i);
    EXPECT_EQ(table.number(i, "pressure_Pa"), pressure.data()[at]);
    EXPECT_EQ(table.number(i, "contact"), pressure.data()[at] > 0 ? 1 : 0);
    EXPECT_NEAR(table.number(i, "displacement_m"), gap.data()[at] + height.data()[at] - separation,
                1e-20);
  }
}

TEST_F(ResultMapsVerb, TakeOneScanOfAStudyWhoseStatesAreItsRows) {
  put_bytes(folder_ / "study.toml", kStudy);
  run({"sweep", file("study.toml"), "-o", file("out")});
  expect_one_line({"convert", file("out"), file("x.npy"), "--field", "gap"}, 3,
                  "0 (a.h5), 1 (b.h5)");
  const Words first = {"convert", file("out"), file("film.vti"), "--field", "all"};
  const io::Json object = json_of([&] {
    Words words = first;
    words.insert(words.end(), {"--scan", "1", "--state", "2"});
    return words;
  }());
  EXPECT_EQ(object["maps"],
            (io::Json{"height", "gap", "film_thickness", "contact", "displacement"}));
  solve("f.h5");
  for (const char* field : {"contact", "film_thickness"}) {
    run({"convert", file("f.h5"), file("one.csv"), "--field", field, "--state", "2"});
    run({"convert", file("out/results.h5"), file("two.csv"), "--field", field, "--state", "2",
         "--scan", "0"});
    const io::CsvTable one = io::read_csv(file("one.csv")), two = io::read_csv(file("two.csv"));
    ASSERT_EQ(one.rows.size(), two.rows.size());
    for (std::size_t i = 0; i < one.rows.size(); ++i) {
      const std::string column = one.columns.back();
      EXPECT_NEAR(one.number(i, column), two.number(i, column),
                  1e-6 * std::abs(one.number(i, column)));
    }
  }
}

TEST_F(ResultMapsVerb, RejectWhatAResultDoesNotHave) {
  solve("f.h5");
  const std::string in = file("f.h5"), out = file("out.vti");
  expect_one_line({"convert", in, out, "--field", "film"}, 3, "film_thickness");
  expect_one_line({"convert", in, out, "--field", "gap", "--state", "4"}, 3, "3 (9 MPa");
  expect_one_line({"convert", in, out, "--field", "gap", "--scan", "1"}, 3, "one surface");
  expect_one_line({"convert", in, out, "--field", "gap", "--state", "x"}, 2, "number from 0");
  expect_one_line({"convert", in, out, "--field", "gap", "--level", "plane"}, 2, "leave out");
  expect_one_line({"convert", in, out, "--state", "1"}, 2, "--field");
  expect_one_line({"convert", in, file("out.x3p"), "--field", "gap"}, 3, ".vti .gwy .csv");
  expect_one_line({"convert", in, file("out.npy"), "--field", "all"}, 3, "6 maps");
  put_bytes(folder_ / "scan.txt", "1 2\n3 4\n");
  expect_one_line({"convert", file("scan.txt"), out, "--field", "gap"}, 3, "no HDF5 file");
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(ResultMapsVerb, OfAPointContactLieAboutItsCentre) {
  put_bytes(folder_ / "ball.toml", kBall);
  run({"ehl", "point", file("ball.toml"), "-o", file("ball.h5")});
  run({"convert", file("ball.h5"), file("all.csv"), "--field", "all"});
  run({"convert", file("ball.h5"), file("film.npy"), "--field", "film_thickness"});
  const io::CsvTable all = io::read_csv(file("all.csv"));
  EXPECT_EQ(all.columns, (Words{"x_m", "y_m", "film_thickness_m", "pressure_Pa"}));
  const io::Hdf5Reader reader(file("ball.h5"));
  const Field film = reader.field("/contact/film");
  const std::vector<double> x = reader.numbers("/contact/x"), y = reader.numbers("/contact/y");
  ASSERT_EQ(all.rows.size(), x.size() * y.size());
  ASSERT_LT(x.front(), 0);
  for (std::size_t i = 0; i < all.rows.size(); i += 7) {
    const std::size_t row = i / x.size(), column = i % x.size();
    EXPECT_NEAR(all.number(i, "x_m"), x[column], 1e-12 * (x[1] - x[0]) + 1e-15 * x.back());
    EXPECT_NEAR(all.number(i, "y_m"), y[row], 1e-12 * (y[1] - y[0]) + 1e-15 * y.back());
    EXPECT_EQ(all.number(i, "film_thickness_m"),
              film(static_cast<Index>(row), static_cast<Index>(column)));
  }
  expect_one_line({"convert", file("ball.h5"), file("a.vti"), "--field", "gap"}, 3,
                  "film_thickness, pressure or all");
  expect_one_line({"convert", file("ball.h5"), file("a.vti"), "--field", "all", "--state", "1"}, 3,
                  "0 (steady)");
}

TEST_F(ResultMapsVerb, ThatAResultOfCurvesLacksAreSaidWithWhatItHas) {
  run({"psd", file("a.h5"), "-o", file("psd.h5")});
  expect_one_line({"convert", file("psd.h5"), file("a.vti"), "--field", "all"}, 3,
                  "/curves/psd_radial_m4");
  expect_one_line({"convert", file("psd.h5"), file("a.vti"), "--field", "all"}, 3, "--no-html");
}

TEST_F(ResultMapsVerb, AreTakenAsTheyAreWhateverTheDefaultsOfScans) {
  solve("f.h5");
  put_bytes(folder_ / "mine.toml", "level = \"plane\"\n");
  run({"convert", file("f.h5"), file("a.vti"), "--field", "gap", "--defaults", file("mine.toml")});
  run({"convert", file("f.h5"), file("b.vti"), "--field", "gap"});
  EXPECT_EQ(bytes_of(file("a.vti")), bytes_of(file("b.vti")));
}

TEST_F(ResultMapsVerb, AreWrittenByTheVerbThatMakesThem) {
  solve("f.h5");
  solve("f.vti");
  run({"convert", file("f.h5"), file("g.vti"), "--field", "all", "--state", "all"});
  EXPECT_EQ(bytes_of(file("f.vti")), bytes_of(file("g.vti")));
  expect_one_line({"lubricate", file("a.h5"), "--density", "0.1g/m^2", "--fields", "none", "-o",
                   file("film.vti")},
                  3, "maps");
}

}  // namespace
}  // namespace tabor::test
