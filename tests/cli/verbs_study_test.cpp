// sweep on two small generated surfaces.
#include <gmock/gmock.h>

#include <filesystem>
#include <limits>

#include "run_tabor.hpp"
#include "support/folder.hpp"
#include "tabor/core/text.hpp"
#include "tabor/io/text/csv.hpp"
#include "tabor/scan/file.hpp"

namespace tabor::test {
namespace {

using testing::HasSubstr;

class StudyVerbs : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* seed : {"1", "2"}) {
      const Outcome made =
          run_tabor({"generate", "edt", "-o", file(std::string(seed) + ".h5"), "--pixels", "32",
                     "--pixel", "4um", "--seed", seed, "--plateau-roughness", "80nm"});
      ASSERT_EQ(made.code, 0) << made.err;
    }
    put_bytes(folder_ / "study.toml",
              "shear_strength = \"70 MPa\"\n"
              "[material]\nyoungs_modulus = \"70 GPa\"\npoissons_ratio = 0.33\n"
              "saturation_pressure = \"240 MPa\"\n"
              "[treatment]\nsteps = [\"level=plane\"]\n"
              "[sweep]\nmean_pressure = [\"2 MPa\", \"7 MPa\"]\n"
              "lubricant_density = [\"0.9 g/m^2\"]\n"
              "[[scan]]\nfile = \"[12].h5\"\ngroup = \"before\"\n");
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::vector<std::string> sweep() const {
    return {"sweep", file("study.toml"), "-o", file("out")};
  }

  Folder folder_;
};

TEST_F(StudyVerbs, SweepSaysWhatItDidAndAverages) {
  const io::Json result = json_of(sweep());
  EXPECT_EQ(result.at("n_cases"), 4);
  EXPECT_EQ(result.at("n_done"), 4);
  EXPECT_EQ(result.at("n_computed_contacts"), 4);
  const io::Json& averages = result.at("averages");
  ASSERT_EQ(averages.size(), 2u);
  EXPECT_EQ(averages.at(0).at("group"), "before");
  EXPECT_EQ(averages.at(0).at("n"), 2);
  EXPECT_GT(averages.at(0).at("friction_dry_mean").get<double>(), 0.29);
}

TEST_F(StudyVerbs, TheTableHasThePlacesOfAToolAndTrappedOil) {
  const std::string plain = run_tabor(sweep()).out;
  EXPECT_THAT(plain, testing::Not(HasSubstr("places")));
  put_bytes(folder_ / "tool.toml",
            bytes_of(folder_ / "study.toml") +
                "[lubricant]\ntrapped = true\n"
                "[contact]\ntool = \"ground:Sa=0.1um,groove-length=20um\"\ntool_places = 2\n");
  const Outcome outcome = run_tabor({"sweep", file("tool.toml"), "-o", file("with_tool")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, testing::ContainsRegex("trapped oil carries +dry, places +wet, places"));
  EXPECT_THAT(outcome.out, testing::ContainsRegex("[0-9] ± [0-9.e-]+ % +± 0"));
  EXPECT_THAT(outcome.out, HasSubstr("of places: over the places of the tool."));
}

TEST_F(StudyVerbs, SweepAgainComputesNothing) {
  run_tabor(sweep());
  const io::Json again = json_of(sweep());
  EXPECT_EQ(again.at("n_done"), 4);
  EXPECT_EQ(again.at("n_computed_contacts"), 0);
}

TEST_F(StudyVerbs, SweepTableShowsMeanAndDeviation) {
  const Outcome outcome = run_tabor(sweep());
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, testing::AllOf(HasSubstr("±"), HasSubstr("4 of 4 done")));
}

TEST_F(StudyVerbs, SetTakesThePlaceOfAValueInTheFile) {
  std::vector<std::string> words = sweep();
  words.insert(words.end(),
               {"--set", "sweep.mean_pressure=3MPa", "--set", "material.saturation_pressure=none"});
  const io::Json result = json_of(words);
  ASSERT_EQ(result.at("averages").size(), 1u);
  EXPECT_EQ(result.at("averages").at(0).at("mean_pressure_Pa"), 3e6);
  words.back() = "material.saturation_pressure";
  const Outcome wrong = run_tabor(words);
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.err,
              HasSubstr("--set: got 'material.saturation_pressure'; expected KEY=VALUE"));
}

