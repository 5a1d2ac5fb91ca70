#include "tabor/numerics/grid_limit.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tabor::numerics {
namespace {

/// 3 + 2 h^order on each spacing.
std::vector<double> values_of(const std::vector<double>& spacing, double order) {
  std::vector<double> values;
  values.reserve(spacing.size());
  for (const double h : spacing) values.push_back(3 + 2 * std::pow(h, order));
  return values;
}

TEST(GridLimit, FindsLimitAndOrderOnAnySpacings) {
  for (const std::vector<double>& spacing :
       {std::vector<double>{1, 0.5, 0.25}, std::vector<double>{1. / 64, 1. / 96, 1. / 144},
        std::vector<double>{0.1, 0.3, 0.2}, std::vector<double>{4, 2, 0.3, 0.2}}) {
    for (const double order : {0.7, 1.0, 2.0, 3.5}) {
      const GridLimit limit = limit_of(spacing, values_of(spacing, order));
      EXPECT_NEAR(limit.value, 3, 1e-6) << spacing[0] << " order " << order;
      EXPECT_NEAR(limit.order, order, 1e-6) << spacing[0];
    }
  }
}

TEST(GridLimit, UsesTheThreeFinestOfMore) {
  const GridLimit limit = limit_of({1, 0.5, 0.25, 8}, {5, 3.5, 3.125, -1e3});
  EXPECT_NEAR(limit.value, 3, 1e-9);
}

TEST(GridLimit, DoesNotMakeALimitUp) {
  const std::vector<double> spacing = {1, 0.5, 0.25};
  for (const std::vector<double>& values :
       {std::vector<double>{1, 2, 1.5}, std::vector<double>{1, 2, 4},
        std::vector<double>{1, NAN, 2}, std::vector<double>{1, 1, 2}}) {
    EXPECT_TRUE(std::isnan(limit_of(spacing, values).value)) << values[2];
    EXPECT_TRUE(std::isnan(limit_of(spacing, values).order)) << values[2];
  }
}

TEST(GridLimit, OfValuesThatDoNotChangeIsTheirs) {
  EXPECT_EQ(limit_of({1, 0.5, 0.25}, {9, 7, 7}).value, 7);
}

}  // namespace
}  // namespace tabor::numerics
