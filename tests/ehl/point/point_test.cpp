#include "tabor/ehl/point/point.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "ehl/point/moes.hpp"
#include "support/stopping.hpp"
#include "support/worst.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/ehl/point/start.hpp"

namespace tabor::ehl {
namespace {

using test::compressible;
using test::film_at_centre;
using test::film_unit;
using test::moes_case;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(SolvePoint, BalancesMassAndLoad) {
  const PointProblem problem = compressible(moes_case(20, 10, 49));
  const PointResult result = solve_point(problem);
  ASSERT_TRUE(result.convergence.converged());
  EXPECT_LE(result.mass_error, problem.tolerance);
  EXPECT_NEAR(result.pressure.sum() * result.grid.pixel_area() / problem.load, 1, 1e-6);
  EXPECT_GE(result.pressure.minCoeff(), 0);
  EXPECT_GT(result.film.minCoeff(), 0);
}

TEST(SolvePoint, IsSymmetricAcrossTheFlow) {
  const PointResult result = solve_point(compressible(moes_case(200, 10, 49)));
  ASSERT_TRUE(result.convergence.converged());
  const Field mirrored = result.film.colwise().reverse();
  EXPECT_LE((result.film - mirrored).abs().maxCoeff(), 1e-6 * result.film.maxCoeff());
}

TEST(SolvePoint, HasTheSameBitsForAnyThreadCount) {
  PointResult results[2];
  const int before = thread_count();
  for (int i = 0; i < 2; ++i) {
    set_thread_count(1 + 2 * i);
    results[i] = solve_point(moes_case(100, 5, 33));
  }
  set_thread_count(before);
  EXPECT_TRUE((results[0].pressure == results[1].pressure).all());
  EXPECT_TRUE((results[0].film == results[1].film).all());
}

TEST(SolvePoint, TendsToHertzAsTheFilmThins) {
  double before = std::numeric_limits<double>::infinity();
  for (const double slower : {1.0, 0.1, 0.01}) {
    PointProblem problem = moes_case(200, 10, 49);
    problem.entrainment_speed *= slower;
    const PointResult result = solve_point(problem);
    ASSERT_TRUE(result.convergence.converged());
    const reference::HertzEllipse hertz = hertz_of(problem);
    const Eigen::ArrayXd x = point_x(problem);
    const Eigen::ArrayXd y = point_y(problem);
    double worst = 0;
    for (Index j = 0; j < y.size(); ++j) {
      for (Index i = 0; i < x.size(); ++i) {
        if (std::hypot(x[i], y[j]) > 0.8 * hertz.half_axis_x) continue;
        const double difference =
            result.pressure(j, i) - reference::hertz_pressure(hertz, x[i], y[j]);
        worst = test::worse(worst, std::abs(difference) / hertz.max_pressure);
      }
    }
    EXPECT_LT(worst, before);
    before = worst;
  }
  EXPECT_LT(before, 0.01);
}

TEST(SolvePoint, FilmGrowsWithSpeedAndShrinksWithLoad) {
  PointProblem problem = moes_case(100, 8, 33);
  const double film = film_at_centre(problem, solve_point(problem));
  problem.entrainment_speed *= 2;
  const double faster = film_at_centre(problem, solve_point(problem));
  EXPECT_GT(faster, 1.4 * film);
  problem.load *= 2;
  EXPECT_LT(film_at_centre(problem, solve_point(problem)), faster);
}

TEST(SolvePoint, StartsFromANeighbour) {
  PointProblem problem = moes_case(200, 10, 65);
  const PointResult fast = solve_point(problem);
  problem.entrainment_speed *= 0.8;
  const PointResult cold = solve_point(problem);
  const PointResult warm = solve_point(problem, &fast);
  ASSERT_TRUE(cold.convergence.converged() && warm.convergence.converged());
  EXPECT_LT(warm.convergence.operator_applications, cold.convergence.operator_applications);
  EXPECT_NEAR(film_at_centre(problem, warm) / film_at_centre(problem, cold), 1, 1e-5);
}

TEST(SolvePoint, ThinningBySlidingMakesTheInletFilmThinner) {
  PointProblem problem = moes_case(200, 10, 49);
  problem.lubricant.shear = material::ree_eyring_shear(1e5);
  const double newtonian = film_at_centre(problem, solve_point(problem));
  problem.sliding_speed = 2 * problem.entrainment_speed;
  const PointResult thinned = solve_point(problem);
  ASSERT_TRUE(thinned.convergence.converged());
  EXPECT_LT(film_at_centre(problem, thinned), 0.97 * newtonian);
}

TEST(SolvePoint, IsTheSameTurnedEllipseWithWiderSides) {
  // A wider contact across the flow leaks less to the sides.
  PointProblem problem = moes_case(200, 10, 49);
  problem.radius_y = 4 * problem.radius_x;
  const PointResult wide = solve_point(problem);
  ASSERT_TRUE(wide.convergence.converged());
  const double expected = film_groups_of(problem).nijenbanning_central();
  EXPECT_NEAR(film_at_centre(problem, wide) / expected, 1, 0.1);
}

TEST(SolvePoint, RoughnessThatLeavesAFilmChangesPressureAndFilm) {
  PointProblem problem = moes_case(100, 10, 65);
  const PointResult smooth = solve_point(problem);
  const double amplitude = 0.2 * film_at_centre(problem, smooth);
  const Eigen::ArrayXd x = point_x(problem);
  const double wavelength = hertz_of(problem).half_axis_x;
  problem.roughness =
      (amplitude * (2 * std::numbers::pi / wavelength * x).cos()).transpose().replicate(65, 1);
  const PointResult rough = solve_point(problem);
  ASSERT_TRUE(rough.convergence.converged());
  EXPECT_LE(rough.mass_error, problem.tolerance);
  EXPECT_GT(rough.pressure.maxCoeff(), smooth.pressure.maxCoeff());
  EXPECT_GT(rough.film.minCoeff(), 0);
}

TEST(SolvePoint, TakesAHandfulOfProductsPerStepOnAnyGrid) {
  for (const Index nodes : {33, 65, 97}) {
    const PointProblem problem = compressible(moes_case(200, 10, nodes));
    const PointFilm film(problem);
    PointState state = film.hertz_start(3 * film.film_scale());
    const PointFilm::Outcome outcome = film.solve(state, film.conditions());
    ASSERT_TRUE(outcome.convergence.converged());
    EXPECT_LE(outcome.convergence.iterations, 12);
    EXPECT_LE(outcome.n_linear_iterations, 6 * outcome.convergence.iterations);
  }
}

TEST(PointFilm, IsTheSameWhereSolidsMayTouchAndDoNot) {
  const PointProblem problem = compressible(moes_case(100, 8, 49));
  const PointFilm apart(problem);
  const PointFilm together(problem, {.solids_touch = true});
  PointState expected = apart.hertz_start(3 * apart.film_scale());
  PointState state = expected;
  ASSERT_TRUE(apart.solve(expected, apart.conditions()).convergence.converged());
  ASSERT_TRUE(together.solve(state, together.conditions()).convergence.converged());
  ASSERT_GT(expected.film.minCoeff(), problem.asperities.boundary_film);
  EXPECT_LE((state.film / expected.film - 1).abs().maxCoeff(), 10 * problem.tolerance);
  EXPECT_FALSE(state.nodes.unaryExpr(&touches).any());
}

TEST(SolvePoint, SaysWhyItDidNotConverge) {
  PointProblem problem = moes_case(200, 10, 33);
  problem.max_iterations = 1;
  const PointResult result = solve_point(problem);
  EXPECT_EQ(result.convergence.status, Status::iteration_limit);
  EXPECT_EQ(result.film.size(), 33 * 33);
  const PointFilm film(problem);
  PointState overlapping = film.hertz_start(-film_unit(problem));
  EXPECT_EQ(film.solve(overlapping, film.conditions()).convergence.status, Status::stalled);
}

// From Hertz' pressure on two grids; from a film at hand; and where nothing converges, so that all
// other ways are tried, one after the other.
TEST(SolvePoint, StopsAtAnyQuestion) {
  const auto expect_to_stop = [](const PointProblem& problem, const PointResult* start) {
    test::expect_to_stop_at_once([&](const Observer& observer) {
      const PointResult result = solve_point(problem, start, observer);
      EXPECT_EQ(result.film.rows(), problem.nodes_y);
      return result.convergence;
    });
  };
  const PointProblem problem = moes_case(200, 10, 49);
  const PointResult found = solve_point(problem);
  expect_to_stop(problem, nullptr);
  PointProblem slower = problem;
  slower.entrainment_speed /= 2;
  expect_to_stop(slower, &found);
  PointProblem hopeless = moes_case(200, 10, 33);
  hopeless.max_iterations = 2;
  expect_to_stop(hopeless, nullptr);
}

struct BadInput {
  const char* says;
  void (*change)(PointProblem&);
};

class CheckPoint : public testing::TestWithParam<BadInput> {};

TEST_P(CheckPoint, RejectsWithTheReason) {
  PointProblem problem = moes_case(20, 10, 65);
  GetParam().change(problem);
  try {
    solve_point(problem);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(GetParam().says));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Inputs, CheckPoint,
    testing::Values(BadInput{"load", [](PointProblem& p) { p.load = 0; }},
                    BadInput{"radius along", [](PointProblem& p) { p.radius_x = -1; }},
                    BadInput{"radius across", [](PointProblem& p) { p.radius_y = kNan; }},
                    BadInput{"entrainment", [](PointProblem& p) { p.entrainment_speed = 0; }},
                    BadInput{"sliding", [](PointProblem& p) { p.sliding_speed = kNan; }},
                    BadInput{"nodes", [](PointProblem& p) { p.nodes_x = 2; }},
                    BadInput{"grid", [](PointProblem& p) { p.nodes_y = 9; }},
                    BadInput{"domain", [](PointProblem& p) { p.inlet = 0.5; }},
                    BadInput{"domain", [](PointProblem& p) { p.outlet = kNan; }},
                    BadInput{"roughness", [](PointProblem& p) { p.roughness = Field::Zero(3, 3); }},
                    BadInput{"roughness",
                             [](PointProblem& p) { p.roughness = Field::Constant(65, 65, kNan); }},
                    BadInput{"narrower", [](PointProblem& p) { p.load = 1e9; }},
                    BadInput{"barus", [](PointProblem& p) {
                               p.lubricant.viscosity = material::barus_viscosity(0.08, 1e-6);
                             }}));

}  // namespace
}  // namespace tabor::ehl
