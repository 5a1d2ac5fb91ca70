// Films of point contacts beside computations and formulas of others; minutes under sanitizers.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "ehl/point/moes.hpp"
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
  double central, minimum, pressure;
};

Film solved(const PointProblem& problem) {
  const PointResult result = solve_point(problem);
  EXPECT_TRUE(result.convergence.converged());
  const double unit = film_unit(problem);
  return {film_at_centre(problem, result) / unit, result.film.minCoeff() / unit,
          result.pressure.maxCoeff() / hertz_of(problem).max_pressure};
}

void compare(const std::string& name, const char* source, const Film& ours, const Film& theirs,
             double film_tolerance, double pressure_tolerance) {
  expect_within("EHL", name, "central film, relative", source,
                std::abs(ours.central / theirs.central - 1), film_tolerance);
  expect_within("EHL", name, "smallest film, relative", source,
                std::abs(ours.minimum / theirs.minimum - 1), film_tolerance);
  expect_within("EHL", name, "largest pressure, relative", source,
                std::abs(ours.pressure / theirs.pressure - 1), pressure_tolerance);
}

TEST(PointFilms, MoesTwentyTenAgreesWithAnIndependentComputation) {
  // Which approaches the common limit from below with the grid, where ours is nearly there: the
  // coarser its grid, the larger the difference.
  const Film theirs[] = {{.4163, .2846, 1.094}, {.4233, .2876, 1.145}, {.4265, .2898, 1.186}};
  const double tolerance[] = {0.03, 0.015, 0.01};
  const Index nodes[] = {65, 97, 145};
  for (int i = 0; i < 3; ++i) {
    compare("point contact, M = 20, L = 10, " + std::to_string(nodes[i]) + " nodes",
            "independent computation", solved(compressible(moes_case(20, 10, nodes[i]))), theirs[i],
            tolerance[i], 0.02);
  }
  const Film ours = solved(compressible(moes_case(20, 10, 257)));
  expect_within("EHL", "point contact, M = 20, L = 10, 257 nodes",
                "central film against 0.429 of infinitely many, relative",
                "independent computation", std::abs(ours.central / 0.429 - 1), 0.006);
  expect_within("EHL", "point contact, M = 20, L = 10, 257 nodes",
                "smallest film against 0.291 of infinitely many, relative",
                "independent computation", std::abs(ours.minimum / 0.291 - 1), 0.006);
}

TEST(PointFilms, AnIncompressibleLiquidAgreesToo) {
  compare("point contact, M = 20, L = 10, incompressible, 97 nodes", "independent computation",
          solved(moes_case(20, 10, 97)), {.4702, .2921, 1.549}, 0.015, 0.06);
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

TEST(PointFilms, RedlichsContactTendsToTheLimitOfAnIndependentComputation) {
  PointProblem problem = compressible(moes_case(1892, 12.61, 137));
  problem.inlet = 2;
  problem.outlet = 1.4;
  problem.half_width = 1.7;
  const Film coarse = solved(problem);
  problem.nodes_x = problem.nodes_y = 205;
  const Film fine = solved(problem);
  for (const auto& [name, film] : {std::pair{"137", coarse}, std::pair{"205", fine}}) {
    expect_within("EHL",
                  std::string("point contact, M = 1892, L = 12.61, ") + name + " nodes in 3.4 a",
                  "central film against 0.0173 of infinitely many, relative",
                  "independent computation", std::abs(film.central / 0.0173 - 1), 0.02);
  }
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
