// Contacts at a given separation, under a given force, and from a given start.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "contact/surfaces.hpp"
#include "support/rejection.hpp"
#include "support/stopping.hpp"
#include "support/validation.hpp"
#include "tabor/core/error.hpp"
#include "tabor/reference/hertz.hpp"
#include "tabor/reference/waves.hpp"

namespace tabor::test {
namespace {

using contact::kNoSaturation;
using contact::Separation;
using testing::HasSubstr;

/// Solves with E* = 1 on a unit square under any control.
contact::State solve_under(const Field& height, contact::Control control,
                           double cap = kNoSaturation, double tolerance = 1e-6,
                           bool periodic = true, contact::Solver solver = contact::Solver::fast) {
  const Grid grid = square(height.cols());
  const auto elasticity =
      periodic ? elastic::make_periodic(grid, 1.0) : elastic::make_free(grid, 1.0);
  const contact::Problem problem{
      .height = height, .control = control, .bounds = {.upper = cap}, .tolerance = tolerance};
  return contact::solve(*elasticity, problem, solver);
}

/// A paraboloid of radius 1, its tip at height 0 on a pixel of the unit square.
Field ball(Index n) {
  Field height(n, n);
  const double h = 1.0 / static_cast<double>(n);
  for (Index y = 0; y < n; ++y) {
    for (Index x = 0; x < n; ++x) {
      const double r =
          h * std::hypot(static_cast<double>(x - n / 2), static_cast<double>(y - n / 2));
      height(y, x) = -0.5 * r * r;
    }
  }
  return height;
}

TEST(SolveSeparation, FindsHertzForceFromTheApproach) {
  const Index n = 161;
  for (const double pixels : {10.0, 25.0, 40.0}) {
    const double radius = pixels / static_cast<double>(n);
    const auto hertz = reference::hertz_at_load(1.0, 1.0, 4.0 / 3 * std::pow(radius, 3));
    const contact::State state =
        solve_under(ball(n), Separation{-hertz.approach}, kNoSaturation, 1e-9, false);
    ASSERT_TRUE(state.convergence.converged());
    EXPECT_EQ(state.separation, -hertz.approach);
    expect_within("Contact", fmt::format("Hertz at a separation, free, a/h = {}", pixels),
                  "force, relative", "Hertz 1882", std::abs(state.mean_pressure / hertz.load - 1),
                  pixels < 20 ? 1e-3 : 2e-4);
  }
}

TEST(SolveSeparation, FindsWestergaardPressureFromTheMeanGap) {
  const Index n = 256;
  const reference::WestergaardWave exact{0.01, 1.0, 1.0};
  Field height = wave(n, 0.01, false).topRows(4);
  const Grid grid{n, 4, 1.0, 4.0 / static_cast<double>(n)};
  const auto elasticity = elastic::make_periodic(grid, 1.0);
  for (const double ratio : {0.05, 0.3, 0.7, 0.95}) {
    const double pressure = ratio * exact.full_contact_pressure();
    const contact::State state = contact::solve(
        *elasticity,
        {.height = height, .control = Separation{exact.separation(pressure)}, .tolerance = 1e-9});
    ASSERT_TRUE(state.convergence.converged());
    EXPECT_NEAR(state.gap.mean(), exact.separation(pressure), 1e-6 * 0.01);
    expect_within("Contact", fmt::format("Westergaard wave at a separation, P/p* = {}", ratio),
                  "mean pressure, relative", "D (1 - r + r ln r)",
                  std::abs(state.mean_pressure / pressure - 1), 6e-4);
  }
}

/// Pressure that leads to a separation, and the one that the separation leads back to.
void expect_round_trip(const Field& height, double pressure, double cap, bool periodic,
                       contact::Solver solver = contact::Solver::fast) {
  SCOPED_TRACE(fmt::format("P = {}, cap = {}, {}", pressure, cap, periodic ? "periodic" : "free"));
  const contact::State there =
      solve_under(height, contact::MeanPressure{pressure}, cap, 1e-8, periodic, solver);
  const contact::State back =
      solve_under(height, Separation{there.separation}, cap, 1e-8, periodic, solver);
  ASSERT_TRUE(back.convergence.converged());
  EXPECT_EQ(back.separation, there.separation);
  EXPECT_LE(back.gap_error, back.gap_limit);
  EXPECT_LE(back.convergence.certificate, 1e-8);
  EXPECT_NEAR(back.mean_pressure / pressure, 1, 1e-6);
  EXPECT_NEAR(back.pressure.mean() / back.mean_pressure, 1, 1e-10);
  EXPECT_LE((back.pressure - there.pressure).abs().mean() / pressure, 1e-3);
}

TEST(SolveSeparation, LeadsBackToThePressure) {
  const Field height = self_affine(128, 0.8, 1, 32, 3);
  for (const bool periodic : {true, false}) {
    for (const double pressure : {1e-4, 0.01, 0.1, 0.5}) {
      expect_round_trip(height, pressure, kNoSaturation, periodic);
    }
    expect_round_trip(height, 0.02, 0.3, periodic);
    expect_round_trip(height, 0.2, 0.3, periodic);
  }
  expect_round_trip(height, 0.05, kNoSaturation, true, contact::Solver::polonsky_keer);
}

TEST(SolveSeparation, LeadsBackByWayOfCoarserGrids) {
  const Field height = self_affine(256, 0.8, 2, 64, 5);
  expect_round_trip(height, 1e-4, kNoSaturation, true);
  expect_round_trip(height, 0.02, 0.3, true);
}

TEST(SolveSeparation, PressesHarderTheCloserTheFlatIs) {
  const Field height = self_affine(64, 0.8, 1, 16, 4);
  for (const double cap : {kNoSaturation, 0.3}) {
    double before = 0;
    for (const double share : {1 - 1e-9, 0.999, 0.9, 0.6, 0.3, 0.1, 0.01}) {
      const double mean = height.mean();
      const double separation = mean + share * (height.maxCoeff() - mean);
      const contact::State state = solve_under(height, Separation{separation}, cap);
      ASSERT_TRUE(state.convergence.converged()) << share;
      EXPECT_GT(state.mean_pressure, before) << share;
      before = state.mean_pressure;
    }
  }
}

TEST(SolveSeparation, OfALonePixelIsItsCompliance) {
  Field height = Field::Zero(32, 32);
  height(16, 16) = 0.01;
  const double compliance = elastic::love_coefficient(0, 0, 1.0 / 32, 1.0 / 32, 1.0);
  const contact::State state = solve_under(height, Separation{0.008}, kNoSaturation, 1e-6, false);
  ASSERT_TRUE(state.convergence.converged());
  EXPECT_NEAR(state.mean_pressure * 32 * 32 * compliance / 0.002, 1, 1e-5);
}

// Of a light contact the gap must close to a millionth of the rms height, whatever P is.
TEST(SolveSeparation, ClosesTheGapOfLightContactsToo) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Field height = self_affine(64, 0.8, 1, 16, seed);
    for (const double share : {0.999, 0.95, 0.8, 0.6}) {
      for (const bool periodic : {true, false}) {
        const contact::State state = solve_under(height, Separation{share * height.maxCoeff()},
                                                 kNoSaturation, 1e-6, periodic);
        EXPECT_TRUE(state.convergence.converged()) << seed << ' ' << share << ' ' << periodic;
      }
    }
  }
}

