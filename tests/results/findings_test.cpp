#include "tabor/results/findings.hpp"

#include <gmock/gmock.h>

namespace tabor::results {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Warning spill(double share) {
  return {"spill-over", "spill-over " + std::to_string(static_cast<int>(100 * share)) + " %",
          share};
}

/// Scans x pressures x densities, each case with the warnings that `warn` gives it.
template <typename Warn>
std::vector<Case> grid_of(const Warn& warn) {
  std::vector<Case> cases;
  for (const char* scan : {"a", "b"}) {
    for (const char* pressure : {"2 MPa", "7 MPa"}) {
      for (const char* density : {"1 g/m^2", "5 g/m^2"}) {
        Case one{.surface = scan, .pressure = pressure, .density = density};
        one.warnings = warn(one);
        cases.push_back(one);
      }
    }
  }
  return cases;
}

TEST(Findings, SayEachReasonOnceWithTheCasesItIsAbout) {
  const auto found = findings_of(grid_of([](const Case& one) {
    Warnings list;
    if (one.surface == "b") list.push_back({"not-periodic", "edges"});
    if (one.pressure == "7 MPa") list.push_back({"resolution", "small patches"});
    if (one.density == "5 g/m^2") list.push_back({"flood", "under oil"});
    return list;
  }));
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].code, "not-periodic");
  EXPECT_THAT(found[0].cases, ElementsAre("b"));
  EXPECT_EQ(found[0].n_cases, 4u);
  EXPECT_THAT(found[1].cases, ElementsAre("a 7 MPa", "b 7 MPa"));
  EXPECT_THAT(found[2].cases, ElementsAre("a 5 g/m^2", "b 5 g/m^2"));
  EXPECT_EQ(line_of(found[1]), "small patches (4 of 8 cases: a 7 MPa, b 7 MPa) [resolution]");
}

TEST(Findings, ShowTheWorstCase) {
  const auto found = findings_of({{.pressure = "2 MPa", .warnings = {spill(0.2)}},
                                  {.pressure = "5 MPa", .warnings = {spill(0.7)}},
                                  {.pressure = "7 MPa", .warnings = {spill(0.4)}},
                                  {.pressure = "9 MPa", .warnings = {}}});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(line_of(found[0]),
            "spill-over 70 % (3 of 4 cases, the worst shown: 5 MPa, 7 MPa, 2 MPa) [spill-over]");
}

TEST(Findings, SayDoubtsBeforeInformation) {
  const auto found = findings_of({{.warnings = {{"despiked", "3 spikes"},
                                                {"slow-size", "slow"},
                                                spill(0.2),
                                                {"clamp", "clamp"},
                                                {"spikes", "2 spikes"}}}});
  std::vector<std::string> codes;
  for (const Finding& one : found) codes.push_back(one.code);
  EXPECT_THAT(codes, ElementsAre("spikes", "clamp", "spill-over", "despiked", "slow-size"));
  EXPECT_EQ(found.front().kind(), cases::Class::doubt);
  EXPECT_EQ(found.back().kind(), cases::Class::information);
}

TEST(Findings, FitTheirLineHoweverManyCasesAndHoweverLongTheText) {
  const std::string text = "a sentence that " + std::string(90, 'x') + " goes on; and on";
  for (const std::size_t n_cases : {1u, 2u, 3u, 9u, 1000u}) {
    for (const std::size_t n_letters : {1u, 30u, 400u}) {
      std::vector<Case> cases;
      for (std::size_t i = 0; i < n_cases; ++i) {
        cases.push_back({.surface = std::to_string(i) + std::string(n_letters, 's')});
        if (i != 1) cases.back().warnings = {{"clamp", text + std::to_string(i), double(i)}};
      }
      const std::string line = line_of(findings_of(cases)[0]);
      EXPECT_LE(line.size(), kLineLimit) << line;
      EXPECT_THAT(line,
                  testing::AllOf(testing::StartsWith("a sentence"), testing::EndsWith(" [clamp]")));
    }
  }
  EXPECT_EQ(shortened("one two three", 13), "one two three");
  EXPECT_EQ(shortened("one two three", 12), "one two ...");
  EXPECT_EQ(shortened("got 0 'a', 1 'b', 2 'c'; choose one", 33),
            "got 0 'a', 1 'b', ...; choose one");
  EXPECT_EQ(shortened("got no value; a remedy longer than that", 20), "got no value; a ...");
}

