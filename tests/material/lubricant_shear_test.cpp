#include "tabor/material/lubricant_shear.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "material/differences.hpp"
#include "support/rejection.hpp"
#include "support/validation.hpp"
#include "support/worst.hpp"
#include "tabor/core/error.hpp"

namespace tabor::material {
namespace {

const std::vector<Shear> kLaws{NewtonianShear{}, ree_eyring_shear(6.8e6),
                               limiting_shear(2e6, 0.05)};
const std::vector<double> kRates{-1e8, -3e5, -1e2, 0.0, 1.0, 3e3, 2e5, 1e6, 1e7, 1e9};
constexpr double kPressure = 4e8;

TEST(Shear, OfReeAndEyringIsTheInverseHyperbolicSine) {
  const Shear law = ree_eyring_shear(6.8e6);
  for (const double rate : kRates) {
    const double expected = 6.8e6 * std::asinh(12. * rate / 6.8e6);
    EXPECT_NEAR(shear_stress(law, 12, rate, kPressure).value, expected, 1e-13 * std::abs(expected));
  }
}

TEST(Shear, EffectiveViscositiesAreThoseOfTheMidPlaneStress) {
  const double eta = 3.7, us = 0.5, h = 80e-9, tau_E = 6.8e6;
  const double x = std::asinh(eta * us / (h * tau_E));  // tau_m / tau_E
  const FlowViscosity flow = flow_viscosity(ree_eyring_shear(tau_E), eta, us / h, kPressure);
  EXPECT_NEAR(flow.along.value, eta / std::cosh(x), 1e-14);
  EXPECT_NEAR(flow.across.value, eta * x / std::sinh(x), 1e-14);
}

TEST(Shear, SlowFilmsAreNewtonian) {
  for (const Shear& law : kLaws) {
    for (const double rate : {0.0, 1e-6}) {
      const FlowViscosity flow = flow_viscosity(law, 0.7, rate, kPressure);
      EXPECT_NEAR(flow.along.value, 0.7, 1e-12);
      EXPECT_NEAR(flow.across.value, 0.7, 1e-12);
    }
  }
}

TEST(Shear, ResistsLessAlongThanAcrossTheSlidingDirection) {
  for (const Shear& law : {kLaws[1], kLaws[2]}) {
    for (const double rate : {1e6, 1e7, 1e8}) {
      const FlowViscosity flow = flow_viscosity(law, 5, rate, kPressure);
      EXPECT_LT(flow.along.value, flow.across.value);
      EXPECT_LT(flow.across.value, 5);
    }
  }
}

TEST(Shear, NeverExceedsTheLimitingStress) {
  const LimitingShear law = limiting_shear(2e6, 0.05);
  EXPECT_DOUBLE_EQ(law.limit_at(4e8), 22e6);
  EXPECT_DOUBLE_EQ(law.limit_at(-1e6), 2e6);
  EXPECT_LE(shear_stress(law, 100, 1e12, 4e8).value, 22e6);
  EXPECT_GT(shear_stress(law, 100, 1e12, 4e8).value, 21.99e6);
}

TEST(Shear, TurnsRoundWithTheSlidingDirection) {
  for (const Shear& law : kLaws) {
    EXPECT_DOUBLE_EQ(shear_stress(law, 2, -3e6, kPressure).value,
                     -shear_stress(law, 2, 3e6, kPressure).value);
    EXPECT_DOUBLE_EQ(flow_viscosity(law, 2, -3e6, kPressure).along.value,
                     flow_viscosity(law, 2, 3e6, kPressure).along.value);
  }
}

// Quotients and, for small arguments, series: against the quotients in more digits.
TEST(Shear, SecantsHaveAllTheirDigitsOnBothSidesOfTheSeries) {
  for (const long double s : {1e-4L, 3e-3L, 9.99e-3L, 1.001e-2L, 3e-2L, 1.L, 20.L}) {
    const auto rate = static_cast<double>(s);
    const double digits = s < 1e-2L ? 2e-14 : 1e-11;  // of the slopes; a quotient loses some
    const long double eyring = std::asinh(s) / s;
    const auto by_eyring = flow_viscosity(ree_eyring_shear(1), 1, rate, 0).across;
    EXPECT_NEAR(by_eyring.value / static_cast<double>(eyring), 1, 1e-15) << rate;
    const long double eyring_slope = (1 / std::sqrt(1 + s * s) - eyring) / s;
    if (s > 1e-3L) {
      EXPECT_NEAR(by_eyring.by_rate / static_cast<double>(eyring_slope), 1, digits) << rate;
    }
    const long double limiting = -std::expm1(-s) / s;
    const auto by_limit = flow_viscosity(limiting_shear(1, 0), 1, rate, 0).across;
    EXPECT_NEAR(by_limit.value / static_cast<double>(limiting), 1, 1e-15) << rate;
    const long double limiting_slope = (std::exp(-s) - limiting) / s;
    EXPECT_NEAR(by_limit.by_rate / static_cast<double>(limiting_slope), 1, digits) << rate;
  }
}

TEST(Shear, TakesAnyPositiveStress) {
  EXPECT_EQ(ree_eyring_shear(1e-3).eyring_stress, 1e-3);
  EXPECT_EQ(limiting_shear(1e-3, 0).ambient_limit, 1e-3);
}

TEST(Shear, DerivativesAtTheKinkOfRestAreTheMeanOfBothSides) {
  const FlowViscosity rest = flow_viscosity(kLaws[2], 12, 0, kPressure);
  EXPECT_EQ(rest.along.by_rate, 0);
  EXPECT_EQ(rest.across.by_rate, 0);
  for (const double rate : {-0.5, 0.5}) {  // [1/s]
    const FlowViscosity flow = flow_viscosity(kLaws[2], 12, rate, kPressure);
    EXPECT_NEAR(flow.along.by_rate / (-12 * 12 / 22e6), rate > 0 ? 1 : -1, 1e-6);
  }
}

/// Worst relative error of the derivatives of quantity(viscosity, rate, pressure), which returns
/// one with members value, by_viscosity, by_rate and by_pressure.
template <typename Quantity>
double worst_derivative(const Quantity& quantity) {
  const double eta = 12;
  double worst = 0;
  for (const double rate : kRates) {
    if (rate == 0) {
      continue;  // the limiting stress has a kink there
    }
    const auto at = quantity(eta, rate, kPressure);
    const double scale = std::max(std::abs(at.value), 1e-3);
    const double step = 1e-3 * std::abs(rate);
    const auto by_eta =
        difference([&](double x) { return quantity(x, rate, kPressure).value; }, eta, 1e-3 * eta);
    const auto by_rate =
        difference([&](double x) { return quantity(eta, x, kPressure).value; }, rate, step);
    const auto by_p =
        difference([&](double x) { return quantity(eta, rate, x).value; }, kPressure, 1e5);
    worst = test::worst_of({worst, std::abs(at.by_viscosity - by_eta) / (scale / eta),
                            std::abs(at.by_rate - by_rate) / (scale / std::abs(rate)),
                            std::abs(at.by_pressure - by_p) / (scale / kPressure)});
  }
  return worst;
}

TEST(Shear, HasTheDerivativesOfItsDifferences) {
  double worst = 0;
  for (const Shear& law : kLaws) {
    worst = test::worst_of({worst, worst_derivative([&](double eta, double rate, double p) {
                              return flow_viscosity(law, eta, rate, p).along;
                            }),
                            worst_derivative([&](double eta, double rate, double p) {
                              return flow_viscosity(law, eta, rate, p).across;
                            }),
                            worst_derivative([&](double eta, double rate, double p) {
                              return shear_stress(law, eta, rate, p);
                            })});
  }
  test::expect_within("Lubricant", "shear laws, 0 to 1e9 1/s", "derivatives, relative",
                      "fourth-order differences", worst, 1e-8);
}

TEST(Shear, SeriesForSlowFilmsMeetsTheClosedForm) {
  for (const Shear& law : {kLaws[1], kLaws[2]}) {
    const double limit = 22e6;  // both laws have s = eta rate / stress about 0.01 near here
    for (const double stress : {6.8e6, limit}) {
      const double rate = 0.01 * stress;
      const auto below = flow_viscosity(law, 1, rate * (1 - 1e-9), kPressure).across;
      const auto above = flow_viscosity(law, 1, rate * (1 + 1e-9), kPressure).across;
      EXPECT_NEAR(below.value, above.value, 1e-10);
      EXPECT_NEAR(below.by_rate / above.by_rate, 1, 1e-8);
    }
  }
}

TEST(Shear, LawsAreKnownByName) {
  for (const Shear& law : kLaws) {
    EXPECT_EQ(parse_shear_law(name(law_of(law))), law_of(law));
  }
  const std::string message = test::rejection([] { parse_shear_law("eyring"); });
  EXPECT_NE(message.find("ree-eyring"), std::string::npos) << message;
}

TEST(Shear, RejectsWhatMakesNoSense) {
  for (const double bad : {0.0, -1e6, std::nan("")}) {
    EXPECT_THROW(ree_eyring_shear(bad), InputError) << bad;
    EXPECT_THROW(limiting_shear(bad, 0.05), InputError) << bad;
  }
  EXPECT_THROW(limiting_shear(1e6, -0.1), InputError);
}

}  // namespace
}  // namespace tabor::material
