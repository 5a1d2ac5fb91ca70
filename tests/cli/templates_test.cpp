// Files to start from: they have every key there is, and they work as they are printed.
#include <gmock/gmock.h>

#include <algorithm>

#include "run_tabor.hpp"
#include "support/folder.hpp"
#include "tabor/cases/ehl/program.hpp"
#include "tabor/core/text.hpp"
#include "tabor/study/study.hpp"

namespace tabor::test {
namespace {

using testing::HasSubstr;

/// Key and value of a line, commented out or not; nothing for sentences and headings.
std::string without_comment_sign(const std::string& line) {
  const std::size_t key = line.find_first_not_of("# ");
  const std::size_t end = line.find_first_of(" =", key == std::string::npos ? 0 : key);
  const bool is_key = end != std::string::npos && line.compare(end, 2, " =") == 0;
  const bool is_table = key != std::string::npos && line[key] == '[';
  return is_key || is_table ? line.substr(key) : line;
}

class Templates : public testing::Test {
 protected:
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  /// The scan that the study's template names.
  void make_scan() const {
    std::filesystem::create_directory(folder_ / "surfaces");
    const Outcome made = run_tabor({"generate", "self-affine", "-o", file("edt.h5"), "--pixels",
                                    "32,24", "--pixel", "1um", "--rms-height", "1um"});
    ASSERT_EQ(made.code, 0) << made.err;
    ASSERT_EQ(run_tabor({"convert", file("edt.h5"), file("surfaces/edt_before.x3p")}).code, 0);
  }

  Folder folder_;
};

TEST_F(Templates, OfAStudyRuns) {
  make_scan();
  const Outcome printed = run_tabor({"sweep", "--template"});
  ASSERT_EQ(printed.code, 0) << printed.err;
  put_bytes(folder_ / "study.toml", printed.out);
  const io::Json done = json_of({"sweep", file("study.toml"), "-o", file("results")});
  EXPECT_EQ(done.value("n_done", 0), 6) << done;
}

/// The template of a study with all keys in force but for those that begin so.
std::string template_without(const std::vector<std::string>& left_out) {
  std::string text;
  for (const std::string& line : split(study::study_template(), '\n')) {
    const std::string bare = without_comment_sign(line);
    const bool is_left_out =
        std::any_of(left_out.begin(), left_out.end(),
                    [&](const std::string& key) { return bare.starts_with(key); });
    text += (is_left_out ? line : bare) + '\n';
  }
  return text;
}

TEST_F(Templates, OfAStudyHasEveryKeyWithAValueThatIsTaken) {
  make_scan();
  const std::string text = template_without(
      {"boundary_shear_share", "tool", "trapped", "bulk_modulus", "dry_below", "distance", "step",
       "every", "displaced", "reach", "wear_coefficient", "hardening", "liquid", "until_steady"});
  put_bytes(folder_ / "study.toml", text);
  put_bytes(folder_ / "measured.csv", "mean_pressure_Pa,friction\n7e6,0.2\n");
  const study::Study study = study::read_study(folder_ / "study.toml");
  EXPECT_TRUE(study.flows());
  EXPECT_TRUE(study.experiment.has_value());
  put_bytes(folder_ / "rough.toml",  // a tool, trapped oil and sliding exclude oil that flows
            template_without({"boundary_shear_share", "fluid", "viscosity", "pressure_viscosity",
                              "eyring_stress", "sliding_speed"}));
  const study::Study rough = study::read_study(folder_ / "rough.toml");
  EXPECT_TRUE(rough.settings.contact.tool.is_rough() && rough.settings.trapped.is_asked());
  EXPECT_TRUE(rough.slide && rough.slide->until_steady);
  for (const std::string& key : study::known_keys()) {
    const std::string word = key.substr(key.find_last_of('.') + 1);
    EXPECT_THAT(text, HasSubstr(word + " =")) << key;
  }
}

TEST_F(Templates, OfEveryProgramRun) {
  for (const ehl::Program& program : ehl::programs()) {
    const Outcome printed = run_tabor({"ehl", program.name, "--template"});
    ASSERT_EQ(printed.code, 0) << printed.err;
    EXPECT_EQ(printed.out, case_template(program));
    put_bytes(folder_ / "case.toml", printed.out);
    const io::Json done = json_of({"ehl", program.name, file("case.toml"), "--quiet"});
    EXPECT_EQ(done.value("converged", false), true) << program.name << '\n' << done;
  }
}

TEST_F(Templates, OfEveryProgramHaveEveryKey) {
  for (const ehl::Program& program : ehl::programs()) {
    std::string keys;
    std::string section;
    for (const std::string& line : split(case_template(program), '\n')) {
      const std::string bare = without_comment_sign(line);
      if (bare.starts_with('[')) section = bare.substr(1, bare.size() - 2);
      keys += '<' + section + '.' + bare.substr(0, bare.find(" =")) + '>';
    }
    for (const ParameterHead& key : program.keys) {
      EXPECT_THAT(keys, HasSubstr('<' + key.name + '>')) << program.name;
    }
  }
}

TEST(Template, OfAProgramThatIsNoneNamesTheNearest) {
  const Outcome outcome = run_tabor({"ehl", "pont", "--template"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("did you mean 'point'"));
}

TEST(Template, IsNamedWhereAFileIsMissing) {
  const Outcome outcome = run_tabor({"sweep"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--template"));
}

}  // namespace
}  // namespace tabor::test
