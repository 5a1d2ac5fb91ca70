#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "contact/surfaces.hpp"
#include "support/validation.hpp"
#include "tabor/contact/certificate.hpp"
#include "tabor/synthesis/synthesis.hpp"

namespace tabor::test {
namespace {

TEST(SaturatedContact, IsTheElasticAnswerToTheBitBelowTheCap) {
  const Field height = self_affine(128, 0.8, 1, 32, 1);
  const Solved elastic = solve_unit(height, 0.02);
  for (const double factor : {1.0, 1.001, 2.0, 1e6}) {
    const Solved capped = solve_unit(height, 0.02, factor * elastic.summary.max_pressure);
    EXPECT_TRUE((elastic.state.pressure == capped.state.pressure).all()) << factor;
    EXPECT_EQ(elastic.state.separation, capped.state.separation) << factor;
  }
}

TEST(SaturatedContact, OfAStiffSurfaceIsItsBearingArea) {
  const Field height = self_affine(128, 0.8, 1, 32, 2);
  const double cap = 1e-9;  // p_sat / E* -> 0: no elastic displacement to speak of
  std::vector<double> sorted(height.data(), height.data() + height.size());
  std::sort(sorted.begin(), sorted.end(), std::greater<>());
  for (const double share : {0.01, 0.2, 0.9}) {
    const Solved solved = solve_unit(height, share * cap, cap, 1e-10);
    ASSERT_TRUE(solved.state.convergence.converged());
    const double n = static_cast<double>(height.size());
    expect_within("Contact", fmt::format("bearing area, P/p_sat = {}", share), "area, pixels",
                  "A = P / p_sat",
                  std::abs(solved.summary.contact_area_fraction_pixels * n - share * n), 1.0);
    const double level = sorted[static_cast<std::size_t>(share * n) + 1];
    for (Index i = 0; i < height.size(); ++i) {
      if (height(i) < level) {
        ASSERT_EQ(solved.state.pressure(i), 0) << "pressure below the bearing level";
      }
    }
  }
}

TEST(SaturatedContact, ConvergesWhenEveryContactPixelIsSaturatedAtOnce) {
  // A plateau much higher than the rest: the first step saturates all of it, no pixel stays free.
  Field height = self_affine(64, 0.8, 1, 16, 5) * 1e-6;
  height.block(10, 10, 16, 16) += 1.0;
  const double cap = 1.0;
  const double mean_pressure = 256.0 / 4096 * cap * (1 - 1e-12);
  const Solved solved = solve_unit(height, mean_pressure, cap);
  EXPECT_TRUE(solved.state.convergence.converged());
  EXPECT_EQ(solved.summary.contact_area_fraction_pixels, 256.0 / 4096);
}

class LoadRatios : public testing::TestWithParam<double> {};

TEST_P(LoadRatios, ConvergeFromLightToNearlyFullSaturation) {
  const Field height = self_affine(256, 0.8, 2, 64, 3);
  const double ratio = GetParam();
  for (const double cap : {0.003, 0.05, 0.5}) {
    const Solved solved = solve_unit(height, ratio * cap, cap);
    EXPECT_TRUE(solved.state.convergence.converged())
        << cap << ": " << solved.state.convergence.certificate << " after "
        << solved.state.convergence.iterations;
    EXPECT_GE(solved.summary.contact_area_fraction_pixels, ratio * (1 - 1e-12));
  }
}

INSTANTIATE_TEST_SUITE_P(PressureOverSaturation, LoadRatios,
                         testing::Values(1e-4, 1e-3, 0.01, 0.1, 0.3, 0.6, 0.9, 0.99, 0.999));

class ReducedPressures : public testing::TestWithParam<double> {};

TEST_P(ReducedPressures, ConvergeFromLightToFullElasticContact) {
  const Field height = self_affine(256, 0.8, 2, 64, 3);
  const Solved solved = solve_unit(height, GetParam());
  EXPECT_TRUE(solved.state.convergence.converged())
      << solved.state.convergence.certificate << " after " << solved.state.convergence.iterations;
}

INSTANTIATE_TEST_SUITE_P(PressureOverModulusAndSlope, ReducedPressures,
                         testing::Values(1e-4, 1e-3, 0.01, 0.05, 0.2, 0.5, 1.0, 2.0, 4.0));

/// Heights of an EDT-like sheet on a unit side.
Field sheet(Index n, std::uint64_t seed) {
  synthesis::Edt recipe;
  recipe.grid = square(n, static_cast<double>(n) * 0.67e-6);
  recipe.seed = seed;
  return synthesis::edt(recipe).height / recipe.grid.lx;
}

/// The certificate of a pressure on a unit square, from an operator of its own (contact.md 2).
double certificate_of(const Field& height, const Field& pressure, double mean_pressure,
                      double cap) {
  Field displacement;
  elastic::make_periodic(square(height.rows()), 1.0)->apply(pressure, displacement);
  const Field residual = displacement - height;
  const auto as_vector = [](const Field& field) {
    return std::vector<double>(field.data(), field.data() + field.size());
  };
  const double load = mean_pressure * static_cast<double>(height.size());
  const double rms_height = std::sqrt((height - height.mean()).square().mean());
  return contact::duality_gap({as_vector(pressure), as_vector(residual)}, load, cap) /
         (load * rms_height);
}

// Near full saturation most pixels are held by one bound or the other, and the direction corrected
// for long waves can lead uphill: such a step is made without them.
TEST(SaturatedContact, ConvergesWhereLongWavesLeadUphill) {
  int compact_steps = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Field height = sheet(128, seed);
    const double mean_pressure = 0.3 * rms_slope(height);
    const double cap = 0.35 * rms_slope(height);
    const contact::State state = solve_unit(height, mean_pressure, cap).state;
    compact_steps += state.compact_steps;
    EXPECT_TRUE(state.convergence.converged()) << "seed " << seed;
    EXPECT_NEAR(state.pressure.mean() / mean_pressure, 1, 1e-10);
    EXPECT_LE(certificate_of(height, state.pressure, mean_pressure, cap), 1e-6);
  }
  EXPECT_GT(compact_steps, 0) << "no surface took the step that this test is about";
}

}  // namespace
}  // namespace tabor::test
