// Estimated errors of grid and domain beside those that finer grids and larger domains show.
#include "tabor/ehl/point/accuracy.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>

#include "ehl/point/moes.hpp"

namespace tabor::ehl {
namespace {

using test::film_at_centre;
using test::moes_case;

double film_of(const PointProblem& problem) {
  const PointResult result = solve_point(problem);
  EXPECT_TRUE(result.convergence.converged());
  return film_at_centre(problem, result);
}

PointProblem with_nodes(PointProblem problem, Index nodes) {
  problem.nodes_x = problem.nodes_y = nodes;
  return problem;
}

/// Compares estimates on these grids with the limit of finer ones.
void expect_within_a_factor_of_two(const PointProblem& problem,
                                   std::initializer_list<Index> grids) {
  const double fine = film_of(with_nodes(problem, 193));
  const double finest = film_of(with_nodes(problem, 257));
  // Of second order: 193 and 257 nodes have spacings of 4 to 3.
  const double limit = finest + (finest - fine) * 9 / 7;
  for (const Index nodes : grids) {
    const PointProblem coarse = with_nodes(problem, nodes);
    const double error = 1 - film_of(coarse) / limit;
    EXPECT_GT(point_grid_error(coarse), error / 2) << nodes;
    EXPECT_LT(point_grid_error(coarse), error * 2) << nodes;
  }
}

TEST(PointGridError, IsWithinAFactorOfTwoOfThatOfFinerGrids) {
  for (const auto& [M, L] : {std::pair{20.0, 0.0}, {100.0, 0.0}, {100.0, 10.0}, {500.0, 0.0}}) {
    SCOPED_TRACE(fmt::format("M = {}, L = {}", M, L));
    expect_within_a_factor_of_two(moes_case(M, L, 65), {65, 97, 129});
  }
}

TEST(PointGridError, IsWithinAFactorOfTwoWhereTheOilThins) {
  PointProblem problem = moes_case(1500, 13, 97);
  problem.lubricant.shear = material::ree_eyring_shear(6.8e6);
  problem.sliding_speed = 2 * problem.entrainment_speed;
  expect_within_a_factor_of_two(problem, {97, 129, 193});
}

/// The domain in half axes, 1.5 to 1, with nodes of one spacing.
PointProblem on_domain(double M, double half_width) {
  PointProblem problem = moes_case(M, 0, 0);
  constexpr double spacing = 0.12;
  problem.inlet = 1.5 * half_width;
  problem.half_width = half_width;
  problem.outlet = 3;
  problem.nodes_x = 1 + std::llround((problem.inlet + problem.outlet) / spacing);
  problem.nodes_y = 1 + std::llround(2 * half_width / spacing);
  return problem;
}

TEST(PointDomainError, IsThatOfALightlyLoadedBallWithinAFactorOfOneAndAHalf) {
  const double small = film_of(on_domain(5, 8));
  const double large = film_of(on_domain(5, 16));
  // The error falls with the reciprocal of the domain's size.
  const double limit = large + (large - small);
  for (const double ratio : {point_domain_error(on_domain(5, 8)) / (1 - small / limit),
                             point_domain_error(on_domain(5, 16)) / (1 - large / limit)}) {
    EXPECT_GT(ratio, 1 / 1.5);
    EXPECT_LT(ratio, 1.5);
  }
}

TEST(PointDomainError, HalvesWithTwiceTheDomain) {
  for (const double M : {1.0, 5.0, 100.0}) {
    EXPECT_NEAR(point_domain_error(on_domain(M, 8)) / point_domain_error(on_domain(M, 16)), 2,
                1e-9);
  }
}

TEST(ChosenDomain, HasErrorsOfAHundredth) {
  for (const auto& [M, L] : {std::pair{5.0, 0.0}, {20.0, 5.0}, {100.0, 10.0}, {300.0, 0.0}}) {
    const PointProblem problem = with_domain_chosen(moes_case(M, L, 257), true, 200);
    EXPECT_LT(point_grid_error(problem), 0.0101) << M << ' ' << L;
    EXPECT_LT(point_domain_error(problem), 0.0101) << M << ' ' << L;
    EXPECT_GE(problem.inlet, 4.5);
    EXPECT_GE(problem.half_width, 3);
    EXPECT_GE(problem.outlet, 1.5);
  }
}

TEST(ChosenDomain, KeepsTheNodesThatAreGiven) {
  const PointProblem problem = with_domain_chosen(moes_case(5, 0, 65), false, 200);
  EXPECT_EQ(problem.nodes_x, 65);
  EXPECT_EQ(problem.nodes_y, 65);
  EXPECT_LT(point_domain_error(problem), 0.0101);
}

/// What is said of a film that was solved.
bool says(const PointResult& result, const std::string& words) {
  return std::any_of(result.warnings.begin(), result.warnings.end(), [&](const auto& warning) {
    return warning.text.find(words) != std::string::npos;
  });
}

TEST(PointWarnings, SayHowFarGridAndDomainAreOff) {
  const PointResult coarse = solve_point(moes_case(1000, 0, 97));
  EXPECT_TRUE(says(coarse, "many nodes"));
  EXPECT_FALSE(says(coarse, "domain"));
  const PointResult light = solve_point(on_domain(5, 8));
  EXPECT_TRUE(says(light, "grid.domain = \"auto\""));
  EXPECT_FALSE(says(light, "many nodes"));
  const PointResult fine = solve_point(moes_case(100, 0, 129));
  EXPECT_FALSE(says(fine, "many nodes") || says(fine, "grid.domain"));
}

}  // namespace
}  // namespace tabor::ehl
