// tabor.toml: options that need not be typed.
#include <gmock/gmock.h>

#include "run_tabor.hpp"
#include "support/folder.hpp"

namespace tabor::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class Defaults : public testing::Test {
 protected:
  void SetUp() override {
    const Outcome made = run_tabor({"generate", "self-affine", "-o", file("scan.h5"), "--pixels",
                                    "32,24", "--pixel", "1um", "--rms-height", "0.2um"});
    ASSERT_EQ(made.code, 0) << made.err;
  }

  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  /// A call of a verb on the scan, with these defaults.
  std::vector<std::string> words(const std::string& verb, const std::string& defaults,
                                 const std::vector<std::string>& more = {}) const {
    put_bytes(folder_ / "mine.toml", defaults);
    std::vector<std::string> all{verb, file("scan.h5"), "--defaults", file("mine.toml")};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Outcome run(const std::string& verb, const std::string& defaults,
              const std::vector<std::string>& more = {}) const {
    return run_tabor(words(verb, defaults, more));
  }
  io::Json json(const std::string& verb, const std::string& defaults,
                const std::vector<std::string>& more = {}) const {
    return json_of(words(verb, defaults, more));
  }
  void expect_rejected(const std::string& verb, const std::string& defaults,
                       const std::string& where, const std::string& what) const {
    const Outcome outcome = run(verb, defaults);
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("mine.toml" + where), HasSubstr(what)));
    EXPECT_EQ(count_lines(outcome.err), 1u) << outcome.err;
  }

  Folder folder_;
};

TEST_F(Defaults, StandForOptionsThatAreNotTyped) {
  const io::Json by_file = json("contact", "material = \"aluminium-6016\"\npressure = \"7 MPa\"\n");
  const io::Json typed =
      json("contact", "", {"--material", "aluminium-6016", "--pressure", "7MPa"});
  ASSERT_TRUE(by_file.contains("states")) << by_file;
  for (const char* key : {"mean_pressure_Pa", "contact_area_fraction", "certificate"}) {
    EXPECT_EQ(by_file["states"][0][key], typed["states"][0][key]) << key;
  }
  EXPECT_EQ(by_file["saturation_pressure_Pa"], 240e6);
  EXPECT_FALSE(typed.contains("defaults"));
}

TEST_F(Defaults, AreNamedInTheResultAndOnStandardError) {
  const std::string text = "pressure = [\"2 MPa\", \"7 MPa\"]\n[contact]\nmaterial = \"glass\"\n";
  const io::Json object = json("contact", text);
  ASSERT_TRUE(object.contains("defaults")) << object;
  EXPECT_EQ(object["defaults"]["file"], file("mine.toml"));
  EXPECT_EQ(object["defaults"]["used"],
            io::Json({{"--pressure", "2 MPa,7 MPa"}, {"--material", "glass"}}));
  EXPECT_THAT(object["command"].get<std::string>(), HasSubstr("--material=glass"));
  EXPECT_THAT(run("contact", text).err, HasSubstr("mine.toml: --pressure=2 MPa,7 MPa"));
  EXPECT_THAT(run("contact", text, {"--quiet"}).err, Not(HasSubstr("mine.toml")));
}

TEST_F(Defaults, CannotSilenceTheLineThatNamesThem) {
  const std::string text = "quiet = true\npressure = \"7 MPa\"\nmaterial = \"glass\"\n";
  const std::string table = "pressure = \"7 MPa\"\n[contact]\nmaterial = \"glass\"\nquiet = true\n";
  for (const std::string& each : {text, table}) {
    EXPECT_THAT(run("contact", each).err, AllOf(HasSubstr("mine.toml: "), HasSubstr("--quiet"),
                                                HasSubstr("--material=glass")));
    EXPECT_THAT(run("contact", each, {"--quiet"}).err, Not(HasSubstr("mine.toml")));
  }
  EXPECT_EQ(run("contact", "quiet = false\n" + table).code, 0);
}

TEST_F(Defaults, ThatOverrideTheFileOfAScanAreNamedWhereItIsSaid) {
  const auto said = [&](const std::string& text, const std::vector<std::string>& more = {}) {
    std::string all;
    const io::Json object = json("params", "set = \"height\"\n" + text, more);
    for (const io::Json& warning : object["warnings"]) all += io::to_text(warning);
    return all;
  };
  const std::string all_three = "pixel = \"2um\"\nunit = \"nm\"\noverride_unit = true\n";
  EXPECT_THAT(said(all_three), AllOf(HasSubstr("2 um instead of the file's 1 um (--pixel and "
                                               "--override-unit stand in "),
                                     HasSubstr("mine.toml)")));
  EXPECT_THAT(said("pixel = \"2um\"\n", {"--override-unit"}), HasSubstr("(--pixel stands in "));
  EXPECT_THAT(said("override_unit = true\n", {"--pixel", "2um"}),
              HasSubstr("(--override-unit stands in "));
  EXPECT_THAT(said("unit = \"nm\"\n", {"--override-unit"}),
              AllOf(HasSubstr("nm instead of the file's"), HasSubstr("(--unit stands in ")));
  EXPECT_THAT(
      said("", {"--pixel", "2um", "--override-unit"}),
      AllOf(HasSubstr("2 um instead"), Not(HasSubstr("in tabor")), Not(HasSubstr("stands"))));
}

