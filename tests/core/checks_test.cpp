#include "tabor/core/checks.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "tabor/core/error.hpp"

namespace tabor {
namespace {

TEST(CheckPositive, NamesWhatIsNotFiniteAndAboveZero) {
  EXPECT_NO_THROW(check_positive("load", 1e-300));
  for (const double value : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    EXPECT_THROW(check_positive("load", value), InputError);
  }
  try {
    check_positive("load", -2, "N");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "load: got -2 N; expected a finite value above zero");
  }
}

TEST(CheckMemory, SaysHowMuchIsNeededAndHowMuchIsFree) {
  EXPECT_NO_THROW(check_memory("map", "2 x 2 pixels", 32, ""));
  try {
    check_memory("map", "10000000 x 10000000 pixels", 8e14, "take fewer");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                testing::MatchesRegex("map: got 10000000 x 10000000 pixels, which take 8e\\+05 GB; "
                                      "expected what fits into the [0-9.]+ GB of free memory; "
                                      "take fewer"));
  }
}

}  // namespace
}  // namespace tabor
