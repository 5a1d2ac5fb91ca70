#include "tabor/numerics/bracketed_secant.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace tabor::numerics {
namespace {

/// Number of values until the next step is within 1e-9, and where that is.
struct Found {
  int n_values = 0;
  double place = 0;
};
Found search(const std::function<double(double)>& value, double place, double slope,
             double longest_step = 3) {
  BracketedSecant secant(slope, longest_step);
  for (Found found{1, place}; found.n_values < 200; ++found.n_values) {
    const double next = secant.next(found.place, value(found.place));
    if (std::abs(next - found.place) <= 1e-9) return found;
    found.place = next;
  }
  return {200, place};
}

TEST(BracketedSecant, FindsTheZeroOfALineFromAnySlope) {
  for (const double slope : {0.1, 2.0, 50.0}) {
    const Found found = search([](double x) { return 2 * (x - 5); }, 4.5, slope);
    EXPECT_NEAR(found.place, 5, 1e-9) << slope;
    EXPECT_LE(found.n_values, 4) << slope;
  }
}

TEST(BracketedSecant, TakesNoStepLongerThanAllowedBeforeBothSignsAreKnown) {
  BracketedSecant secant(1e-3, 2);
  EXPECT_EQ(secant.next(0, -100), 2);
  EXPECT_EQ(secant.next(2, -50), 4);
}

TEST(BracketedSecant, StaysInTheBracketOfCurvedAndFlatFunctions) {
  EXPECT_NEAR(search([](double x) { return std::exp(x) - 1e-3; }, 8, 1).place, std::log(1e-3),
              1e-8);
  EXPECT_NEAR(search([](double x) { return std::atan(30 * (x - 1)); }, -20, 1).place, 1, 1e-8);
  EXPECT_NEAR(search([](double x) { return std::cbrt(x + 7); }, 4, 1).place, -7, 1e-8);
  const Found far = search([](double x) { return std::min(1e-3, x - 40); }, 0, 1);
  EXPECT_NEAR(far.place, 40, 1e-8);
  EXPECT_LT(far.n_values, 60);
}

TEST(BracketedSecant, LeavesAPlaceWhereTheFunctionIsFlat) {
  const Found found = search([](double x) { return std::min(1e-3, x); }, 5, 1);
  EXPECT_NEAR(found.place, 0, 1e-8);
  EXPECT_LT(found.n_values, 60);
}

TEST(BracketedSecant, EndsAtAJump) {
  const Found found = search([](double x) { return x < 0.3 ? -1.0 : 1.0; }, 0, 1);
  EXPECT_NEAR(found.place, 0.3, 1e-8);
  EXPECT_LT(found.n_values, 100);
}

}  // namespace
}  // namespace tabor::numerics