TEST_F(Defaults, GiveWayToWhatIsTyped) {
  const std::string text = "material = \"glass\"\npressure = \"7 MPa\"\n";
  EXPECT_EQ(json("contact", text, {"--pressure", "2MPa"})["states"][0]["mean_pressure_Pa"], 2e6);
  EXPECT_EQ(json("contact", text, {"--pressure=2MPa"})["states"][0]["mean_pressure_Pa"], 2e6);
  EXPECT_EQ(json("contact", text, {"--youngs-modulus", "1GPa"})["states"].size(), 1u);
}

TEST_F(Defaults, OfASolidGiveWayToAMaterialThatIsTyped) {
  const std::string text =
      "youngs_modulus = \"1 GPa\"\npoisson_ratio = 0.1\nsaturation_pressure = \"9 MPa\"\n"
      "pressure = \"2 MPa\"\n";
  const io::Json object = json("contact", text, {"--material", "aluminium-6016"});
  EXPECT_EQ(object["saturation_pressure_Pa"], 240e6) << object;
  EXPECT_NEAR(object["effective_modulus_Pa"].get<double>(), 70e9 / (1 - 0.33 * 0.33), 1);
}

TEST_F(Defaults, OfOneVerbWinAndDoNotReachOthers) {
  const std::string text =
      "material = \"aluminium-6016\"\npressure = \"7 MPa\"\n[friction]\npressure = \"2 MPa\"\n"
      "density = \"0.45 g/m^2\"\n[lubricate]\ndensity = 0.9\n";
  EXPECT_EQ(json("friction", text)["states"][0]["mean_pressure_Pa"], 2e6);
  EXPECT_EQ(json("contact", text)["states"][0]["mean_pressure_Pa"], 7e6);
}

TEST_F(Defaults, OfTreatmentActInTheOrderOfTheFile) {
  const io::Json object =
      json("params", "level = \"plane\"\ncrop = \"0,0,16,24\"\nset = \"height\"\n");
  const io::Json turned =
      json("params", "crop = \"0,0,16,24\"\nlevel = \"plane\"\nset = \"height\"\n");
  EXPECT_EQ(object["treatment"], io::Json({"level=plane", "crop=0,0,16,24"})) << object;
  EXPECT_EQ(turned["treatment"], io::Json({"crop=0,0,16,24", "level=plane"}));
}

TEST_F(Defaults, OfOptionsThatNeedAnotherWaitForIt) {
  const std::string text =
      "material = \"aluminium-6016\"\npressure = \"7 MPa\"\nshear_strength = \"70 MPa\"\n";
  EXPECT_EQ(run("contact", text).code, 0);
  EXPECT_EQ(run("contact", text, {"--shear-strength", "70MPa"}).code, 2);
}

TEST_F(Defaults, LieInTheWorkingFolder) {
  put_bytes(folder_ / "tabor.toml", "material = \"glass\"\npressure = \"7 MPa\"\n");
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder_ / "");
  const Outcome found = run_tabor({"contact", "scan.h5"});
  const Outcome none = run_tabor({"contact", "scan.h5", "--defaults", "none"});
  std::filesystem::current_path(before);
  EXPECT_EQ(found.code, 0) << found.err;
  EXPECT_THAT(found.err, HasSubstr("defaults of tabor.toml"));
  EXPECT_EQ(none.code, 2);
  EXPECT_THAT(none.err, HasSubstr("--youngs-modulus E is missing"));
}

TEST_F(Defaults, BehindALinkThatLeadsNowhereAreRejectedInOneLine) {
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder_ / "");
  for (const auto& [target, problem] :
       {std::pair("tabor.toml", "a link that leads to itself"), {"gone.toml", "no such file"}}) {
    std::filesystem::create_symlink(target, "tabor.toml");
    const Outcome outcome = run_tabor({"info", file("scan.h5")});
    std::filesystem::remove("tabor.toml");
    EXPECT_EQ(outcome.code, 3);
    EXPECT_EQ(outcome.err, std::string("tabor: tabor.toml: ") + problem + "\n");
  }
  std::filesystem::current_path(before);
}

TEST_F(Defaults, ThatAreNoneAreRejected) {
  expect_rejected("contact", "presure = \"7 MPa\"\n", ":1", "did you mean 'pressure'");
  expect_rejected("contact", "\n[contcat]\npressure = \"7 MPa\"\n", ":3", "contact.pressure");
  expect_rejected("contact", "pressure = 7\n", ":1", "7MPa");
  expect_rejected("contact", "\npressure = \"7 um\"\n", ":2", "pressure");
  expect_rejected("contact", "pressure = true\n", ":1", "number");
  expect_rejected("contact", "material = \"cheese\"\n", ":1", "cheese");
  expect_rejected("params", "override_unit = \"yes\"\n", ":1", "true or false");
  expect_rejected("contact", "pressure = \"7 MPa\"\npressure = \"8 MPa\"\n", "", "pressure");
  expect_rejected("contact", "json = true\n", ":1", "json");
  expect_rejected("contact", "output = \"x.h5\"\n", ":1", "output");
}

TEST_F(Defaults, OfAFileThatIsNotThereAreRejected) {
  const Outcome outcome =
      run_tabor({"contact", file("scan.h5"), "--defaults", file("nowhere.toml")});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("nowhere.toml"));
}

TEST_F(Defaults, AreNoneInAnEmptyFile) {
  EXPECT_EQ(run("params", "", {"--set", "height"}).code, 0);
}

}  // namespace
}  // namespace tabor::test