// Where all contact is saturated, one load holds the flat anywhere between two separations.
TEST(SolveSeparation, EndsOnTheStepsOfASaturatedContact) {
  Field height = Field::Constant(16, 16, -1);
  height(3, 4) = 0;
  height(3, 5) = -0.001;
  height(10, 11) = -0.01;
  const double cap = 1e-3;
  for (const bool periodic : {true, false}) {
    for (const double separation : {-0.004, -0.006, -0.008}) {
      const contact::State state = solve_under(height, Separation{separation}, cap, 1e-6, periodic);
      EXPECT_TRUE(state.convergence.converged()) << separation;
      EXPECT_EQ(state.separation, separation);
      EXPECT_NEAR(state.mean_pressure / (2 * cap / 256), 1, 1e-10);
      EXPECT_EQ(contact::saturated_mask(state, cap).count(), 2);
      EXPECT_EQ(contact::contact_mask(state).count(), 2);
      EXPECT_NEAR(state.gap(3, 4), state.displacement(3, 4) + separation, 1e-12);
    }
  }
}

// The zero of heights may be anywhere, far away too.
TEST(SolveSeparation, MovesWithTheZeroOfHeights) {
  const Field height = self_affine(64, 0.8, 1, 16, 4);
  const double separation = 0.5 * height.maxCoeff();
  const contact::State here = solve_under(height, Separation{separation});
  for (const double offset : {-0.3, 40.0}) {
    const contact::State there = solve_under(height + offset, Separation{separation + offset});
    EXPECT_DOUBLE_EQ(there.separation, separation + offset);
    EXPECT_NEAR(there.mean_pressure / here.mean_pressure, 1, 1e-5);
  }
}

TEST(SolveSeparation, RejectsAFlatThatDoesNotTouch) {
  const Field height = wave(32, 0.01, true);
  for (const double far : {height.maxCoeff(), 0.02, 1.0, std::numeric_limits<double>::infinity()}) {
    EXPECT_THAT(rejection([&] { solve_under(height, Separation{far}); }),
                HasSubstr("does not touch"))
        << far;
  }
  EXPECT_THAT(rejection([&] { solve_under(height, Separation{std::nan("")}); }),
              HasSubstr("separation"));
}

TEST(SolveSeparation, RejectsAFlatThatNoPressureBringsSoNear) {
  const Field height = wave(32, 0.01, true);
  for (const double near : {0.0, -0.02, -std::numeric_limits<double>::infinity()}) {
    EXPECT_THAT(rejection([&] { solve_under(height, Separation{near}); }), HasSubstr("mean height"))
        << near;
  }
  EXPECT_THAT(rejection([&] { solve_under(height, Separation{-0.02}, 0.05); }),
              HasSubstr("every pixel saturates"));
  // A body that ends is pressed in as far as one likes.
  EXPECT_TRUE(
      solve_under(height, Separation{-0.02}, kNoSaturation, 1e-6, false).convergence.converged());
}

