// tabor slide: keys of its JSON object, its spellings, and what it rejects.
#include <gmock/gmock.h>

#include <filesystem>

#include "run_tabor.hpp"
#include "support/folder.hpp"

namespace tabor::test {
namespace {

using testing::HasSubstr;

class SlideVerb : public testing::Test {
 protected:
  void SetUp() override {
    const Outcome made = run_tabor({"generate", "self-affine", "-o", scan(), "--pixels", "48",
                                    "--pixel", "1um", "--rms-height", "0.5um"});
    ASSERT_EQ(made.code, 0) << made.err;
  }
  std::string scan() const { return (folder_ / "scan.h5").string(); }
  Words words(const Words& options) const {
    return Words{"slide",      scan(),  "--material", "aluminium-6016",
                 "--pressure", "10MPa", "--tool",     "ground:Sa=0.1um,groove-length=20um"} +
           options;
  }

  Folder folder_;
};

const Words kShort{"--distance", "4um", "--step", "1um"};

TEST_F(SlideVerb, HasTheKeysThatScriptsRelyOn) {
  const io::Json found = json_of(words(kShort + Words{"--density", "0.2g/m^2"}));
  for (const char* key : {"source", "x_m", "length_m", "rms_height_m"}) {
    EXPECT_TRUE(found.at("tool").contains(key)) << key;
  }
  EXPECT_EQ(found.at("steps"), 4);
  EXPECT_DOUBLE_EQ(found.at("step_m").get<double>(), 1e-6);
  EXPECT_EQ(found.at("converged"), true);
  EXPECT_TRUE(found.at("steady").is_null());
  const io::Json& last = found.at("states").back();
  for (const char* key :
       {"distance_m", "contact_area_fraction", "contact_area_fraction_pixels",
        "saturated_area_fraction", "friction_dry", "friction_ploughing", "friction_ploughing_lower",
        "friction_ploughing_upper", "step_certificate", "friction_lubricated",
        "friction_lubricated_squeezed", "moved_volume_m3_per_m2", "lost_volume_m3_per_m2",
        "rms_height_m", "mean_roughness_m", "certificate"}) {
    EXPECT_TRUE(last.at(key).is_number()) << key;
  }
  EXPECT_EQ(found.at("states").front().at("distance_m"), 0);
}

TEST_F(SlideVerb, TakesArchardsLawAsAFateOfMaterial) {
  const io::Json worn = json_of(words(kShort + Words{"--displaced", "archard:1e-12m^2/N"}));
  const io::Json expected = json_of(words(kShort + Words{"--wear-coefficient", "1e-12m^2/N"}));
  EXPECT_EQ(worn.at("states"), expected.at("states"));
  EXPECT_GT(worn.at("states").back().at("worn_volume_m3_per_m2").get<double>(), 0);
  const Outcome wrong = run_tabor(words(kShort + Words{"--displaced", "archard:3"}));
  EXPECT_EQ(wrong.code, run_tabor(words(kShort + Words{"--wear-coefficient", "3"})).code);
  EXPECT_THAT(wrong.err, HasSubstr("archard"));
  const Outcome other = run_tabor(words(kShort + Words{"--displaced", "archard"}));
  EXPECT_EQ(other.code, wrong.code);
  EXPECT_THAT(other.err, HasSubstr("near, uniform, lost or archard:K"));
}

TEST_F(SlideVerb, EndsOnceItIsSteady) {
  Words until = words({"--until-steady", "--step", "8um"});
  until[7] = "ground:Sa=0.1um,groove-length=1m,length=48um";  // smooth along x
  const io::Json found = json_of(until);
  EXPECT_EQ(found.at("steady"), true);
  EXPECT_THAT(run_tabor(words({"--step", "1um"})).err, HasSubstr("--until-steady"));
}

TEST_F(SlideVerb, WritesStatesSpectraAndTheSheet) {
  const std::string file = (folder_ / "out.h5").string();
  const std::string after = (folder_ / "after.npy").string();
  const Outcome done = run_tabor(words(kShort + Words{"-o", file, "--after", after}));
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_TRUE(std::filesystem::exists(after));
  const Outcome map = run_tabor(
      {"convert", file, (folder_ / "sheet.npy").string(), "--field", "sheet", "--state", "4"});
  EXPECT_EQ(map.code, 0) << map.err;
  EXPECT_THAT(run_tabor({"cite", file}).out, HasSubstr("goddard1962"));
}

TEST_F(SlideVerb, SaysWhereItEndedIfThatIsAnotherPlace) {
  const Outcome whole = run_tabor(words(kShort));
  EXPECT_THAT(whole.out, HasSubstr("4 steps of 1 µm, displaced"));
  const Outcome part = run_tabor(words({"--distance", "3.4um", "--step", "2um"}));
  EXPECT_THAT(part.out, HasSubstr("1 step of 2 µm and one of 1 µm to 3 µm (whole pixels)"));
  const Outcome one = run_tabor(words({"--distance", "1um", "--step", "1um"}));
  EXPECT_THAT(one.out, HasSubstr("1 step of 1 µm"));
}

TEST_F(SlideVerb, RejectsAFateOfOilWithoutOil) {
  const Outcome outcome = run_tabor(words(kShort + Words{"--liquid", "kept"}));
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--liquid needs oil; give --density"));
}

TEST_F(SlideVerb, ProposesAWearCoefficientAsItTakesIt) {
  const Outcome bare = run_tabor(words(kShort + Words{"--displaced", "archard:1e-15"}));
  EXPECT_EQ(bare.code, 2);
  EXPECT_THAT(bare.err, HasSubstr("write archard:1e-15/Pa"));
  EXPECT_EQ(run_tabor(words(kShort + Words{"--displaced", "archard:1e-15/Pa"})).code, 0);
}

}  // namespace
}  // namespace tabor::test
