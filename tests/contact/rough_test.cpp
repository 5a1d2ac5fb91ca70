#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "contact/surfaces.hpp"
#include "support/validation.hpp"
#include "tabor/reference/roughness.hpp"

namespace tabor::test {
namespace {

constexpr int kRealisations = 6;

/// kappa = (A/A0) / (P / (E* rms slope)) of each realisation, H = 0.8, k 1..32, n = 512.
std::vector<double> kappas(double reduced_pressure) {
  std::vector<double> values;
  for (std::uint64_t seed = 1; seed <= kRealisations; ++seed) {
    const Solved solved = solve_unit(self_affine(512, 0.8, 1, 32, seed), reduced_pressure);
    EXPECT_TRUE(solved.state.convergence.converged());
    values.push_back(solved.summary.contact_area_fraction / reduced_pressure);
  }
  return values;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

TEST(SolveContact, FindsTheSlopeOfAreaAgainstLoadOnSelfAffineSurfaces) {
  expect_within("Contact", "self-affine, H = 0.8, k 1..32, P/(E* slope) = 0.1, mean of 6",
                "kappa against 1.97, relative", "contact.md section 5",
                std::abs(mean(kappas(0.1)) / 1.97 - 1), 0.05);
  expect_within("Contact", "self-affine, H = 0.8, k 1..32, P/(E* slope) = 0.2, mean of 6",
                "kappa against 1.88, relative", "contact.md section 5",
                std::abs(mean(kappas(0.2)) / 1.88 - 1), 0.05);
}

// At light load few summits touch, and without roll-off single realisations differ by more than the
// 5 % within which one published realisation gave 1.94: that value must be one of ours.
TEST(SolveContact, LightLoadsScatterAroundThePublishedSlope) {
  const std::vector<double> values = kappas(0.01);
  double variance = 0;
  for (const double value : values) {
    variance += std::pow(value - mean(values), 2) / (kRealisations - 1);
  }
  expect_within("Contact", "self-affine, H = 0.8, k 1..32, P/(E* slope) = 0.01, 6 realisations",
                "1.94 against their mean, standard deviations",
                "contact.md section 5 (one realisation)",
                std::abs(mean(values) - 1.94) / std::sqrt(variance), 2.0);
  EXPECT_GT(mean(values), reference::kKappaPersson);
  EXPECT_LT(mean(values), reference::kKappaBushGibsonThomas);
}

TEST(SolveContact, BothSolversAgreeOnRoughSurfaces) {
  const Field height = self_affine(64, 0.8, 1, 16, 11);
  for (const double cap : {contact::kNoSaturation, 0.2}) {
    const Solved fast = solve_unit(height, 0.02, cap, 1e-13);
    const Solved baseline = solve_unit(height, 0.02, cap, 1e-13, contact::Solver::polonsky_keer);
    ASSERT_TRUE(fast.state.convergence.converged());
    ASSERT_TRUE(baseline.state.convergence.converged());
    expect_within("Contact",
                  std::isfinite(cap) ? "rough, saturated, n = 64" : "rough, elastic, n = 64",
                  "pressure, fast against Polonsky-Keer", "each other",
                  (fast.state.pressure - baseline.state.pressure).abs().maxCoeff() /
                      fast.summary.max_pressure,
                  1e-8);
  }
}

}  // namespace
}  // namespace tabor::test