TEST_F(StudyVerbs, SweepTableMarksWhatAFrictionTableLeavesOut) {
  const auto shown_with = [&](const std::string& densities) {
    std::string text = bytes_of(folder_ / "study.toml");
    const std::string listed = text.substr(text.find("lubricant_density"));
    put_bytes(folder_ / "study.toml", text.replace(text.find(listed), listed.find('\n'),
                                                   "lubricant_density = " + densities));
    return run_tabor(sweep()).out;
  };
  EXPECT_THAT(shown_with("[\"0 g/m^2\", \"0.05 g/m^2\"]"),
              testing::Not(HasSubstr("'tabor table' leaves out")));
  const std::string shown = shown_with("[\"0.05 g/m^2\", \"20 g/m^2\"]");
  EXPECT_THAT(shown, testing::AllOf(HasSubstr("'tabor table' leaves out\n"), HasSubstr("flood\n")));
}

/// A line that is read once is short; what a program reads is whole.
TEST_F(StudyVerbs, FailuresAreLinesOfAtMost160Characters) {
  const std::string way = std::string(100, 'a') + "/" + std::string(60, 'b');
  std::filesystem::create_directories(folder_ / way);
  for (const char* name : {"c", "d"}) {
    std::filesystem::create_directories(folder_ / way / name);
    auto scan = scan::read(file("1.h5"));
    scan.height(3, 4) = std::numeric_limits<double>::quiet_NaN();
    scan::write(scan, folder_ / way / name / "holed.h5");
  }
  put_bytes(folder_ / "study.toml", bytes_of(folder_ / "study.toml") + "[[scan]]\nfile = \"" + way +
                                        "/?/holed.h5\"\ngroup = \"holed\"\n");
  const Outcome outcome = run_tabor(sweep());
  EXPECT_EQ(outcome.code, 3);
  for (const std::string& line : split(outcome.err, '\n')) EXPECT_LE(line.size(), 160u) << line;
  for (const char* name : {"c", "d"}) {
    EXPECT_THAT(outcome.err, HasSubstr(std::string("warning: failed: ") + name + "/holed.h5"));
  }
  const io::Json result = json_of(sweep());
  for (const io::Json& whole : {result.at("failures").at(0), result.at("warnings").back()}) {
    EXPECT_THAT(whole.get<std::string>(), testing::AllOf(HasSubstr(way), HasSubstr("missing")));
  }
}

TEST_F(StudyVerbs, SeedOfTheCommandLineWinsOverTheStudys) {
  std::vector<std::string> words = sweep();
  run_tabor(words);
  words.insert(words.end(), {"--seed", "7"});
  EXPECT_EQ(json_of(words).at("n_computed_films"), 2);
}

TEST_F(StudyVerbs, BadShardIsAUsageError) {
  std::vector<std::string> words = sweep();
  words.insert(words.end(), {"--shard", "3/2"});
  EXPECT_EQ(run_tabor(words).code, 2);
}

TEST_F(StudyVerbs, CiteKnowsWhatAStudyUsed) {
  ASSERT_EQ(run_tabor(sweep()).code, 0);
  const io::Json entries = json_of({"cite", file("out/results.h5")}).at("bibtex");
  for (const char* key : {"almqvist2007", "costagliola2021", "yastrebov2017"}) {
    EXPECT_TRUE(entries.contains(key)) << key;
  }
  EXPECT_FALSE(entries.contains("barnes2021"));
}

