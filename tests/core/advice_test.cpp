#include "tabor/core/advice.hpp"

#include <gmock/gmock.h>

namespace tabor {
namespace {

/// "--level plane", as a reader who lacks two of all settings.
std::string flag(const Advice& advice) {
  if (advice.setting == "lowpass" || advice.setting == "fit_min") return "";
  return "--" + advice.setting + (advice.value.empty() ? "" : " " + advice.value);
}

TEST(Advice, IsSpelledByItsReader) {
  EXPECT_EQ(advised("tilted; <level=plane> removes it", flag), "tilted; --level plane removes it");
  EXPECT_EQ(advised("a metal would yield (give <cap>), rubber not", flag),
            "a metal would yield (give --cap), rubber not");
  EXPECT_EQ(advised("<mirror>", flag), "--mirror");
}

TEST(Advice, IsLeftOutWithItsClauseWhereItCannotBeSpelled) {
  EXPECT_EQ(advised("steep; <despike=auto> for spikes; <lowpass> for noise", flag),
            "steep; --despike auto for spikes");
  EXPECT_EQ(advised("steep; <lowpass> for noise; check units", flag), "steep; check units");
  EXPECT_EQ(advised("yields (give <lowpass>), and (2 x) stays", flag), "yields, and (2 x) stays");
  EXPECT_EQ(advised("choose; by <fit_max>, <fit_min>", flag), "choose");
  EXPECT_EQ(advised("<lowpass> first", flag), "lowpass first");  // never without a first clause
}

TEST(Advice, LeavesEverythingElseAsItIs) {
  for (const char* text :
       {"", "no advice; none", "a < b and c > d", "<2 pixels>", "<Unit>; x", "<"}) {
    EXPECT_EQ(advised(text, flag), text);
    EXPECT_TRUE(advice_in(text).empty()) << text;
  }
}

TEST(Advice, CanBeTakenAway) {
  EXPECT_EQ(without_advice("3 spikes (2 %); <despike=auto> takes them out"), "3 spikes (2 %)");
  EXPECT_EQ(without_advice("it yields (give <cap>), or not"), "it yields, or not");
}

TEST(Advice, IsListedInItsOrder) {
  const std::vector<Advice> all = advice_in("x; <boundary=free>; (<lowpass>)");
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].setting, "boundary");
  EXPECT_EQ(all[0].value, "free");
  EXPECT_EQ(all[1].setting, "lowpass");
  EXPECT_EQ(all[1].value, "");
}

}  // namespace
}  // namespace tabor
