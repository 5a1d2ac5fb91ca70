#include "tabor/ehl/impact/squeeze.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/rejection.hpp"
#include "support/stopping.hpp"
#include "support/validation.hpp"

namespace tabor::ehl {
namespace {

using std::numbers::pi;
using test::expect_within;

/// The roller of Larsson's thesis, paper C.
SqueezeProblem roller(double sliding_speed) {
  SqueezeProblem problem;
  problem.mass = 30.2;
  problem.radius = 9.2e-3;
  problem.spring = 2.2e10;
  problem.speed = 0.25;
  problem.viscosity = 0.5;
  problem.pressure_coefficient = 1.5e-8;
  problem.layer = 0.4e-3;
  problem.sliding_speed = sliding_speed;
  return problem;
}

TEST(LinearSqueeze, HasItsForceAheadOfItsDisplacement) {
  const LinearSqueeze linear{.mass = 1, .stiffness = 1, .damping = 0.6, .speed = 1};
  EXPECT_NEAR(linear.time_max_displacement(), 1.32724, 5e-6);
  EXPECT_NEAR(linear.time_max_force(), 0.68843, 5e-6);
  EXPECT_NEAR(linear.phase(), 0.60939, 5e-6);
  EXPECT_NEAR(std::sin(linear.phase()), 0.6 * std::sqrt(1 - 0.09), 1e-12);
  const double peak = linear.force(linear.time_max_force());
  for (const double dt : {-1e-3, 1e-3}) {
    EXPECT_LT(linear.force(linear.time_max_force() + dt), peak);
    EXPECT_LT(linear.displacement(linear.time_max_displacement() + dt),
              linear.displacement(linear.time_max_displacement()));
  }
}

TEST(LinearSqueeze, ObeysItsEquationOfMotion) {
  const LinearSqueeze linear{.mass = 30, .stiffness = 2e10, .damping = 5e5, .speed = 0.2};
  const double dt = 1e-7;
  for (const double t : {2e-5, 7e-5}) {
    const double acceleration =
        (linear.displacement(t + dt) - 2 * linear.displacement(t) + linear.displacement(t - dt)) /
        (dt * dt);
    EXPECT_NEAR(linear.mass * acceleration / linear.force(t), -1, 1e-4);
  }
}

TEST(SqueezeSlideLoad, IsMartinsWithoutSqueezeAndTheCylindersWithoutSliding) {
  SqueezeProblem problem = roller(2);
  problem.pressure_coefficient = 0;
  const double film = 3e-6;
  // u_m = Vs/2; 4.8950 eta u R/h0
  expect_within("EHL", "squeeze and slide, sliding only", "load, relative", "Martin 1916",
                std::abs(squeeze_slide_load(problem, film, 0) /
                             (4.8950 * problem.viscosity * 1 * problem.radius / film) -
                         1),
                2e-5);
  problem.sliding_speed = 0;
  const double squeeze =
      3 * std::sqrt(2.0) * pi * problem.viscosity * 0.1 * std::pow(problem.radius / film, 1.5);
  expect_within("EHL", "squeeze and slide, squeeze only", "load, relative",
                "3 sqrt(2) pi eta v (R/h0)^1.5",
                std::abs(squeeze_slide_load(problem, film, -0.1) / squeeze - 1), 1e-8);
  EXPECT_EQ(squeeze_slide_load(problem, film, 0.1), 0);
}

TEST(SqueezeSlideLoad, FallsFromClosingToOpeningWithoutAJump) {
  const SqueezeProblem problem = roller(5);
  double before = std::numeric_limits<double>::infinity();
  for (double speed = -2e-3; speed <= 2e-3; speed += 1e-4) {
    const double load = squeeze_slide_load(problem, 20e-6, speed);
    EXPECT_GT(load, 0);
    EXPECT_LT(load, before);
    EXPECT_TRUE(std::isinf(before) || load > 0.8 * before);
    before = load;
  }
}

TEST(SqueezeSlideLoad, IsInfiniteWhereBarussLawBlowsUp) {
  EXPECT_TRUE(std::isinf(squeeze_slide_load(roller(5), 1e-7, -0.1)));
}

TEST(SolveSqueeze, StopsAtAnyQuestion) {
  SqueezeProblem problem = roller(5);
  problem.time_step = problem.layer / (100 * problem.speed);
  test::expect_to_stop_at_once([&](const Observer& observer) {
    const SqueezeResult result = solve_squeeze(problem, observer);
    EXPECT_TRUE(result.reason.empty());
    return result.convergence;
  });
}

TEST(SolveSqueeze, TurnsWithTheFilmStillClosing) {
  const SqueezeResult result = solve_squeeze(roller(5));
  ASSERT_TRUE(result.convergence.converged());
  EXPECT_TRUE(result.gap_closing_at_turning);
  expect_within("EHL", "squeeze and slide, Vs = 5 m/s", "turning of the roller, ms",
                "Larsson's thesis, paper C: 1.72", std::abs(result.turning_time * 1e3 - 1.72),
                0.01);
  expect_within("EHL", "squeeze and slide, Vs = 5 m/s", "film behind force, ms",
                "Larsson's thesis, paper C: 0.06", std::abs(result.lag * 1e3 - 0.06), 0.005);
}

TEST(SolveSqueeze, CarriesLessOnAThickerFilmWhenItSlides) {  // slow
  double force = std::numeric_limits<double>::infinity();
  double film = 0;
  for (const double speed : {0.0, 5.0, 10.0, 20.0}) {
    const SqueezeResult result = solve_squeeze(roller(speed));
    EXPECT_LT(result.max_force, force) << speed;
    EXPECT_GT(result.min_film, film) << speed;
    force = result.max_force;
    film = result.min_film;
  }
  const double ratio = solve_squeeze(roller(8)).min_film / solve_squeeze(roller(0)).min_film;
  expect_within("EHL", "squeeze and slide", "smallest film at 8 m/s over that at rest",
                "Larsson's thesis, paper C: 1.6", std::abs(ratio - 1.6), 0.05);
}

TEST(SolveSqueeze, HardlyDependsOnTheTimeStep) {
  SqueezeProblem coarse = roller(5);
  coarse.time_step = 4e-6;
  const SqueezeResult a = solve_squeeze(coarse);
  const SqueezeResult b = solve_squeeze(roller(5));
  EXPECT_NEAR(a.max_force / b.max_force, 1, 2e-3);
  EXPECT_NEAR(a.min_film / b.min_film, 1, 2e-3);
}

TEST(SolveSqueeze, TellsWhereTheTimeStepDecides) {
  const SqueezeResult fine = solve_squeeze(roller(5));
  EXPECT_TRUE(fine.warnings.empty());
  for (const double step : {5e-6, 1e-5, 1e-4, 1.0}) {
    SqueezeProblem problem = roller(5);
    problem.time_step = step;
    const SqueezeResult result = solve_squeeze(problem);
    const bool is_right = std::abs(result.max_force / fine.max_force - 1) < 5e-3;
    const bool is_told = !result.warnings.empty() && result.warnings.front().code == "coarse-steps";
    EXPECT_EQ(is_told, !is_right) << step;
  }
}

TEST(SolveSqueeze, RejectsWhatMakesNoSense) {
  SqueezeProblem problem = roller(5);
  problem.spring = 0;
  EXPECT_THAT(test::rejection([&] { solve_squeeze(problem); }), testing::HasSubstr("spring"));
  problem = roller(-1);
  EXPECT_THAT(test::rejection([&] { solve_squeeze(problem); }), testing::HasSubstr("sliding"));
}

TEST(SolveSqueeze, EndsForAnyNumbers) {
  const double extremes[] = {1e-299, 1e-30, 1e-6, 1, 1e6, 1e30, 1e299};
  int n_sound = 0;
  for (double SqueezeProblem::*value :
       {&SqueezeProblem::mass, &SqueezeProblem::radius, &SqueezeProblem::spring,
        &SqueezeProblem::viscosity, &SqueezeProblem::layer, &SqueezeProblem::sliding_speed,
        &SqueezeProblem::pressure_coefficient}) {
    for (const double factor : extremes) {
      SqueezeProblem problem = roller(5);
      problem.*value *= factor;
      if (!std::isfinite(problem.*value)) continue;
      problem.time_step = problem.layer / (50 * problem.speed);
      const SqueezeResult result = solve_squeeze(problem);
      n_sound += result.convergence.converged() ? 1 : 0;
      EXPECT_TRUE(!result.convergence.converged() ||
                  (std::isfinite(result.max_force) && result.min_film > 0));
    }
  }
  EXPECT_GE(n_sound, 7);  // those of the factor 1
}

TEST(SolveSqueeze, SaysWhereNoFilmBalancesTheRoller) {
  SqueezeProblem problem = roller(5);
  problem.mass = 3.02e-299;
  problem.spring = 1608821387429.9956;
  const SqueezeResult result = solve_squeeze(problem);
  EXPECT_EQ(result.convergence.status, Status::stalled);
  EXPECT_THAT(result.reason, testing::HasSubstr("no film balances the roller"));
}

TEST(SolveSqueeze, RejectsStepsThatNeverReachTheEnd) {
  SqueezeProblem problem = roller(5);
  problem.time_step = 1e-300;
  EXPECT_THROW(solve_squeeze(problem), InputError);
}

}  // namespace
}  // namespace tabor::ehl
