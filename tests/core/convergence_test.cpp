#include "tabor/core/convergence.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tabor {
namespace {

TEST(ShareDone, IsLogarithmicInTheCertificate) {
  const Convergence half{.certificate = 1e-3, .tolerance = 1e-6};
  EXPECT_DOUBLE_EQ(share_done(1, half), 0.5);
}

TEST(ShareDone, StaysBetweenNothingAndAll) {
  EXPECT_EQ(share_done(1, {.certificate = 10, .tolerance = 1e-6}), 0);
  EXPECT_EQ(share_done(1, {.certificate = 1e-9, .tolerance = 1e-6}), 1);
  EXPECT_EQ(share_done(1, {.certificate = INFINITY, .tolerance = 1e-6}), 0);
  EXPECT_EQ(share_done(1, {.certificate = NAN, .tolerance = 1e-6}), 0);
}

}  // namespace
}  // namespace tabor
