#include "tabor/study/ehl_warnings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tabor::study {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

ehl::CaseResult warning(const std::vector<std::string>& texts) {
  return {.converged = true, .warnings = texts};
}

TEST(WithoutNumbers, IsTheSameForWarningsOfOneKind) {
  EXPECT_EQ(without_numbers("sheared at 31.2 GPa, 12 % of it"),
            without_numbers("sheared at 800 kPa, 1.3e+02 % of it"));
  EXPECT_EQ(without_numbers("(5 um) wide"), without_numbers("(12.5 nm) wide"));
  EXPECT_NE(without_numbers("sheared at 3 GPa"), without_numbers("pressed at 3 GPa"));
  EXPECT_NE(without_numbers("a metre"), without_numbers("a second"));  // no number before it
}

TEST(GatherWarnings, SaysEachKindOnceWithItsCases) {
  const EhlWarnings warnings =
      gather_warnings({warning({"hot at 3 K", "thin"}), warning({}),
                       warning({"hot at 40 mK", "thin"}), warning({"thin"})},
                      {.key = "a.b", .values = {"1 m", "2 m", "3 m", "4 m"}});
  EXPECT_THAT(warnings.lines,
              ElementsAre("[a] 2 of 4 cases (a.b = 1 m, 3 m), the first: hot at 3 K",
                          "[b] 3 of 4 cases (a.b = 1 m, 3 m, 4 m): thin"));
  EXPECT_THAT(warnings.marks, ElementsAre("a b", "", "a b", "b"));
}

TEST(GatherWarnings, CountsACaseOnceAndShortensLongLists) {
  std::vector<ehl::CaseResult> answers(12, warning({"grid of 3", "grid of 4"}));
  EhlCaseNames names{.key = "n", .values = {}};
  for (int i = 0; i < 12; ++i) names.values.push_back(std::to_string(i));
  EXPECT_THAT(gather_warnings(answers, names).lines,
              ElementsAre("[a] all 12 cases, the first: grid of 3"));
  answers.front().warnings.clear();
  EXPECT_THAT(gather_warnings(answers, names).lines.front(),
              HasSubstr("11 of 12 cases (n = 1, 2, 3, 4, 5, 6, 7, 8 and 3 more)"));
}

TEST(GatherWarnings, LumpsCasesThatMakeNoSense) {
  ehl::CaseResult rejected = warning({"rejected: too thick"});
  rejected.scalars["refused"] = "too thick";
  ehl::CaseResult other = warning({"rejected: too hot"});
  other.scalars["refused"] = "too hot";
  EXPECT_THAT(
      gather_warnings({warning({}), rejected, other}, {.key = "a", .values = {"1", "2", "3"}})
          .lines,
      ElementsAre("[a] 2 of 3 cases are invalid, the first: too thick (a = 2, 3)"));
}

TEST(GatherWarnings, HasMarksBeyondTheAlphabet) {
  std::vector<std::string> texts;
  for (int i = 0; i < 30; ++i) {
    texts.push_back("kind " + std::string(static_cast<std::size_t>(i), 'x'));
  }
  const EhlWarnings warnings = gather_warnings({warning(texts)}, {.key = "a", .values = {"1"}});
  EXPECT_THAT(warnings.lines[25], HasSubstr("[z] "));
  EXPECT_THAT(warnings.lines[26], HasSubstr("[a1] "));
}

}  // namespace
}  // namespace tabor::study