TEST(SolveSeparation, StopsAtAnyQuestion) {
  const Field height = self_affine(128, 0.8, 1, 32, 1);
  const auto elasticity = elastic::make_periodic(square(128), 1.0);
  const double separation = 0.5 * height.maxCoeff();
  for (const double cap : {kNoSaturation, 0.3}) {
    const contact::Problem problem{
        .height = height, .control = Separation{separation}, .bounds = {.upper = cap}};
    expect_to_stop_at_once([&](const Observer& observer) {
      const auto state = contact::solve(*elasticity, problem, contact::Solver::fast, observer);
      EXPECT_NEAR(state.pressure.mean() / state.mean_pressure, 1, 1e-10);
      return state.convergence;
    });
  }
}

TEST(SolveSeparation, SaysSoWhenItRunsOutOfIterations) {
  const Field height = self_affine(64, 0.8, 1, 32, 1);
  const auto elasticity = elastic::make_periodic(square(64), 1.0);
  const contact::Problem problem{
      .height = height, .control = Separation{0.5 * height.maxCoeff()}, .max_iterations = 1};
  const Convergence ended = contact::solve(*elasticity, problem).convergence;
  EXPECT_EQ(ended.status, Status::iteration_limit);
}

TEST(SolveForce, IsAMeanPressureTimesTheArea) {
  const Field height = wave(32, 0.01, true);
  const Grid grid = square(32, 2.0);
  const auto elasticity = elastic::make_free(grid, 1.0);
  const auto by_force =
      contact::solve(*elasticity, {.height = height, .control = contact::Force{0.04}});
  const auto by_pressure =
      contact::solve(*elasticity, {.height = height, .control = contact::MeanPressure{0.01}});
  EXPECT_EQ(by_force.mean_pressure, 0.01);
  EXPECT_TRUE((by_force.pressure == by_pressure.pressure).all());
}

TEST(SolveForce, RejectsASurfaceThatRepeats) {
  const Field height = wave(32, 0.01, true);
  EXPECT_THAT(rejection([&] { solve_under(height, contact::Force{1.0}); }),
              HasSubstr("repeats without end"));
  for (const double bad : {0.0, -1.0, std::nan("")}) {
    EXPECT_THAT(
        rejection([&] { solve_under(height, contact::Force{bad}, kNoSaturation, 1e-6, false); }),
        HasSubstr("positive pressure"));
  }
}

TEST(SolveForce, NamesTheForceUnderWhichAllSaturates) {
  const Field height = wave(32, 0.01, true);  // on a unit square
  EXPECT_THAT(rejection([&] { solve_under(height, contact::Force{2.0}, 0.5, 1e-6, false); }),
              AllOf(HasSubstr("<force>: got 2 N"), HasSubstr("less than 500 mN")));
}

TEST(SolveContact, StartsFromAGivenPressure) {
  const Field height = self_affine(128, 0.8, 1, 32, 1);
  const auto elasticity = elastic::make_periodic(square(128), 1.0);
  for (const auto solver : {contact::Solver::fast, contact::Solver::polonsky_keer}) {
    contact::Problem problem{.height = height, .control = contact::MeanPressure{0.02}};
    const contact::State cold = contact::solve(*elasticity, problem, solver);
    problem.start = cold.pressure;
    const contact::State warm = contact::solve(*elasticity, problem, solver);
    EXPECT_TRUE(warm.convergence.converged());
    EXPECT_LT(warm.convergence.fft_pairs, 0.5 * cold.convergence.fft_pairs);
    EXPECT_LE((warm.pressure - cold.pressure).abs().mean() / 0.02, 1e-3);
  }
}

TEST(PressureList, IsTheMapThatItWasMadeOf) {
  Field map = Field::Zero(5, 7);
  EXPECT_TRUE((contact::PressureList(map).map() == map).all());
  map(0, 0) = 3;
  map(4, 6) = -2;
  map(2, 3) = 1e-300;
  const contact::PressureList list = map;
  EXPECT_EQ(list.values(), (std::vector<double>{3, 1e-300, -2}));
  EXPECT_TRUE((list.map() == map).all());
  EXPECT_TRUE(contact::PressureList().empty());
  EXPECT_TRUE(contact::PressureList(Field()).empty());
}

TEST(SolveContact, RejectsAStartThatIsNoPressureOnItsGrid) {
  const Field height = wave(32, 0.01, true);
  const auto elasticity = elastic::make_periodic(square(32), 1.0);
  Field negative = Field::Ones(32, 32);
  negative(3, 4) = -1;
  Field hole = Field::Ones(32, 32);
  hole(3, 4) = std::nan("");
  for (const Field& start : {Field(Field::Ones(32, 31)), negative, hole}) {
    const contact::Problem problem{
        .height = height, .control = contact::MeanPressure{0.01}, .start = start};
    EXPECT_THAT(rejection([&] { contact::solve(*elasticity, problem); }),
                HasSubstr("a pressure to start from"));
  }
}

}  // namespace
}  // namespace tabor::test
