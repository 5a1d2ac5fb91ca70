// Films of point contacts beside computations and formulas of others; minutes under sanitizers.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "ehl/point/moes.hpp"
#include "support/independent.hpp"
#include "support/validation.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/core/random.hpp"

namespace tabor::ehl {
namespace {

using test::compressible;
using test::expect_within;
using test::film_at_centre;
using test::film_unit;
using test::moes_case;

struct Film {
  double central, minimum;  ///< over film_unit()
  double pressure;          ///< in the centre, over Hertz' largest
};

Film solved(const PointProblem& problem) {
  const PointResult result = solve_point(problem);
  EXPECT_TRUE(result.convergence.converged());
  const double unit = film_unit(problem);
  return {film_at_centre(problem, result) / unit, result.film.minCoeff() / unit,
          test::value_at_centre(problem, result.pressure) / hertz_of(problem).max_pressure};
}

/// Films on two grids, and where they tend with more nodes; the orders are second.
Film limit(const PointProblem& problem) {
  const auto on = [&](Index nodes) {
    PointProblem grid = problem;
    grid.nodes_x = grid.nodes_y = nodes;
    return solved(grid);
  };
  const Film coarse = on(129);
  const Film fine = on(257);
  return {fine.central + (fine.central - coarse.central) / 3,
          fine.minimum + (fine.minimum - coarse.minimum) / 3,
          fine.pressure + (fine.pressure - coarse.pressure) / 3};
}

void compare(const std::string& liquid, const PointProblem& problem) {
  const Film ours = limit(problem);
  const auto expect = [&](const char* quantity, double value, const char* key, double tolerance) {
    expect_within("EHL", "point contact, M = 20, L = 10, " + liquid + ", limit of the grids",
                  quantity, test::independent_source("point_film"),
                  std::abs(value / test::independent("point_film", {liquid, "limit", key}) - 1),
                  tolerance);
  };
  expect("central film, relative", ours.central, "central_film", 1e-3);
  expect("smallest film, relative", ours.minimum, "min_film", 4e-3);
  expect("central pressure, relative", ours.pressure, "central_pressure", 1e-3);
}

TEST(PointFilms, MoesTwentyTenAgreesWithAnIndependentComputation) {
  compare("compressible", compressible(moes_case(20, 10, 129)));
}

TEST(PointFilms, AnIncompressibleLiquidAgreesToo) {
  compare("incompressible", moes_case(20, 10, 129));
}

TEST(PointFilms, ConvergesToSecondOrder) {
  double film[3];
  Index nodes = 33;
  for (double& central : film) {
    central = solved(compressible(moes_case(20, 10, nodes))).central;
    nodes = 2 * nodes - 1;
  }
  EXPECT_GT((film[1] - film[0]) / (film[2] - film[1]), 2.5);
}

/// The contact of Redlich, Bartel and Deters: heavier than any grid of ours resolves well.
TEST(PointFilms, RedlichsContactAgreesWithTheFormulaToo) {
  PointProblem problem = moes_case(1892, 12.61, 205);
  problem.inlet = 2;
  problem.outlet = 1.4;
  problem.half_width = 1.7;
  expect_within("EHL", "point contact, M = 1892, L = 12.61, incompressible, 205 nodes in 3.4 a",
                "central film, relative", "Nijenbanning, Venner & Moes 1994",
                std::abs(solved(problem).central * film_unit(problem) /
                             film_groups_of(problem).nijenbanning_central() -
                         1),
                0.06);
}

TEST(PointFilms, AgreesWithTheFormulaOfNijenbanningVennerAndMoes) {
  const struct {
    double M, L, tolerance;
  } cases[] = {{20, 0, 0.05}, {100, 0, 0.08}, {100, 5, 0.05}, {200, 10, 0.06}, {1000, 15, 0.06}};
  for (const auto& at : cases) {
    const PointProblem problem = moes_case(at.M, at.L, 129);
    expect_within(
        "EHL", "point contact, M = " + test::json_number(at.M) + ", L = " + test::json_number(at.L),
        "central film, relative", "Nijenbanning, Venner & Moes 1994",
        std::abs(solved(problem).central * film_unit(problem) /
                     film_groups_of(problem).nijenbanning_central() -
                 1),
        at.tolerance);
  }
}

/// Rigid bodies: the film lies between that of Kapitza's pressure cut off at zero and the formula
/// for an infinite domain, since Reynolds' condition carries up to a fifth more load.
TEST(PointFilms, RigidBodiesCarryMoreThanHalfOfSommerfelds) {
  PointProblem problem = moes_case(0.05, 0, 129);
  problem.inlet = 8000;
  problem.outlet = 1000;
  problem.half_width = 6000;
  const PointResult result = solve_point(problem);
  ASSERT_TRUE(result.convergence.converged());
  const double viscosity = material::ambient_viscosity(problem.lubricant.viscosity);
  const double half = std::pow(10.6629 * viscosity * problem.entrainment_speed *
                                   std::pow(problem.radius_x, 1.5) / problem.load,
                               2);
  const double film = film_at_centre(problem, result);
  EXPECT_GT(film, half);
  EXPECT_LT(film, film_groups_of(problem).nijenbanning_central());
}

Field random_waves(const PointProblem& problem, double rms, const CounterRandom& random) {
  constexpr int kWaves = 60;
  const double half_axis = hertz_of(problem).half_axis_x;
  const Eigen::ArrayXd x = point_x(problem);
  const Eigen::ArrayXd y = point_y(problem);
  Field height = Field::Zero(problem.nodes_y, problem.nodes_x);
  for (std::uint64_t k = 0; k < kWaves; ++k) {
    const auto uniform = [&](std::uint64_t which) { return random.uniform(3 * k + which); };
    const double q = 2 * std::numbers::pi / (half_axis * (0.4 + 0.8 * uniform(0)));
    const double direction = 2 * std::numbers::pi * uniform(1);
    const double phase = 2 * std::numbers::pi * uniform(2);
    for (Index j = 0; j < y.size(); ++j) {
      height.row(j) +=
          (q * (x * std::cos(direction) + y[j] * std::sin(direction)) + phase).cos().transpose();
    }
  }
  return rms / std::sqrt(kWaves / 2.0) * height;
}

class RandomPointContacts : public testing::TestWithParam<double> {};

// The template of `tabor ehl point` on a finer grid: flow and deflection both matter over much of
// the contact, where the oil thins.
TEST(ThinningOil, IsSolvedOnFineGrids) {
  PointProblem problem;
  problem.radius_x = problem.radius_y = 1.5e-3;
  problem.load = 16.6;
  problem.effective_modulus = 230.8e9 / 2;
  problem.entrainment_speed = 0.05;
  problem.sliding_speed = 0.1;
  problem.lubricant.viscosity = material::roelands_viscosity(0.149, 2.131e-8);
  problem.lubricant.shear = material::ree_eyring_shear(6.8e6);
  problem.nodes_x = 450;
  problem.nodes_y = 394;
  const PointResult result = solve_point(problem);
  EXPECT_TRUE(result.convergence.converged());
  EXPECT_LE(result.n_linear_iterations, 25 * result.convergence.iterations);
}

TEST_P(RandomPointContacts, Converge) {
  constexpr int kCases = 50;
  const CounterRandom random(42);
  const int threads = thread_count();
  set_thread_count(1);  // the grids are small
  int converged = 0;
  for (std::uint64_t k = 0; k < kCases; ++k) {
    const auto uniform = [&](std::uint64_t which) { return random.uniform(10 * k + which); };
    PointProblem problem = moes_case(5 * std::pow(400, uniform(0)), 20 * uniform(1), 49);
    if (uniform(2) < 0.5) problem = compressible(problem);
    if (uniform(3) < 0.3) {
      problem.lubricant.shear = material::ree_eyring_shear(5e6);
      problem.sliding_speed = problem.entrainment_speed;
    }
    const double rms = GetParam() * uniform(4) * film_groups_of(problem).nijenbanning_central();
    if (rms > 0) problem.roughness = random_waves(problem, rms, CounterRandom(43, k));
    const PointResult result = solve_point(problem);
    converged += result.convergence.converged() ? 1 : 0;
    EXPECT_TRUE(result.film.isFinite().all());
  }
  set_thread_count(threads);
  EXPECT_GE(converged, kCases * 95 / 100);
}

/// Largest rms roughness over the film.
INSTANTIATE_TEST_SUITE_P(Roughness, RandomPointContacts, testing::Values(0.0, 0.4));

}  // namespace
}  // namespace tabor::ehl
