#include "tabor/reference/elliptic_integrals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace tabor::reference {
namespace {

constexpr double kPi = std::numbers::pi;

EllipticIntegrals at(double modulus) {
  return elliptic_integrals(modulus, std::sqrt((1 - modulus) * (1 + modulus)));
}

TEST(EllipticIntegrals, AreThoseOfTheLemniscate) {  // K = Gamma(1/4)^2 / (4 sqrt(pi)) at k^2 = 1/2
  const EllipticIntegrals half = at(std::numbers::sqrt2 / 2);
  const double first = std::pow(std::tgamma(0.25), 2) / (4 * std::sqrt(kPi));
  EXPECT_NEAR(half.first / first, 1, 1e-14);
  EXPECT_NEAR(half.second / (first / 2 + kPi / (4 * first)), 1, 1e-14);
}

TEST(EllipticIntegrals, AreThoseOfTheStandardLibrary) {
  for (const double k : {0.05, 0.3, 0.6, 0.9}) {
    EXPECT_NEAR(at(k).first / std::comp_ellint_1(k), 1, 1e-13) << k;
    EXPECT_NEAR(at(k).second / std::comp_ellint_2(k), 1, 1e-13) << k;
  }
}

TEST(EllipticIntegrals, SatisfyLegendresRelation) {
  for (const double k : {1e-6, 0.01, 0.3, 0.6}) {
    const double complement = std::sqrt((1 - k) * (1 + k));
    const EllipticIntegrals one = elliptic_integrals(k, complement);
    const EllipticIntegrals other = elliptic_integrals(complement, k);
    // E K' + E' K - K K' = pi/2, without its cancellation at small k.
    const double sum = other.second * one.first - k * k * one.wide * other.first;
    EXPECT_NEAR(sum, kPi / 2, 1e-13) << k;
  }
}

TEST(EllipticIntegrals, KeepTheirDigitsAtSmallModuli) {
  for (const double k : {0.0, 1e-12, 1e-8, 1e-5}) {
    // K - E = k^2 pi/4 (1 + 3 k^2/8 + ...), E - (1 - k^2) K = k^2 pi/4 (1 + k^2/8 + ...)
    EXPECT_NEAR(at(k).wide / (kPi / 4 * (1 + 3 * k * k / 8)), 1, 1e-14) << k;
    EXPECT_NEAR(at(k).narrow / (kPi / 4 * (1 + k * k / 8)), 1, 1e-14) << k;
  }
}

TEST(EllipticIntegrals, FollowTheLogarithmTowardsOne) {
  const double complement = 1e-12;
  EXPECT_NEAR(elliptic_integrals(1, complement).first / std::log(4 / complement), 1, 1e-14);
  EXPECT_NEAR(elliptic_integrals(1, complement).second, 1, 1e-14);
}

}  // namespace
}  // namespace tabor::reference