TEST(Findings, FitTextsWithoutFoldersFirst) {
  const std::string text = "failed: /data/long/way/before/a.gsf 2 N/m^2 at 1.5 mm/s: no height";
  EXPECT_EQ(fitted(text, 100), text);
  EXPECT_EQ(fitted(text, 60), "failed: before/a.gsf 2 N/m^2 at 1.5 mm/s: no height");
  EXPECT_EQ(fitted(text, 50), "failed: a.gsf 2 N/m^2 at 1.5 mm/s: no height");
  EXPECT_EQ(fitted(text, 30), "failed: a.gsf 2 N/m^2 at ...");
  EXPECT_EQ(fitted("../x/a.gsf: got nothing", 12), "a.gsf: ...");
}

TEST(Findings, NameSurfacesWithoutTheFoldersThatTheyShare) {
  std::vector<Case> cases;
  for (const char* path : {"/data/a/before.x3p", "/data/b/before.x3p", "/data/b/after.x3p",
                           "after_2.x3p", "/x", "x"}) {
    cases.push_back({.surface = path});
  }
  shorten_paths(cases);
  std::vector<std::string> names;
  for (const Case& one : cases) names.push_back(one.surface);
  EXPECT_THAT(names,
              ElementsAre("a/before.x3p", "b/before.x3p", "after.x3p", "after_2.x3p", "/x", "x"));
}

TEST(Findings, AreSaidWithoutCasesWhereThereIsOneOrNoNameForIt) {
  EXPECT_EQ(line_of(findings_of({{.pressure = "2 MPa", .warnings = {spill(0.2)}}})[0]),
            "spill-over 20 % [spill-over]");
  const Warning level{"not-levelled", "no levelling"};
  const auto everywhere = findings_of(
      {{.pressure = "2 MPa", .warnings = {level}}, {.pressure = "7 MPa", .warnings = {level}}});
  EXPECT_EQ(line_of(everywhere[0]), "no levelling [not-levelled]");
  EXPECT_THAT(everywhere[0].cases, IsEmpty());
}

TEST(Findings, NameASurfaceAloneWhereAllOfItsCasesAreMeant) {
  const auto found = findings_of(grid_of([](const Case& one) {
    const bool is_wet = one.surface == "a" || one.density == "5 g/m^2";
    return is_wet ? Warnings{spill(0.3)} : Warnings{};
  }));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0].cases, ElementsAre("a", "b 2 MPa 5 g/m^2", "b 7 MPa 5 g/m^2"));
  EXPECT_EQ(found[0].n_cases, 6u);
}

TEST(Findings, DoNotCallTheFirstTheWorst) {
  const auto found = findings_of({{.surface = "a", .warnings = {{"spikes", "5 spikes"}}},
                                  {.surface = "b", .warnings = {{"spikes", "221 spikes"}}}});
  EXPECT_EQ(line_of(found[0]), "5 spikes (both cases, the first shown) [spikes]");
}

TEST(Findings, NameAFewCasesAndCountTheRest) {
  std::vector<Case> cases;
  for (int i = 0; i < 9; ++i) {
    cases.push_back({.pressure = std::to_string(i), .warnings = {}});
    if (i < 7) cases.back().warnings = {spill(0.5)};
  }
  const auto some = findings_of(cases);
  EXPECT_THAT(line_of(some[0]), HasSubstr("(7 of 9 cases: 0, 1, 2, 3 and 3 more)"));
  EXPECT_EQ(some[0].cases.size(), 7u);
  cases.resize(7);
  EXPECT_THAT(line_of(findings_of(cases)[0]), HasSubstr("(all 7 cases)"));
}

/// What readers say of a file has one code; results of earlier versions have none.
TEST(Findings, KeepApartWhatSharesACodeOnly) {
  const auto found = findings_of(
      {{.surface = "a",
        .warnings = {{"file", "white is zero"}, {"file", "the height scale is negative"}}},
       {.surface = "b", .warnings = {{"file", "white is zero"}}}});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].n_cases, 2u);
  EXPECT_EQ(found[1].n_cases, 1u);
}

TEST(Findings, CountACaseOnceHoweverOftenItIsMet) {
  const auto found =
      findings_of({{.warnings = {{"implausible-friction", "dry friction of 3", 3},
                                 {"implausible-friction", "mixed friction of 4", 4}}}});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].n_cases, 1u);
  EXPECT_EQ(found[0].text, "mixed friction of 4");
}

TEST(Findings, OfNothingAreNone) {
  EXPECT_THAT(findings_of({}), IsEmpty());
  EXPECT_THAT(findings_of(grid_of([](const Case&) { return Warnings{}; })), IsEmpty());
}

}  // namespace
}  // namespace tabor::results
