#include "tabor/core/text.hpp"

#include <gtest/gtest.h>

namespace tabor {
namespace {

TEST(ParseNumber, TakesWholeNumbersInTheCLocaleOnly) {
  EXPECT_EQ(parse_number(" 1.5e-3 "), 1.5e-3);
  EXPECT_EQ(parse_number("+2"), 2.0);
  EXPECT_FALSE(parse_number("1,5"));
  EXPECT_FALSE(parse_number("1.5 um"));
  EXPECT_FALSE(parse_number("+-2"));
  EXPECT_FALSE(parse_number(""));
}

TEST(NearestMatch, FindsTyposAndStaysSilentOnStrangers) {
  EXPECT_EQ(nearest_match("lowpas", {"level", "lowpass", "mirror"}), "lowpass");
  EXPECT_EQ(nearest_match("Lowpass", {"lowpass"}), "lowpass");
  EXPECT_FALSE(nearest_match("temperature", {"level", "lowpass"}));
  EXPECT_EQ(suggestion("presure", {"pressure"}), "; did you mean 'pressure'?");
  EXPECT_EQ(suggestion("zzzzzz", {"pressure"}), "");
  EXPECT_FALSE(nearest_match("z", {"x", "y"}));
}

TEST(NearestMatch, IsNearToTheFirstWordsOfAName) {
  const std::vector<std::string> names{"steel-dc04", "aluminium-6016", "glass"};
  EXPECT_EQ(nearest_match("aluminum", names), "aluminium-6016");
  EXPECT_EQ(nearest_match("Steel", names), "steel-dc04");
  EXPECT_EQ(nearest_match("glas", names), "glass");
  EXPECT_EQ(nearest_match("lamp", {"lamp-shade", "lamps"}), "lamp-shade");
  EXPECT_FALSE(nearest_match("--a", {"--youngs-modulus"}));
}

TEST(Split, KeepsEmptyParts) {
  EXPECT_EQ(split("a,,b", ','), (std::vector<std::string>{"a", "", "b"}));
  EXPECT_EQ(split("", ','), (std::vector<std::string>{""}));
}

}  // namespace
}  // namespace tabor
