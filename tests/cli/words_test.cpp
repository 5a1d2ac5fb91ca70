// What the program makes of its words before a verb runs.
#include <gmock/gmock.h>

#include "run_tabor.hpp"

namespace tabor::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(Words, NoneGreetOnStandardOutput) {
  const Outcome outcome = run_tabor({});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("tabor info SCAN"), HasSubstr("tabor --help")));
}

TEST(Words, UnknownVerbNamesTheNearest) {
  const Outcome outcome = run_tabor({"contcat"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("did you mean 'contact'"));
  EXPECT_EQ(count_lines(outcome.err), 1u);
}

TEST(Words, OptionsBeforeTheVerbAreExplained) {
  const Outcome outcome = run_tabor({"--json", "info", "scan.x3p"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("before the verb"));
}

TEST(Words, VersionAndHelpGoToStandardOutput) {
  const std::string version = run_tabor({"--version"}).out;
  EXPECT_THAT(version, testing::StartsWith("tabor "));
  EXPECT_EQ(run_tabor({"-V"}).out, version);
  EXPECT_EQ(run_tabor({"contact", "--version"}).out, version);
  EXPECT_EQ(run_tabor({"contact", "absent.h5", "-V"}).out, version);
  EXPECT_THAT(run_tabor({"--help"}).out, HasSubstr("Exit codes"));
  EXPECT_EQ(run_tabor({"help", "contact"}).out, run_tabor({"contact", "--help"}).out);
}

TEST(Words, EveryDimensionalOptionWithoutUnitIsAUsageErrorWithTheCorrectedForm) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"contact", "s", "--youngs-modulus", "70GPa", "--poisson-ratio", "0.3", "--pressure", "7"},
       "--pressure 7MPa"},
      {{"contact", "s", "--youngs-modulus", "70", "--poisson-ratio", "0.3", "--pressure", "7MPa"},
       "--youngs-modulus 70GPa"},
      {{"lubricate", "s", "--density", "0.45"}, "--density 0.45g/m^2"},
      {{"info", "s", "--pixel", "0.67"}, "--pixel 0.67um"},
      {{"generate", "sphere", "-o", "x.h5", "--radius", "3"}, "--radius 3um"},
  };
  for (const auto& [words, correction] : cases) {
    const Outcome outcome = run_tabor(words);
    EXPECT_EQ(outcome.code, 2) << words.front();
    EXPECT_THAT(outcome.err, HasSubstr(correction));
    EXPECT_EQ(count_lines(outcome.err), 1u);
  }
}

TEST(Words, WrongAndMixedUnitsAreUsageErrors) {
  for (const char* pressure : {"7um", "7MPa,8", "7MPa,8um", "7 Mega", "MPa", ",", ""}) {
    const Outcome outcome = run_tabor({"contact", "s", "--pressure", pressure, "--youngs-modulus",
                                       "70GPa", "--poisson-ratio", "0.3"});
    EXPECT_EQ(outcome.code, 2) << pressure;
    EXPECT_THAT(outcome.err, HasSubstr("--pressure")) << pressure;
  }
}

TEST(Words, UnknownTreatmentNamesTheNearest) {
  const Outcome outcome = run_tabor({"params", "scan.x3p", "--level", "plaen"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("plane"));
}

}  // namespace
}  // namespace tabor::test
