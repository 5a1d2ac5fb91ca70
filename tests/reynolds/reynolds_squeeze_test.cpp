#include <gtest/gtest.h>

#include <numbers>

#include "reynolds_films.hpp"
#include "support/validation.hpp"

namespace tabor::reynolds {
namespace {

using std::numbers::pi;
using test::disc_problem;
using test::expect_within;
using test::line_problem;
using test::observed_order;
using test::relative_error;

constexpr double kViscosity = 0.1;
constexpr double kRadius = 0.01;
constexpr double kFilm = 1e-6;

/// Load on a ball that approaches at 1 mm/s in a layer of `layer` times its smallest film.
FilmSolution ball(Index n, double layer) {
  FilmProblem problem = disc_problem(std::sqrt(2 * kRadius * kFilm * (layer - 1)), n,
                                     [](double r) { return kFilm + r * r / (2 * kRadius); });
  problem.squeeze = Eigen::ArrayXd::Constant(n, -1e-3);
  return solve_film(problem);
}

TEST(ReynoldsDisc, FindsTheSqueezedBallToSecondOrder) {
  const double exact =
      6 * pi * kViscosity * kRadius * kRadius * 1e-3 / kFilm * std::pow((10 - 1) / 10.0, 2);
  double before = 0;
  for (const Index n : {100, 200, 400, 800}) {
    const FilmSolution solution = ball(n, 10);
    ASSERT_TRUE(solution.convergence.converged());
    const double error = solution.load / exact - 1;
    if (before != 0) {
      EXPECT_NEAR(observed_order(before, error), 2, 0.1);
    }
    before = error;
  }
  expect_within("EHL", "squeezed ball in a layer, n = 800", "load, relative",
                "6 pi eta R^2 v/h0 ((h00-h0)/h00)^2", std::abs(before), 3e-5);
}

TEST(ReynoldsDisc, FindsThePressureUnderASqueezedBall) {
  const FilmSolution solution = ball(400, 10);
  const FilmGrid grid = disc_grid(std::sqrt(18 * kRadius * kFilm), 400);
  for (Index i = 1; i <= 400; i += 57) {
    const double h = kFilm + grid.node[i] * grid.node[i] / (2 * kRadius);
    const double edge = 10 * kFilm;
    const double exact = 3 * kViscosity * kRadius * 1e-3 * (1 / (h * h) - 1 / (edge * edge));
    EXPECT_NEAR(solution.pressure[i], exact, 2e-4 * solution.pressure[1]);
  }
}

TEST(ReynoldsDisc, FindsStefansParallelDiscs) {
  FilmProblem problem = disc_problem(1e-3, 200, [](double) { return kFilm; });
  problem.squeeze = Eigen::ArrayXd::Constant(200, -1e-6);
  const FilmSolution solution = solve_film(problem);
  ASSERT_TRUE(solution.convergence.converged());
  const double exact = 3 * pi * kViscosity * 1e-12 * 1e-6 / (2 * std::pow(kFilm, 3));
  expect_within("EHL", "parallel discs, n = 200", "load, relative", "Stefan 1874",
                relative_error(solution.load, exact), 2e-5);
}

TEST(ReynoldsDisc, SaysSoWhenItRunsOutOfIterations) {
  FilmProblem problem = disc_problem(1e-3, 20, [](double) { return kFilm; });
  problem.squeeze = Eigen::ArrayXd::Constant(20, std::nan(""));
  const FilmSolution solution = solve_film(problem);
  EXPECT_EQ(solution.convergence.status, Status::iteration_limit);
  EXPECT_EQ(solution.convergence.iterations, 200);
}

TEST(ReynoldsDisc, LetsParallelDiscsFallInStefansTime) {
  // Under a constant force the film falls as dh/dt = -2 F h^3/(3 pi eta R^4).
  const double force = 1;
  const double fall = 3 * pi * kViscosity * 1e-12 / (4 * force) *
                      (1 / std::pow(0.5 * kFilm, 2) - 1 / std::pow(kFilm, 2));
  const auto speed_at = [&](double film) {
    FilmProblem problem = disc_problem(1e-3, 100, [=](double) { return film; });
    problem.squeeze = Eigen::ArrayXd::Constant(100, -1e-6);
    return -1e-6 * force / solve_film(problem).load;
  };
  double film = kFilm;
  const int n_steps = 200;
  for (int i = 0; i < n_steps; ++i) {  // midpoint rule
    const double half = film + 0.5 * fall / n_steps * speed_at(film);
    film += fall / n_steps * speed_at(half);
  }
  expect_within("EHL", "parallel discs, time to fall to half", "film, relative", "Stefan 1874",
                relative_error(film, 0.5 * kFilm), 1e-4);
}

TEST(ReynoldsLine, FindsTheSqueezedCylinder) {
  const double reach = 40 * std::sqrt(2 * kRadius * kFilm);
  FilmProblem problem =
      line_problem(-reach, reach, 4000, [](double x) { return kFilm + x * x / (2 * kRadius); });
  problem.speed = 0;
  problem.squeeze = Eigen::ArrayXd::Constant(4000, -1e-3);
  const FilmSolution solution = solve_film(problem);
  ASSERT_TRUE(solution.convergence.converged());
  const double exact = 3 * std::sqrt(2.0) * pi * kViscosity * 1e-3 * std::pow(kRadius / kFilm, 1.5);
  expect_within("EHL", "squeezed cylinder", "load, relative", "3 sqrt(2) pi eta v (R/h0)^1.5",
                relative_error(solution.load, exact), 1e-3);
  expect_within("EHL", "squeezed cylinder", "central pressure, relative", "6 eta R v/h^2",
                relative_error(solution.pressure[2000],
                               6 * kViscosity * kRadius * 1e-3 / std::pow(problem.film[2000], 2)),
                1e-3);
}

TEST(ReynoldsDisc, CavitatesEverywhereUnderABallThatLeaves) {
  FilmProblem problem =
      disc_problem(1e-3, 50, [](double r) { return kFilm + r * r / (2 * kRadius); });
  problem.squeeze = Eigen::ArrayXd::Constant(50, 1e-3);
  const FilmSolution solution = solve_film(problem);
  EXPECT_TRUE(solution.convergence.converged());
  EXPECT_EQ(solution.pressure.maxCoeff(), 0);
}

}  // namespace
}  // namespace tabor::reynolds
