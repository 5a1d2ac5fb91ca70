// When sliding counts as steady.
#include "tabor/cases/slide/steadiness.hpp"

#include <gtest/gtest.h>

namespace tabor::cases {
namespace {

/// Three steps a period; values of each period.
Steadiness after(const std::vector<double>& moved, const std::vector<double>& friction) {
  Steadiness steadiness(3);
  double begin = 0;
  for (std::size_t period = 0; period < moved.size(); ++period) {
    for (int step = 0; step < 3; ++step, begin += 1) {
      steadiness.add(begin, {.distance = 1, .moved = moved[period], .friction = friction[period]});
    }
  }
  return steadiness;
}

TEST(Steadiness, NeedsTwoWholePeriods) {
  EXPECT_FALSE(Steadiness(3).is_steady());
  EXPECT_FALSE(after({1, 0.001}, {0.2, 0.2}).is_steady());  // the second is not known to be whole
  EXPECT_TRUE(after({1, 0.001, 0}, {0.2, 0.2, 0.2}).is_steady());
}

TEST(Steadiness, NeedsLittleDisplacementAndTheSameFriction) {
  EXPECT_FALSE(after({1, 0.02, 0}, {0.2, 0.2, 0.2}).is_steady());
  EXPECT_FALSE(after({1, 0.001, 0}, {0.2, 0.21, 0.2}).is_steady());
  EXPECT_TRUE(after({1, 0.5, 0.009, 0}, {0.3, 0.2, 0.2015, 0.2}).is_steady());
}

TEST(Steadiness, GoesOnWithThePeriodsBefore) {
  const Steadiness whole = after({1, 0.001, 0}, {0.2, 0.2, 0.2});
  EXPECT_TRUE(Steadiness(3, whole.periods()).is_steady());
}

}  // namespace
}  // namespace tabor::cases
