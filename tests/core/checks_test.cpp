#include "tabor/core/checks.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace tabor
