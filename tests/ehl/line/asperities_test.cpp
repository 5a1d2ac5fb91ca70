#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "ehl/line/akchurin.hpp"
#include "support/stopping.hpp"
#include "support/validation.hpp"
#include "tabor/contact/contact.hpp"
#include "tabor/core/error.hpp"
#include "tabor/ehl/line/line.hpp"
#include "tabor/elastic/line.hpp"

namespace tabor::ehl {
namespace {

using test::expect_within;

/// Table 6 with waves that the load does not flatten and a boundary film of 30 nm.
LineProblem rough_contact(double speed) {
  LineProblem problem = test::table_6();
  problem.entrainment_speed = speed;
  problem.sliding_speed = 2 * speed;
  problem.inlet = 0.7e-3;
  problem.outlet = 0.2e-3;
  problem.roughness = line_waves(problem, 100e-9, 20e-6);
  problem.asperities = {.boundary_film = 30e-9, .friction_coefficient = 0.1};
  return problem;
}

constexpr double kMixed = 1.7e-3;  // [m/s]

TEST(LineAsperities, StopAtAnyQuestion) {
  const LineProblem problem = rough_contact(kMixed);
  test::expect_to_stop_at_once(
      [&](const Observer& observer) { return solve_line(problem, observer).convergence; });
}

/// Pressure [Pa] of a dry contact of bodies this far apart [m] before they deform.
Eigen::ArrayXd dry_pressure(const LineProblem& problem, const Eigen::ArrayXd& x,
                            const Eigen::ArrayXd& gap, double load) {
  const double spacing = x[1] - x[0];
  const double length = spacing * static_cast<double>(x.size());
  const auto elasticity =
      elastic::make_line({x.size(), 1, length, spacing}, problem.effective_modulus);
  const contact::State dry =
      contact::solve(*elasticity, {.height = -gap.transpose(),
                                   .control = contact::MeanPressure{load / length},
                                   .tolerance = 1e-10});
  EXPECT_TRUE(dry.convergence.converged());
  return dry.pressure.row(0).transpose();
}

Eigen::ArrayXd undeformed_gap(const LineProblem& problem, const Eigen::ArrayXd& x) {
  return x.square() / (2 * problem.radius) - problem.roughness;
}

/// Largest difference of two pressures over the largest pressure.
double difference(const Eigen::ArrayXd& pressure, const Eigen::ArrayXd& expected) {
  return (pressure - expected).abs().maxCoeff() / expected.maxCoeff();
}

TEST(LineAsperities, DoNothingUnderAFilmThickerThanTheBoundaryFilm) {
  const LineProblem problem = rough_contact(2e-2);
  LineProblem smooth = problem;
  smooth.asperities = {};
  const LineResult with = solve_line(problem);
  const LineResult without = solve_line(smooth);
  ASSERT_TRUE(with.convergence.converged());
  EXPECT_TRUE((with.pressure == without.pressure).all());
  EXPECT_TRUE((with.film == without.film).all());
  EXPECT_EQ(with.friction_coefficient, without.friction_coefficient);
  EXPECT_EQ(with.asperity_load_share, 0);
  EXPECT_TRUE((with.asperity_pressure == 0).all());
}

TEST(LineAsperities, CarryWhatTheDryContactDoesWhenNothingMoves) {
  LineProblem problem = rough_contact(1e-9);
  const LineResult slow = solve_line(problem);
  ASSERT_TRUE(slow.convergence.converged());
  const Eigen::ArrayXd dry =
      dry_pressure(problem, slow.x, undeformed_gap(problem, slow.x), problem.load);
  expect_within("EHL", "rough line contact at 1 nm/s", "pressure, relative to its peak",
                "dry contact solver", difference(slow.asperity_pressure, dry), 1e-5);
  EXPECT_NEAR(slow.asperity_load_share, 1, 1e-4);
  EXPECT_NEAR(slow.friction_solid, 0.1, 1e-5);
}

TEST(LineAsperities, ShareTheLoadWithTheLiquid) {
  const LineProblem problem = rough_contact(kMixed);
  const LineResult mixed = solve_line(problem);
  ASSERT_TRUE(mixed.convergence.converged());
  EXPECT_GT(mixed.asperity_load_share, 0.2);
  EXPECT_LT(mixed.asperity_load_share, 0.8);
  EXPECT_LE(mixed.mass_error, 1e-8);
  EXPECT_LE(mixed.contact_error, 1e-8);
  const double spacing = mixed.x[1] - mixed.x[0];
  const double carried = spacing * (mixed.pressure + mixed.asperity_pressure).sum();
  EXPECT_NEAR(carried / problem.load, 1, 1e-6);
  EXPECT_GE(mixed.pressure.minCoeff(), 0);
  EXPECT_GE(mixed.asperity_pressure.minCoeff(), 0);
  const double boundary_film = problem.asperities.boundary_film;
  EXPECT_GE(mixed.film.minCoeff(), boundary_film);
  // Where they press, nothing but the boundary film is between them.
  const double scale = mixed.asperity_pressure.maxCoeff();
  for (Index i = 0; i < mixed.x.size(); ++i) {
    const double overlap = mixed.film[i] / boundary_film - 1;
    EXPECT_LE(mixed.asperity_pressure[i] / scale * overlap, 1e-8) << i;
  }
  EXPECT_NEAR(mixed.friction_solid, 0.1 * mixed.asperity_load_share, 1e-12);
  EXPECT_NEAR(mixed.friction_coefficient, mixed.friction_fluid + mixed.friction_solid, 1e-12);
}

TEST(LineAsperities, PressAsTheDrySolverSaysOnceTheLiquidIsFrozen) {
  const LineProblem problem = rough_contact(kMixed);
  const LineResult mixed = solve_line(problem);
  ASSERT_TRUE(mixed.convergence.converged());
  const double spacing = mixed.x[1] - mixed.x[0];
  const auto n = static_cast<std::size_t>(mixed.x.size());
  const elastic::LineHalfSpace elasticity(mixed.x.size(), spacing, problem.effective_modulus);
  Eigen::ArrayXd lifted(mixed.x.size());
  elasticity.apply({mixed.pressure.data(), n}, {lifted.data(), n});
  const Eigen::ArrayXd dry =
      dry_pressure(problem, mixed.x, undeformed_gap(problem, mixed.x) + lifted,
                   problem.load - spacing * mixed.pressure.sum());
  expect_within("EHL", "mixed line contact", "pressure of asperities, relative to its peak",
                "dry contact solver over the surface that the liquid deforms",
                difference(mixed.asperity_pressure, dry), 1e-5);
}

TEST(LineAsperities, RaiseFrictionAsTheContactSlowsDown) {
  double share = 0;
  double friction = 1;
  std::vector<double> frictions;
  for (const double speed : {2e-2, 1e-2, 5e-3, 3e-3, kMixed, 5e-4}) {
    const LineResult result = solve_line(rough_contact(speed));
    ASSERT_TRUE(result.convergence.converged()) << speed;
    EXPECT_GE(result.asperity_load_share, share) << speed;
    share = result.asperity_load_share;
    frictions.push_back(result.friction_coefficient);
  }
  friction = frictions.front();
  EXPECT_GT(share, 0.7);
  // A Stribeck curve: down with the film's shear, then up with what the solids carry.
  EXPECT_LT(frictions[2], 0.8 * friction);
  EXPECT_GT(frictions.back(), 10 * friction);
}

TEST(LineAsperities, HaveAShearStrength) {
  LineProblem problem = rough_contact(kMixed);
  problem.asperities.friction_coefficient = 0;
  problem.asperities.shear_strength = 1e6;
  const LineResult mixed = solve_line(problem);
  EXPECT_GT(mixed.contact_width, 0);
  EXPECT_NEAR(mixed.friction_solid * problem.load / (1e6 * mixed.contact_width), 1, 1e-12);
}

TEST(LineAsperities, OfASmoothContactKeepTheBoundaryFilm) {
  LineProblem problem = rough_contact(1e-4);
  problem.roughness = {};
  const LineResult mixed = solve_line(problem);
  ASSERT_TRUE(mixed.convergence.converged());
  EXPECT_NEAR(mixed.min_film / 30e-9, 1, 1e-6);
  EXPECT_NEAR(mixed.contact_width / (2 * hertz_of(problem).half_width), 1, 0.03);
  EXPECT_NEAR(mixed.max_pressure / hertz_of(problem).max_pressure, 1, 0.01);
}

TEST(LineAsperities, AreRejectedWhereTheyMakeNoSense) {
  const auto rejected = [](void (*change)(Asperities&)) {
    LineProblem problem = rough_contact(kMixed);
    change(problem.asperities);
    EXPECT_THROW(solve_line(problem), InputError);
  };
  rejected([](Asperities& asperities) { asperities.boundary_film = -1e-9; });
  rejected([](Asperities& asperities) { asperities.boundary_film = std::nan(""); });
  rejected([](Asperities& asperities) { asperities.friction_coefficient = -0.1; });
  rejected([](Asperities& asperities) { asperities.shear_strength = -1; });
}

}  // namespace
}  // namespace tabor::ehl
