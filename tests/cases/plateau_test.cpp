#include "tabor/cases/plateau.hpp"

#include <gmock/gmock.h>

namespace tabor::cases {
namespace {

TEST(FindPlateau, TakesTheLongestFlatRange) {
  const auto plateau =
      find_plateau({32, 64, 128, 256, 512, 1024}, {0.30, 0.20, 0.101, 0.100, 0.099, 0.05}, 0.05);
  ASSERT_TRUE(plateau);
  EXPECT_EQ(plateau->first, 128);
  EXPECT_EQ(plateau->last, 512);
  EXPECT_NEAR(plateau->value, 0.1, 1e-12);
}

TEST(FindPlateau, FindsNoneInASteadyDecline) {
  EXPECT_FALSE(find_plateau({32, 64, 128, 256}, {0.4, 0.3, 0.2, 0.1}, 0.05));
}

TEST(FindPlateau, NeedsThreePoints) { EXPECT_FALSE(find_plateau({32, 64}, {0.1, 0.1}, 0.05)); }

}  // namespace
}  // namespace tabor::cases
