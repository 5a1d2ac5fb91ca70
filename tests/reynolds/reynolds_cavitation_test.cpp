#include <gtest/gtest.h>

#include "reynolds_films.hpp"
#include "support/validation.hpp"
#include "support/worst.hpp"

namespace tabor::reynolds {
namespace {

using test::expect_within;
using test::line_problem;
using test::observed_order;
using test::relative_error;

/// The pocket of the closed form: parallel land of 1 um, pocket of 2 um between 4 and 8 mm of 20
/// mm. One wall moves at 1 m/s; eta = 0.01 Pa s; 0.1 MPa at both ends, cavitation at 0.
FilmProblem pocket(Index n, Cavitation cavitation) {
  FilmProblem problem =
      line_problem(0, 20e-3, n, [](double x) { return x > 4e-3 && x < 8e-3 ? 2e-6 : 1e-6; });
  problem.speed = 0.5;
  problem.liquid = constant_liquid(0.01);
  problem.left_pressure = problem.right_pressure = 1e5;
  problem.cavitation = cavitation;
  return problem;
}

constexpr double kPocketLoad = 3210.671;     // [N/m]
constexpr double kPocketFlow = 5.002083e-7;  // [m^2/s]
constexpr double kPocketFill = 0.500208;

TEST(MassConservingCavitation, FindsThePocketToFirstOrder) {
  double before = 0;
  for (const Index n : {4000, 16000, 64000}) {
    const FilmSolution solution = solve_film(pocket(n, Cavitation::mass_conserving));
    ASSERT_TRUE(solution.convergence.converged()) << n;
    const double error = solution.load / kPocketLoad - 1;
    if (before != 0) {
      EXPECT_NEAR(observed_order(before, error) / 2, 1, 0.25) << n;  // cells four times finer
    }
    before = error;
    if (n < 64000) continue;
    expect_within("EHL", "pocket with a cavity, n = 64000", "load, relative",
                  "Jakobsson-Floberg-Olsson, closed form", std::abs(error), 3e-4);
    expect_within("EHL", "pocket with a cavity, n = 64000", "flow, relative",
                  "Jakobsson-Floberg-Olsson, closed form",
                  relative_error(solution.face_flow[0], kPocketFlow), 1e-6);
    const Index inside = static_cast<Index>(0.3 * static_cast<double>(n));
    expect_within("EHL", "pocket with a cavity, n = 64000", "fill of the cavity",
                  "Jakobsson-Floberg-Olsson, closed form",
                  std::abs(solution.fill[inside] - kPocketFill), 1e-6);
  }
}

TEST(ReynoldsCavitation, IsWrongForThePocketAsItCreatesLiquid) {
  const FilmSolution solution = solve_film(pocket(500, Cavitation::reynolds));
  ASSERT_TRUE(solution.convergence.converged());
  EXPECT_GT(relative_error(solution.load, kPocketLoad), 0.05);
  const Index last = solution.face_flow.size() - 1;
  EXPECT_GT(relative_error(solution.face_flow[last], solution.face_flow[0]), 0.03);
}

TEST(MassConservingCavitation, CarriesOneFlowThroughThePocket) {
  const FilmSolution solution = solve_film(pocket(4000, Cavitation::mass_conserving));
  const double spread = solution.face_flow.maxCoeff() - solution.face_flow.minCoeff();
  expect_within("EHL", "pocket with a cavity, n = 4000", "spread of the flow, relative",
                "conservation", spread / solution.face_flow[0], 1e-11);
}

TEST(MassConservingCavitation, RupturesACylindersFilmWhereReynoldsDoes) {
  const double film = 1e-6;
  const double radius = 0.01;
  const double length = std::sqrt(2 * radius * film);
  FilmProblem problem = line_problem(-20 * length, 20 * length, 8000,
                                     [=](double x) { return film + x * x / (2 * radius); });
  problem.right_pressure = 0;
  problem.cavitation = Cavitation::mass_conserving;
  const FilmSolution solution = solve_film(problem);
  ASSERT_TRUE(solution.convergence.converged());
  Index last = problem.grid.n_cells();
  while (solution.fill[last] < 1) --last;
  expect_within("EHL", "cylinder, mass conserving", "rupture over sqrt(2 R h0)",
                "0.4751, as with Reynolds' condition",
                std::abs(problem.grid.node[last] / length - 0.4751), 0.01);
  // No reformation: the cavity reaches the exit and carries all of the flow.
  EXPECT_LT(solution.fill[problem.grid.n_cells()], 0.01);
}

/// Largest |p - p of the complementarity| over the largest pressure.
double penalty_error(double penalty) {
  const double length = std::sqrt(2 * 0.01 * 1e-6);
  FilmProblem problem =
      line_problem(-8 * length, 4 * length, 600, [=](double x) { return 1e-6 + x * x / 0.02; });
  const FilmSolution sharp = solve_film(problem);
  problem.cavitation = Cavitation::penalty;
  problem.penalty = penalty;
  const FilmSolution soft = solve_film(problem);
  EXPECT_TRUE(sharp.convergence.converged() && soft.convergence.converged()) << penalty;
  return (sharp.pressure - soft.pressure).abs().maxCoeff() / sharp.pressure.maxCoeff();
}

TEST(PenalizedCavitation, TendsToReynoldsConditionWithTheParameter) {
  const double weak = penalty_error(1e2);
  const double strong = penalty_error(1e4);
  EXPECT_LT(strong, weak / 5);
  expect_within("EHL", "cylinder, penalty 1e8", "pressure, relative to its peak", "complementarity",
                penalty_error(1e8), 1e-8);
}

/// Sum of what flowed in over the boundaries and of what the cells gained, over the mass.
double imbalance_while_opening(Cavitation cavitation) {
  FilmProblem problem = line_problem(0, 1e-3, 100, [](double x) { return 1e-6 + 1e-3 * x; });
  problem.cavitation = cavitation;
  problem.left_pressure = problem.right_pressure = 1e5;
  problem.liquid.density = material::relative_density(material::DensityLaw::dowson_higginson);
  problem.density = 870;
  problem.time_step = 1e-5;
  problem.old_mass = 870 * problem.film.segment(1, 100);
  double worst = 0;
  double lowest = 1;
  for (int step = 1; step <= 40; ++step) {
    problem.film += 2e-8 * std::cos(0.2 * step);
    const FilmSolution solution = solve_film(problem);
    EXPECT_TRUE(solution.convergence.converged()) << step;
    const double gained = (problem.grid.volume * (solution.mass - problem.old_mass)).sum();
    const double inflow = problem.time_step * (solution.face_flow[0] - solution.face_flow[100]);
    worst =
        test::worse(worst, std::abs(gained - inflow) / (problem.grid.volume * solution.mass).sum());
    lowest = std::min(lowest, solution.fill.minCoeff());
    problem.old_mass = solution.mass;
  }
  if (cavitation == Cavitation::mass_conserving) {
    EXPECT_LT(lowest, 0.99);
  }
  return worst;
}

TEST(MassConservingCavitation, BalancesMassWhileAGapOpensAndCloses) {
  expect_within("EHL", "gap that opens and closes, compressible", "mass balance per step, relative",
                "conservation", imbalance_while_opening(Cavitation::mass_conserving), 1e-13);
  EXPECT_GT(imbalance_while_opening(Cavitation::reynolds), 1e-6);
}

FilmProblem barus_cylinder(double film, double alpha) {
  const double length = std::sqrt(2 * 0.01 * film);
  FilmProblem problem =
      line_problem(-20 * length, 5 * length, 2000, [=](double x) { return film + x * x / 0.02; });
  problem.liquid.viscosity = material::barus_viscosity(0.1, alpha);
  return problem;
}

TEST(ReynoldsLine, TurnsAnIsoviscousFilmIntoBarussByTheReducedPressure) {
  const FilmSolution reduced = solve_film(barus_cylinder(1e-6, 0));
  const double alpha = 0.7 / reduced.pressure.maxCoeff();
  const FilmSolution solution = solve_film(barus_cylinder(1e-6, alpha));
  ASSERT_TRUE(solution.convergence.converged());
  const Eigen::ArrayXd expected = -(1 - alpha * reduced.pressure).log() / alpha;
  expect_within("EHL", "cylinder, Barus, alpha q = 0.7", "pressure, relative to its peak",
                "p = -ln(1 - alpha q)/alpha",
                (solution.pressure - expected).abs().maxCoeff() / expected.maxCoeff(), 1e-12);
}

TEST(ReynoldsLine, HasTheRigidPiezoviscousLimitOfMoes) {
  // The film at which alpha q reaches 1: H = 1.05 L^(2/3) in Moes' units. With U = eta u/(E' R),
  // H = h/R (2U)^(-1/2) and L = alpha E' (2U)^(1/4), E' drops out of H/L^(2/3).
  const FilmSolution reduced = solve_film(barus_cylinder(1e-6, 0));
  const double q = reduced.pressure.maxCoeff();  // falls with h0^(-3/2)
  const double alpha = 1 / q;
  const double h = 1e-6 / 0.01;
  const double speed = 0.1 / 0.01;  // eta u/R
  const double ratio = h / (std::pow(2 * speed, 0.5 + 2.0 / 12) * std::pow(alpha, 2.0 / 3));
  expect_within("EHL", "rigid piezoviscous cylinder", "H/L^(2/3)", "Moes: 1.05",
                std::abs(ratio - 1.05), 0.005);
}

}  // namespace
}  // namespace tabor::reynolds
