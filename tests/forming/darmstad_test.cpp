#include "tabor/forming/darmstad.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "forming/made_table.hpp"
#include "tabor/core/error.hpp"

namespace tabor::forming {
namespace {

using test::made_table;

DarmstadFit fit_of(const std::vector<double>& pressures, const std::vector<double>& speeds,
                   const test::Law& law) {
  return fit_darmstad(made_table(pressures, {1e-3}, speeds, law)).front();
}

TEST(FitDarmstad, FindsAParabolaOverPressure) {
  // mu = 0.3 - 2e-9 p + 4e-17 p^2
  const DarmstadFit fit = fit_of({1e6, 2e6, 5e6, 10e6, 20e6}, {}, [](double p, double, double) {
    return 0.3 - 2e-9 * p + 4e-17 * p * p;
  });
  EXPECT_NEAR(fit.law.constant, 0.3, 1e-12);
  EXPECT_NEAR(fit.law.c3, -2e-9, 1e-18);
  EXPECT_NEAR(fit.law.c1, 4e-17, 1e-26);
  EXPECT_EQ(fit.law.c5, 0);
  EXPECT_LT(fit.largest_error, 1e-12);
  EXPECT_EQ(fit.lubricant_density, 1e-3);
}

TEST(FitDarmstad, DrawsALineThroughTwoPressures) {
  const DarmstadFit fit =
      fit_of({2e6, 8e6}, {}, [](double p, double, double) { return p < 5e6 ? 0.28 : 0.22; });
  EXPECT_EQ(fit.law.c1, 0);
  EXPECT_NEAR(fit.law.c3, -1e-8, 1e-17);
  EXPECT_NEAR(fit.law.constant, 0.3, 1e-12);
}

TEST(FitDarmstad, OfFourPressuresIsTheLeastSquaresParabola) {
  // The residuals of a least squares fit are orthogonal to 1, p and p^2.
  const std::vector<double> pressures{1e6, 3e6, 4e6, 9e6};
  const std::vector<double> friction{0.31, 0.22, 0.27, 0.18};
  const auto law = [&](double p, double, double) {
    return friction[static_cast<std::size_t>(std::find(pressures.begin(), pressures.end(), p) -
                                             pressures.begin())];
  };
  const DarmstadFit fit = fit_of(pressures, {}, law);
  double largest = 0;
  for (const int power : {0, 1, 2}) {
    double product = 0;
    for (std::size_t i = 0; i < pressures.size(); ++i) {
      const double residual = fit.law.friction(pressures[i], 0) - friction[i];
      product += residual * std::pow(pressures[i] / 9e6, power);
      largest = std::max(largest, std::abs(residual));
    }
    EXPECT_NEAR(product, 0, 1e-13) << power;
  }
  EXPECT_GT(largest, 1e-3);
  EXPECT_DOUBLE_EQ(fit.largest_error, largest);
}

TEST(FitDarmstad, FindsTheDecayOverSpeed) {
  // A Stribeck-like fall: mu = 0.1 + 0.15 e^(-v / 0.05 m/s) - 3e-9 e^(-v / 0.05 m/s) p
  const DarmstadFit fit = fit_of(
      {2e6, 5e6, 10e6}, {0.01, 0.03, 0.1, 0.3, 1},
      [](double p, double, double v) { return 0.1 + (0.15 - 3e-9 * p) * std::exp(-20 * v); });
  EXPECT_LT(fit.largest_error, 1e-4);
  EXPECT_NEAR(fit.law.friction(7e6, 0.05), 0.1 + 0.129 * std::exp(-1.0), 1e-3);
  EXPECT_LE(fit.law.c2, 0);
  EXPECT_LE(fit.law.c4, 0);
  EXPECT_LT(fit.law.c6, 0);
}

TEST(FitDarmstad, EndsSoonBeyondTheLargestSpeed) {
  // A straight line over the speed, which no decay can follow for ever.
  const auto line = [](double p, double, double v) { return 0.3 - 5e-9 * p - 0.1 * v; };
  const DarmstadFit few = fit_of({2e6, 5e6}, {0, 0.5, 1}, line);
  for (const double p : {2e6, 5e6}) {
    const double within = few.law.friction(p, 0) - few.law.friction(p, 1);
    EXPECT_NEAR(within, 0.1, 0.02);
    // e^-1 / (1 - e^-1)
    EXPECT_LE(few.law.friction(p, 1) - few.law.friction(p, 1e6), 0.5820 * within);
  }
  const DarmstadFit many = fit_of({2e6, 5e6, 1e7}, {0, 0.25, 0.5, 0.75, 1}, line);
  EXPECT_LT(many.largest_error, few.largest_error);
  for (const double rate : {many.law.c2, many.law.c4, many.law.c6}) {
    EXPECT_TRUE(rate == 0 || rate <= -1) << rate;
  }
}

TEST(FitDarmstad, SharesOneDecayWhereNumbersAreFew) {
  const DarmstadFit fit = fit_of({2e6, 5e6, 10e6}, {0.1, 1}, [](double p, double, double v) {
    return 0.3 - 1e-8 * p * std::exp(-2 * v) - 1e-16 * p * p * std::exp(-5 * v) + 0.02 * v;
  });
  double shared = 0;
  for (const double rate : {fit.law.c2, fit.law.c4, fit.law.c6}) {
    if (rate == 0) continue;
    EXPECT_LE(rate, -1);
    EXPECT_TRUE(shared == 0 || rate == shared);
    shared = rate;
  }
  EXPECT_LT(shared, 0);
  EXPECT_LT(fit.largest_error, 1e-3);
}

TEST(FitDarmstad, OfOneSpeedDoesNotDependOnIt) {
  const DarmstadFit fit =
      fit_of({2e6, 5e6, 10e6}, {0.1}, [](double p, double, double) { return 0.3 - 1e-8 * p; });
  for (const double rate : {fit.law.c2, fit.law.c4, fit.law.c6, fit.law.c5}) EXPECT_EQ(rate, 0);
  EXPECT_LT(fit.largest_error, 1e-12);
}

TEST(FitDarmstad, IsTheSameInOtherUnits) {
  const auto law = [](double p, double, double v) { return 0.3 - 1e-8 * p + 0.05 * std::sqrt(v); };
  const std::vector<double> pressures{2e6, 5e6, 10e6};
  const std::vector<double> speeds{0.01, 0.1, 1};
  const DarmstadFit fit = fit_of(pressures, speeds, law);
  std::vector<double> small_pressures, slow_speeds;
  for (const double p : pressures) small_pressures.push_back(p / 1024);
  for (const double v : speeds) slow_speeds.push_back(v / 64);
  const DarmstadFit scaled = fit_of(small_pressures, slow_speeds, [&](double p, double, double v) {
    return law(1024 * p, 0, 64 * v);
  });
  EXPECT_NEAR(scaled.largest_error, fit.largest_error, 1e-9);
  EXPECT_NEAR(scaled.law.friction(3e6 / 1024, 0.5 / 64), fit.law.friction(3e6, 0.5), 1e-6);
}

TEST(FitDarmstad, GivesEachDensityItsOwnLaw) {
  const auto fits = fit_darmstad(made_table({2e6, 5e6}, {0, 1e-3}, {}, test::some_law));
  ASSERT_EQ(fits.size(), 2u);
  EXPECT_NEAR(fits[0].law.constant - fits[1].law.constant, 0.04, 1e-12);
}

TEST(FitDarmstad, NeedsTwoPressures) {
  EXPECT_THROW(fit_of({2e6}, {0.1, 1}, test::some_law), InputError);
}

}  // namespace
}  // namespace tabor::forming
