// Surfaces of few levels, on which the answer is decided by ties, against an independent solution
// in extended precision.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "contact/exact.hpp"
#include "contact/surfaces.hpp"

namespace tabor::test {
namespace {

constexpr double kNoCap = contact::kNoSaturation;
constexpr contact::Solver kSolvers[] = {contact::Solver::fast, contact::Solver::polonsky_keer};

struct Shape {
  std::string name;
  std::function<double(Index y, Index x)> height;
};

std::vector<Shape> shapes() {
  const auto wave = [](Index k, double length) {
    return std::cos(2 * std::numbers::pi * static_cast<double>(k) / length);
  };
  return {{"crossed waves", [=](Index y, Index x) { return wave(x, 4) * wave(y, 4); }},
          {"wave", [=](Index, Index x) { return wave(x, 8); }},
          {"sum of waves", [=](Index y, Index x) { return wave(x + 1, 4) + wave(y, 8); }},
          {"step", [](Index, Index x) { return x < 4 ? 1.0 : 0.0; }},
          {"checkerboard", [](Index y, Index x) { return (x + y) % 2 == 0 ? 1.0 : 0.0; }},
          {"coarse checkerboard", [](Index y, Index x) { return (x / 2 + y / 2) % 2 ? 1.0 : 0.0; }},
          {"terraces",
           [](Index y, Index x) {
             return static_cast<double>((x / 2) % 2) + 0.5 * static_cast<double>((y / 2) % 2);
           }},
          {"levels", [](Index y, Index x) {
             return std::floor(3 * CounterRandom(5).uniform(static_cast<std::uint64_t>(8 * y + x)));
           }}};
}

Field sampled(const Shape& shape, double amplitude) {
  Field height(8, 8);
  for (Index y = 0; y < 8; ++y) {
    for (Index x = 0; x < 8; ++x) height(y, x) = amplitude * shape.height(y, x);
  }
  return height;
}

/// Pixels whose state differs; those that are at a bound by less than the tolerance can tell do not
/// count.
Index differing(const Mask& found, const Mask& wanted, const Field& exact_gap, double resolution) {
  return (found != wanted && exact_gap.abs() > resolution).count();
}

void expect_exact(const Shape& shape, double mean_pressure, double cap, bool periodic) {
  const Field height = sampled(shape, 0.01);
  const Exact exact = solve_exactly(height, square(8), mean_pressure, cap, periodic);
  ASSERT_TRUE(exact.finished) << "the reference itself did not finish";
  const double rms = std::sqrt((height - height.mean()).square().mean());
  for (const auto solver : kSolvers) {
    SCOPED_TRACE(shape.name + (solver == contact::Solver::fast ? ", fast" : ", Polonsky-Keer"));
    const auto [state, summary] = solve_unit(height, mean_pressure, cap, 1e-8, solver, periodic);
    EXPECT_TRUE(state.convergence.converged()) << state.convergence.certificate;
    EXPECT_LE(state.gap_error, state.gap_limit);
    EXPECT_EQ(differing(state.pressure > 0, exact.pressure > 0, exact.gap, 1e-6 * rms), 0);
    const Mask saturated = contact::saturated_mask(state, cap);
    EXPECT_EQ(differing(saturated, exact.pressure >= (1 - 1e-12) * cap, exact.gap, 1e-4 * rms), 0);
    EXPECT_NEAR(state.separation, exact.separation, 1e-5 * rms);
    EXPECT_NEAR(summary.mean_gap, exact.gap.max(0.0).mean(), 1e-5 * rms);
  }
}

TEST(StructuredContact, IsThatOfExtendedPrecision) {
  for (const Shape& shape : shapes()) {
    for (const double mean_pressure : {1e-7, 1e-5, 1e-3, 0.011}) {
      for (const bool periodic : {true, false}) {
        SCOPED_TRACE(fmt::format("P = {}, {}", mean_pressure, periodic ? "periodic" : "free"));
        expect_exact(shape, mean_pressure, kNoCap, periodic);
      }
    }
  }
}

TEST(StructuredContact, IsThatOfExtendedPrecisionWithACap) {
  for (const Shape& shape : shapes()) {
    for (const double share : {0.03, 0.31, 0.77, 0.996, 1 - 1e-7}) {
      for (const double cap : {1e-6, 1e-3}) {
        SCOPED_TRACE(fmt::format("P / p_sat = {}, p_sat = {}", share, cap));
        expect_exact(shape, share * cap, cap, true);
      }
    }
  }
}

// 200 random states; pressures at the cap but for rounding were counted as below it once.
TEST(SaturatedContact, BothSolversAgreeOnWhatIsAtTheCap) {
  const CounterRandom random(16);
  int n_saturated = 0;
  for (std::uint64_t state = 0; state < 200; ++state) {
    const auto draw = [&](std::uint64_t k) { return random.uniform(8 * state + k); };
    const auto n = static_cast<Index>(6 + 6 * draw(0));
    Field height(n, n);
    for (Index i = 0; i < height.size(); ++i) {
      height(i) = 0.01 * random.normal(1000000 + 1000 * state + static_cast<std::uint64_t>(i));
    }
    const double cap = std::pow(10, -4 + 3 * draw(1));
    const double mean_pressure = cap * (0.02 + 0.96 * draw(2));
    const Solved fast = solve_unit(height, mean_pressure, cap, 1e-9);
    const Solved textbook =
        solve_unit(height, mean_pressure, cap, 1e-9, contact::Solver::polonsky_keer);
    SCOPED_TRACE(fmt::format("state {}: {} pixels, p_sat {}, P {}", state, n, cap, mean_pressure));
    EXPECT_TRUE(fast.state.convergence.converged()) << fast.state.convergence.certificate;
    EXPECT_TRUE(textbook.state.convergence.converged()) << textbook.state.convergence.certificate;
    const double pixel = 1.0 / static_cast<double>(height.size());
    EXPECT_NEAR(fast.summary.saturated_area_fraction, textbook.summary.saturated_area_fraction,
                1.01 * pixel);
    EXPECT_NEAR(fast.summary.contact_area_fraction_pixels,
                textbook.summary.contact_area_fraction_pixels, 1.01 * pixel);
    EXPECT_NEAR(fast.summary.mean_gap, textbook.summary.mean_gap, 1e-5 * 0.01);
    EXPECT_NEAR(fast.state.separation, textbook.state.separation, 1e-5 * 0.01);
    n_saturated += fast.summary.saturated_area_fraction > 0 ? 1 : 0;
  }
  EXPECT_GT(n_saturated, 150) << "too few states for what this test is about";
}

}  // namespace
}  // namespace tabor::test
