// Oil that a sliding flat carries over a rough patch.
#include "tabor/reynolds/patch/patch_flow.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "patches.hpp"
#include "reynolds_films.hpp"
#include "support/stopping.hpp"
#include "support/validation.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/parallel.hpp"

namespace tabor::reynolds {
namespace {

using test::expect_within;
using test::observed_order;
using test::rough_patch;
using test::row_patch;

/// A row of length 20 mm whose first pixel is open to a reservoir; u_m = 0.5 m/s, 0.01 Pa s.
template <typename Film>
PatchProblem bearing(Index n, double pressure, const Film& film) {
  PatchProblem problem;
  const double length = 20e-3;
  problem.grid = {n, 1, length, length / static_cast<double>(n)};
  problem.gap.resize(1, n);
  for (Index i = 0; i < n; ++i) {
    problem.gap(0, i) = film(problem.grid.dx() * static_cast<double>(i));
  }
  problem.viscosity = 0.01;
  problem.entrainment_speed = 0.5;
  problem.reservoir = Mask::Constant(1, n, false);
  problem.reservoir(0, 0) = true;
  problem.reservoir_pressure = pressure;
  return problem;
}

double load_of(const PatchProblem& problem, const PatchFilm& film) {
  return film.pressure.sum() * problem.grid.dx();
}

TEST(PatchFilm, StopsAtAnyQuestion) {
  const PatchProblem problem = rough_patch(32, 0.5e-6);
  const Field oil = Field::Constant(32, 32, 0.2e-6);
  test::expect_to_stop_at_once(
      [&](const Observer& observer) { return steady_film(problem, oil, observer).convergence; });
}

TEST(PatchFilm, IsFoundInFewProducts) {
  const PatchProblem problem = rough_patch(64, 0.6e-6);
  const Field oil = Field::Constant(64, 64, 0.6 * problem.gap.mean());
  const PatchFilm film = steady_film(problem, oil);
  ASSERT_TRUE(film.convergence.converged());
  RecordProperty("iterations", film.convergence.iterations);
  RecordProperty("products", film.convergence.operator_applications);
  EXPECT_LT(film.convergence.iterations, 200);              // each step begins with the cells of
  EXPECT_LT(film.convergence.operator_applications, 1000);  // the last, in the units of the last
}

TEST(PatchFilm, FindsTheCavityOfThePocket) {
  const PatchProblem problem =
      bearing(4000, 1e5, [](double x) { return x > 4e-3 && x < 8e-3 ? 2e-6 : 1e-6; });
  const PatchFilm film = steady_film(problem, 0.5 * problem.gap);
  ASSERT_TRUE(film.convergence.converged());
  expect_within("EHL", "pocket with a cavity, patch of 4000 x 1", "load, relative",
                "Jakobsson-Floberg-Olsson, closed form",
                test::relative_error(load_of(problem, film), 3210.671), 1e-3);
  expect_within("EHL", "pocket with a cavity, patch of 4000 x 1", "fill of the cavity",
                "Jakobsson-Floberg-Olsson, closed form", std::abs(film.fill(0, 1200) - 0.500208),
                1e-5);
}

TEST(PatchFilm, CarriesALinearSliderToSecondOrder) {
  // Thin end 1 um, K = 1.1889; the pad is the whole row, the reservoir on both its ends.
  const auto error = [](Index n) {
    const PatchProblem problem = bearing(
        n, 0, [](double x) { return x == 0 ? 1e-6 : 1e-6 * (1 + 1.1889 * (20e-3 - x) / 20e-3); });
    const PatchFilm film = steady_film(problem, problem.gap);
    EXPECT_TRUE(film.convergence.converged());
    const double expected = 0.16025 * 0.01 * 1 * 20e-3 * 20e-3 / 1e-12;
    return test::relative_error(load_of(problem, film), expected);
  };
  expect_within("EHL", "linear slider, patch of 1000 x 1", "load, relative",
                "0.16025 eta U B^2/h^2", error(1000), 5e-3);
}

TEST(PatchFilm, PilesOilUpBeforeAWall) {
  // Nothing flows through: dp/dx = 12 eta u_m / h^2 over the length that the oil fills.
  const auto error = [](Index n) {
    Field gap = Field::Constant(1, n, 1e-6);
    gap(0, n - 1) = 0;
    PatchProblem problem = row_patch(gap);
    problem.grid.lx = 100e-6;
    problem.vent_pressure = 1e9;
    const PatchFilm film = steady_film(problem, 0.3 * gap);
    EXPECT_TRUE(film.convergence.converged());
    const double length = 0.3 * 100e-6 * (1 - 1 / static_cast<double>(n));
    const double expected = 12 * 0.1 * 1e-3 / 1e-12 * length * length / 2 / 100e-6;
    return film.mean_pressure / expected - 1;
  };
  const double coarse = error(100);
  const double fine = error(400);
  EXPECT_NEAR(observed_order(coarse, fine) / 2, 1, 0.2);
  expect_within("EHL", "oil before a wall, 400 pixels", "mean pressure, relative", "closed form",
                std::abs(fine), 0.02);
}

TEST(PatchFilm, CarriesTheSameFlowThroughAStarvedRow) {
  Field gap(2, 64);
  for (Index i = 0; i < 64; ++i) gap.col(i) = 2e-6 + 1e-6 * std::sin(0.1 * static_cast<double>(i));
  const PatchProblem problem = row_patch(gap);
  const PatchFilm film = steady_film(problem, Field::Constant(2, 64, 1e-7));
  ASSERT_TRUE(film.convergence.converged());
  EXPECT_EQ(film.mean_pressure, 0);
  const PatchCells cells = patch_cells(problem);
  const Field flow = cells.carried * film.fill;
  EXPECT_LT(flow.maxCoeff() / flow.minCoeff() - 1, 1e-2);
}

TEST(PatchFilm, IsTheAnswerOfTheComplementarity) {
  for (const double oil : {0.1e-6, 0.4e-6, 2e-6}) {
    PatchProblem problem = rough_patch(64, 0.5e-6);
    problem.pressure_resolution = 1;
    const PatchFilm film = steady_film(problem, Field::Constant(64, 64, oil));
    ASSERT_TRUE(film.convergence.converged()) << oil;
    EXPECT_GT(film.mean_pressure, 0);
    EXPECT_GE(film.pressure.minCoeff(), 0);
    EXPECT_GE(film.fill.minCoeff(), 0);
    EXPECT_GE(film.oil.volume.minCoeff(), -1e-15);
    EXPECT_LE(film.fill.maxCoeff(), 1);
    EXPECT_TRUE((film.pressure * (1 - film.fill) == 0).all());
    EXPECT_TRUE(((film.pressure == 0) || (problem.gap > 0)).all());
  }
}

TEST(PatchFilm, KeepsTheVolumeOfOilToRoundOff) {
  for (const double thickness : {0.1e-6, 0.4e-6, 2e-6}) {
    const Field oil = Field::Constant(64, 64, thickness);
    const PatchFilm film = steady_film(rough_patch(64, 0.5e-6), oil);
    expect_within("EHL", "rough patch, 64 x 64", "volume of oil, relative", "conservation",
                  std::abs((film.oil.volume.sum() + film.oil.outside) / oil.sum() - 1), 1e-12);
    // The fills say the same as the volumes.
    const Field stated = film.fill * rough_patch(64, 0.5e-6).gap;
    EXPECT_NEAR(stated.sum() / film.oil.volume.sum(), 1, 1e-5);
  }
}

TEST(PatchFilm, PressureGoesWithViscosityTimesSpeed) {
  PatchProblem problem = rough_patch(48, 0.5e-6);
  problem.vent_pressure = 1e9;
  const Field oil = Field::Constant(48, 48, 0.4e-6);
  const PatchFilm slow = steady_film(problem, oil);
  problem.viscosity *= 2;
  problem.entrainment_speed *= 5;
  const PatchFilm fast = steady_film(problem, oil);
  ASSERT_TRUE(slow.convergence.converged() && fast.convergence.converged());
  EXPECT_NEAR(fast.mean_pressure / (10 * slow.mean_pressure), 1, 1e-6);
  EXPECT_TRUE((fast.fill - slow.fill).abs().maxCoeff() < 1e-6);
}

TEST(PatchFilm, MirrorsWithTheSurfaceAcrossTheSlidingDirection) {
  PatchProblem problem = rough_patch(64, 0.5e-6);
  const Field oil = Field::Constant(64, 64, 0.4e-6);
  const PatchFilm film = steady_film(problem, oil);
  problem.gap = problem.gap.colwise().reverse().eval();
  const PatchFilm mirrored = steady_film(problem, oil);
  EXPECT_NEAR(mirrored.mean_pressure / film.mean_pressure, 1, 1e-3);
}

TEST(PatchFilm, ClearsOilThatIsTooLittleOutOfTheWay) {
  // Rows that nothing blocks take it up, and nothing is carried any more.
  PatchProblem problem = rough_patch(64, 0.5e-6);
  problem.pressure_resolution = 1;
  const PatchFilm film = steady_film(problem, Field::Constant(64, 64, 0.1e-6));
  EXPECT_TRUE(film.convergence.converged());
  const PatchFilm more = steady_film(problem, Field::Constant(64, 64, 0.4e-6));
  EXPECT_LT(film.mean_pressure, 1e-3 * more.mean_pressure);
}

TEST(PatchFilm, DissipatesWhatTheFlatPushesIntoThePressure) {
  // u_m times the sum of theta h dp/dx over the faces is the power of the driven flow.
  const PatchProblem problem = rough_patch(64, 0.5e-6);
  const PatchFilm film = steady_film(problem, Field::Constant(64, 64, 0.4e-6));
  const PatchCells cells = patch_cells(problem);
  double power = 0;
  for (Index cell = 0; cell < cells.size(); ++cell) {
    const Index right = cells.around(cell).right;
    power += cells.carried.data()[cell] * film.fill.data()[cell] *
             (film.pressure.data()[right] - film.pressure.data()[cell]);
  }
  EXPECT_NEAR(film.dissipation / (power / static_cast<double>(cells.size())), 1, 1e-2);
}

TEST(PatchFilm, IsTheSameFromThePatchItselfAndFromACoarserOne) {
  PatchProblem problem = rough_patch(64, 0.5e-6);
  const Field oil = Field::Constant(64, 64, 0.4e-6);
  const PatchFilm film = steady_film(problem, oil);
  PatchFilm nothing;
  nothing.pressure = Field::Zero(1, 1);
  nothing.fill = Field::Ones(1, 1);  // spread evenly
  EXPECT_NEAR(steady_film(problem, oil, nothing).mean_pressure / film.mean_pressure, 1, 0.03);
}

TEST(PatchFilm, DoesNotHangOnWhereInAPixelAContactBegins) {
  // A round contact in a gap that opens as a cone, moved by parts of a pixel: the open pixel next
  // to it is now thicker, now thinner.
  const auto pressure = [](double shift) {
    Field gap(48, 48);
    for (Index row = 0; row < 48; ++row) {
      for (Index column = 0; column < 48; ++column) {
        const double x = static_cast<double>(column) - 24 - shift;
        const double y = static_cast<double>(row) - 24 - 0.6 * shift;
        gap(row, column) = std::max(0.0, 0.05e-6 * (std::hypot(x, y) - 8));
      }
    }
    const PatchFilm film = steady_film(row_patch(gap), 0.7 * gap);
    EXPECT_TRUE(film.convergence.converged()) << shift;
    return film.mean_pressure;
  };
  double lowest = 1e300;
  double highest = 0;
  for (const double shift : {0.0, 0.2, 0.4, 0.6, 0.8}) {
    lowest = std::min(lowest, pressure(shift));
    highest = std::max(highest, pressure(shift));
  }
  EXPECT_LT(highest / lowest, 1.3);
}

TEST(PatchFilm, HasNoPressureWithoutOilOrSpeed) {
  PatchProblem problem = rough_patch(32, 0.5e-6);
  const PatchFilm dry = steady_film(problem, Field::Zero(32, 32));
  EXPECT_TRUE(dry.convergence.converged() && (dry.pressure == 0).all());
  problem.entrainment_speed = 0;
  const PatchFilm at_rest = steady_film(problem, Field::Constant(32, 32, 1e-6));
  EXPECT_TRUE(at_rest.convergence.converged() && (at_rest.pressure == 0).all());
}

TEST(PatchFilm, HasTheSameBitsForAnyThreadCount) {
  const PatchProblem problem = rough_patch(64, 0.5e-6);
  const Field oil = Field::Constant(64, 64, 0.4e-6);
  set_thread_count(1);
  const PatchFilm one = steady_film(problem, oil);
  set_thread_count(3);
  const PatchFilm three = steady_film(problem, oil);
  set_thread_count(0);
  EXPECT_TRUE((one.pressure == three.pressure).all() && (one.fill == three.fill).all());
}

TEST(PatchFilm, RejectsWhatMakesNoSense) {
  const Field oil = Field::Constant(1, 4, 1e-6);
  const PatchProblem good = row_patch(Field::Constant(1, 4, 1e-6));
  EXPECT_NO_THROW(steady_film(good, oil));
  PatchProblem bad = good;
  bad.entrainment_speed = -1e-3;
  EXPECT_THROW(steady_film(bad, oil), InputError);
  bad = good;
  bad.viscosity = 0;
  EXPECT_THROW(steady_film(bad, oil), InputError);
  bad = good;
  bad.gap(0, 1) = std::nan("");
  EXPECT_THROW(steady_film(bad, oil), InputError);
  EXPECT_THROW(steady_film(good, Field::Constant(1, 3, 1e-6)), InputError);
  EXPECT_THROW(steady_film(good, -oil), InputError);
}

}  // namespace
}  // namespace tabor::reynolds
