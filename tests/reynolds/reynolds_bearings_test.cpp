#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reynolds_films.hpp"
#include "support/rejection.hpp"
#include "support/validation.hpp"
#include "support/worst.hpp"
#include "tabor/reference/bearings.hpp"

namespace tabor::reynolds {
namespace {

using test::expect_within;
using test::line_problem;
using test::observed_order;
using test::relative_error;

constexpr double kViscosity = 0.1;
constexpr double kRadius = 0.01;
constexpr double kFilm = 1e-6;
const double kLength = std::sqrt(2 * kRadius * kFilm);  // x of a parabola twice as high

/// From `inlet` to `outlet` times that length; what lies further off carries 2.5/inlet^2 of the
/// load.
FilmProblem cylinder(Index n, double inlet = 80, double outlet = 3) {
  return line_problem(-inlet * kLength, outlet * kLength, n,
                      [](double x) { return kFilm + x * x / (2 * kRadius); });
}

/// The last cell under pressure, refined by the parabola that the pressure is near its end.
double rupture_position(const FilmProblem& problem, const FilmSolution& solution) {
  Index last = problem.grid.n_cells();
  while (last > 2 && solution.pressure[last] <= 0) --last;
  const double a = std::sqrt(solution.pressure[last - 1]);
  const double b = std::sqrt(solution.pressure[last]);
  const double dx = problem.grid.node[last] - problem.grid.node[last - 1];
  return problem.grid.node[last] + dx * b / (a - b);
}

TEST(ReynoldsLine, FindsMartinsCylinder) {
  const FilmProblem problem = cylinder(4000);
  const FilmSolution solution = solve_film(problem);
  ASSERT_TRUE(solution.convergence.converged());
  expect_within("EHL", "rigid isoviscous cylinder, Reynolds exit", "load, relative",
                "Martin 1916: 4.8950 eta u R / h0",
                relative_error(solution.load, 4.8950 * kViscosity * kRadius / kFilm), 2e-3);
  expect_within("EHL", "rigid isoviscous cylinder, Reynolds exit", "exit over sqrt(2 R h0)",
                "Martin 1916: 0.47513",
                std::abs(rupture_position(problem, solution) / kLength - 0.47513), 2e-3);
}

TEST(ReynoldsLine, FindsSommerfeldsCylinderWithoutCavitation) {
  FilmProblem problem = cylinder(8000, 60, 60);
  problem.cavitation = Cavitation::none;
  const FilmSolution solution = solve_film(problem);
  ASSERT_TRUE(solution.convergence.converged());
  EXPECT_NEAR(solution.load, 0, 1e-6 * kViscosity * kRadius / kFilm);
  const double half =
      (problem.grid.volume * solution.pressure.segment(1, problem.grid.n_cells()).max(0)).sum();
  expect_within("EHL", "rigid isoviscous cylinder, half Sommerfeld", "load, relative",
                "4 eta u R / h0", relative_error(half, 4 * kViscosity * kRadius / kFilm), 3e-3);
  for (Index i = 1; i <= problem.grid.n_cells(); i += 371) {
    const double exact = -4 * kViscosity * problem.grid.node[i] / std::pow(problem.film[i], 2);
    EXPECT_NEAR(solution.pressure[i], exact, 2e-3 * 4 * kViscosity * kLength / (kFilm * kFilm));
  }
}

TEST(ReynoldsLine, FindsKapitzasPressureOfALongBody) {
  // The middle of an ellipsoid that is a thousand times as long across the flow as along it.
  const reference::KapitzaFilm body{kRadius, 1e3 * kRadius, kFilm, 1, kViscosity};
  FilmProblem problem = cylinder(8000, 60, 60);
  problem.cavitation = Cavitation::none;
  const FilmSolution solution = solve_film(problem);
  double peak = 0;
  double error = 0;
  for (Index i = 1; i <= problem.grid.n_cells(); ++i) {
    const double exact = body.pressure(problem.grid.node[i], 0);
    peak = test::worse(peak, exact);
    error = test::worse(error, std::abs(solution.pressure[i] - exact));
  }
  expect_within("EHL", "rigid isoviscous body, Rx/Ry = 0.001", "pressure, relative to its peak",
                "Kapitza 1955", error / peak, 3e-3);
}

FilmSolution slider(Index n, double ratio) {
  return solve_film(
      line_problem(0, 1e-3, n, [=](double x) { return kFilm * (1 + ratio * (1 - x / 1e-3)); }));
}

/// W h2^2 / (eta U B^2) with U = 2 u of one moving wall.
double slider_load(double k) { return 6 / (k * k) * (std::log(1 + k) - 2 * k / (2 + k)); }

TEST(ReynoldsLine, FindsTheLinearSliderToSecondOrder) {
  const double unit = kViscosity * 2 * 1e-3 * 1e-3 / (kFilm * kFilm);
  for (const double ratio : {0.5, 1.1889, 3.0}) {
    const double coarse = slider(200, ratio).load / (unit * slider_load(ratio)) - 1;
    const double fine = slider(400, ratio).load / (unit * slider_load(ratio)) - 1;
    EXPECT_NEAR(observed_order(coarse, fine), 2, 0.1);
    expect_within("EHL", fmt::format("linear slider, K = {}, n = 400", ratio), "load, relative",
                  "Rayleigh 1918", std::abs(fine), 1e-4);
  }
  EXPECT_NEAR(slider_load(1.1889), 0.16025, 1e-5);
}

TEST(ReynoldsLine, TakesTheStepOfRayleighsBearingExactly) {
  // The step lies on a face: 7182 of 10000 parts of the length are inlet.
  const double ratio = 1.866;
  const FilmProblem problem =
      line_problem(0, 1e-3, 5000, [=](double x) { return x < 0.7182e-3 ? ratio * kFilm : kFilm; });
  const FilmSolution solution = solve_film(problem);
  ASSERT_TRUE(solution.convergence.converged());
  const double unit = kViscosity * 2 * 1e-3 * 1e-3 / (kFilm * kFilm);
  expect_within("EHL", "Rayleigh step at its optimum", "load over eta U B^2/h2^2",
                "Rayleigh 1918: 4/9 (2 sqrt 3 - 3)",
                std::abs(solution.load / unit - 4.0 / 9 * (2 * std::sqrt(3.0) - 3)), 1e-6);
  // Peak at the step: p = 6 eta U (H - 1) l1 l2 / (h2^2 (H^3 l2 + l1)).
  const double l1 = 0.7182e-3;
  const double l2 = 1e-3 - l1;
  const double peak = 6 * kViscosity * 2 * (ratio - 1) * l1 * l2 /
                      (kFilm * kFilm * (ratio * ratio * ratio * l2 + l1));
  // Triangular pressure: the load is half the peak times the length, on any grid.
  EXPECT_NEAR(solution.load, peak * 1e-3 / 2, 1e-7 * solution.load);
}

TEST(ReynoldsLine, IsTheSameForAMirroredFilmAndSpeed) {
  FilmProblem there = line_problem(-1e-3, 1e-3, 200, [](double x) { return 2e-6 - 1e-3 * x; });
  FilmProblem back = line_problem(-1e-3, 1e-3, 200, [](double x) { return 2e-6 + 1e-3 * x; });
  back.speed = -1;
  for (const Cavitation cavitation : {Cavitation::reynolds, Cavitation::mass_conserving}) {
    there.cavitation = back.cavitation = cavitation;
    const FilmSolution a = solve_film(there);
    const FilmSolution b = solve_film(back);
    ASSERT_TRUE(a.convergence.converged() && b.convergence.converged());
    EXPECT_LT((a.pressure - b.pressure.reverse()).abs().maxCoeff(), 1e-9 * a.pressure.maxCoeff());
  }
}

FilmNode compressible_node(double pressure, double film, double distance) {
  const double viscosity = 0.1 * std::exp(2e-8 * pressure);
  return {.pressure = pressure,
          .film = film,
          .fill = 0.8,
          .liquid = {.density = 870 * (1 + 0.5e-9 * pressure),
                     .density_slope = 870 * 0.5e-9,
                     .viscosity = viscosity,
                     .viscosity_slope = 2e-8 * viscosity},
          .distance = distance};
}

TEST(FaceFlow, HasTheDerivativesOfItsFlow) {
  for (const double left : {1e5, 3.9e8}) {  // a steep front and a gentle one
    const double p[2] = {left, 3.99e8};
    const double h[2] = {1.2e-6, 0.9e-6};
    const auto flow = [&](double dp0, double dp1, double dh0, double dh1) {
      return face_flow(compressible_node(p[0] + dp0, h[0] + dh0, 1e-6),
                       compressible_node(p[1] + dp1, h[1] + dh1, 2e-6), 0.3);
    };
    const FaceFlow at = flow(0, 0, 0, 0);
    const double dp = 100;
    const double dh = 1e-12;
    const auto slope = [](const FaceFlow& up, const FaceFlow& down, double step) {
      return (up.flow - down.flow) / (2 * step);
    };
    EXPECT_NEAR(at.by_pressure[0] / slope(flow(dp, 0, 0, 0), flow(-dp, 0, 0, 0), dp), 1, 1e-5);
    EXPECT_NEAR(at.by_pressure[1] / slope(flow(0, dp, 0, 0), flow(0, -dp, 0, 0), dp), 1, 1e-5);
    EXPECT_NEAR(at.by_film[0] / slope(flow(0, 0, dh, 0), flow(0, 0, -dh, 0), dh), 1, 1e-5);
    EXPECT_NEAR(at.by_film[1] / slope(flow(0, 0, 0, dh), flow(0, 0, 0, -dh), dh), 1, 1e-5);
  }
}

// The integral of dp/eta from one node to the other is known for Barus' law.
TEST(FaceFlow, TakesAFrontOfBarussViscosityExactly) {
  const double alpha = 2e-8;
  const double low = 1e7;
  const double high = 9e8;
  const auto node = [&](double p) {
    const double viscosity = 0.1 * std::exp(alpha * p);
    return FilmNode{.pressure = p,
                    .film = 1e-6,
                    .liquid = {.viscosity = viscosity, .viscosity_slope = alpha * viscosity},
                    .distance = 1e-6};
  };
  const double exact =
      1e-18 / (12 * 0.1) * (std::exp(-alpha * low) - std::exp(-alpha * high)) / alpha / 2e-6;
  EXPECT_NEAR(face_flow(node(high), node(low), 0).flow / exact, 1, 1e-12);
}

TEST(ReynoldsLine, RejectsWhatIsNoFilm) {
  FilmProblem problem = cylinder(10);
  problem.film[3] = 0;
  EXPECT_THAT(test::rejection([&] { solve_film(problem); }), testing::HasSubstr("more than zero"));
  problem.film.conservativeResize(5);
  EXPECT_THAT(test::rejection([&] { solve_film(problem); }), testing::HasSubstr("12 values"));
  EXPECT_THAT(test::rejection([] { line_grid(1, 0, 10); }), testing::HasSubstr("before the end"));
  EXPECT_THAT(test::rejection([] { disc_grid(0, 10); }), testing::HasSubstr("more than zero"));
  EXPECT_THAT(test::rejection([] { disc_grid(1, 1); }), testing::HasSubstr("2 or more"));
}

}  // namespace
}  // namespace tabor::reynolds