TEST_F(StudyVerbs, SweepLetsTheOilFlow) {
  const std::string text = bytes_of(folder_ / "study.toml");
  const std::string flow =
      "sliding_speed = [\"10 mm/s\", \"100 mm/s\"]\n"
      "[lubricant]\nfluid = \"reynolds\"\nviscosity = \"0.2 Pa s\"\n";
  put_bytes(folder_ / "study.toml", std::string(text).insert(text.find("[[scan]]"), flow));
  const io::Json result = json_of(sweep());
  EXPECT_EQ(result.at("n_cases"), 8);
  EXPECT_EQ(result.at("n_computed_fluids"), 8);
  const io::Json& averages = result.at("averages");
  ASSERT_EQ(averages.size(), 4u);
  EXPECT_EQ(averages.at(1).at("sliding_speed_m_per_s"), 0.1);
  for (const char* key : {"friction_mixed_mean", "friction_viscous_std", "fluid_load_share_sem"}) {
    EXPECT_TRUE(averages.at(1).at(key).is_number()) << key;
  }
  EXPECT_THAT(run_tabor(sweep()).out,
              testing::AllOf(HasSubstr("friction mixed"), HasSubstr("100 mm/s")));
  EXPECT_TRUE(json_of({"cite", file("out/results.h5")}).at("bibtex").contains("elrod1981"));

  // One scan and state by the verb for one state: the same code, from maps of full precision.
  const io::Json state = json_of({"friction",
                                  file("1.h5"),
                                  "--level",
                                  "plane",
                                  "--pressure",
                                  "2MPa",
                                  "--youngs-modulus",
                                  "70GPa",
                                  "--poisson-ratio",
                                  "0.33",
                                  "--saturation-pressure",
                                  "240MPa",
                                  "--density",
                                  "0.9g/m^2",
                                  "--shear-strength",
                                  "70MPa",
                                  "--fluid",
                                  "reynolds",
                                  "--speed",
                                  "100mm/s",
                                  "--viscosity",
                                  "0.2Pa*s"})
                             .at("states")
                             .at(0);
  const io::CsvTable table = io::read_csv(folder_ / "out" / "results.csv");
  for (const char* key : {"friction_mixed", "friction_viscous", "fluid_load_share"}) {
    const double expected = state.at(key).get<double>();
    EXPECT_NEAR(table.number(1, key), expected, 2e-3 * expected) << key;
  }
}

TEST_F(StudyVerbs, FlowThatMakesNoSenseIsBadInput) {
  const std::string text = bytes_of(folder_ / "study.toml");
  const auto code_with = [&](const std::string& lines) {
    put_bytes(folder_ / "study.toml", std::string(text).insert(text.find("[[scan]]"), lines));
    return run_tabor(sweep()).code;
  };
  const std::string speed = "sliding_speed = \"1 m/s\"\n";
  const std::string oil = "[lubricant]\nfluid = \"reynolds\"\n";
  const std::string viscosity = "viscosity = \"0.2 Pa s\"\n";
  EXPECT_EQ(code_with(speed), 3);
  EXPECT_EQ(code_with(speed + oil), 3);
  EXPECT_EQ(code_with(oil + viscosity), 3);
  EXPECT_EQ(code_with("sliding_speed = \"-1 m/s\"\n" + oil + viscosity), 3);
  EXPECT_EQ(code_with(speed + "[lubricant]\nfluid = \"stokes\"\n" + viscosity), 3);
  EXPECT_EQ(code_with(speed + oil + viscosity + "[contact]\nboundary = \"free\"\n"), 3);
}

TEST_F(StudyVerbs, TakesARangeOfPressures) {
  std::string text = bytes_of(folder_ / "study.toml");
  const std::string listed = "[\"2 MPa\", \"7 MPa\"]";
  put_bytes(folder_ / "study.toml",
            text.replace(text.find(listed), listed.size(), "\"2 MPa..7 MPa:2\""));
  EXPECT_EQ(json_of(sweep()).at("n_cases"), 4);
}

TEST_F(StudyVerbs, AMaterialWithoutShearStrengthIsNamed) {
  std::string text = bytes_of(folder_ / "study.toml");
  text.replace(0, text.find("[material]"), "");
  put_bytes(folder_ / "study.toml", text.insert(text.find("youngs"), "name = \"steel-100cr6\"\n"));
  const Outcome outcome = run_tabor(sweep());
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err,
              HasSubstr("steel-100cr6 has no shear strength in the library; add shear_strength"));
}

TEST_F(StudyVerbs, AResultInPlaceOfAStudyIsNamedAsSuch) {
  const Outcome outcome = run_tabor({"sweep", file("1.h5")});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, testing::AllOf(HasSubstr("got a binary file"), HasSubstr("TOML"),
                                          HasSubstr("tabor report")));
  EXPECT_EQ(run_tabor({"ehl", "impact", file("1.h5")}).err.find("parse"), std::string::npos);
}

TEST_F(StudyVerbs, MissingStudyIsBadInput) {
  EXPECT_EQ(run_tabor({"sweep", file("absent.toml")}).code, 3);
}

}  // namespace
}  // namespace tabor::test
