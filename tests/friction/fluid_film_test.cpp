// Load shared between solids and a film of oil.
#include "tabor/friction/fluid_film.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/stopping.hpp"
#include "support/validation.hpp"
#include "tabor/core/error.hpp"
#include "tabor/elastic/half_space.hpp"
#include "tabor/friction/load_search.hpp"
#include "tabor/friction/mixed_friction.hpp"
#include "tabor/reynolds/line/reynolds_film.hpp"

namespace tabor::friction {
namespace {

constexpr double kSide = 100e-6;

/// A wave along x of 1 um amplitude, n x 4 pixels.
Field wave(Index n) {
  Field height(4, n);
  for (Index i = 0; i < n; ++i) {
    const double phase = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
    height.col(i) = 1e-6 * std::cos(phase);
  }
  return height;
}

/// A wave along x with crests of different height along y, n x n pixels.
Field bumps(Index n) {
  Field height(n, n);
  const double step = 2 * std::numbers::pi / static_cast<double>(n);
  for (Index row = 0; row < n; ++row) {
    for (Index column = 0; column < n; ++column) {
      const double x = step * static_cast<double>(column);
      const double y = step * static_cast<double>(row);
      height(row, column) =
          0.5e-6 * (std::cos(2 * x + 0.7) + std::cos(3 * y - 0.4) + std::cos(x + 2 * y));
    }
  }
  return height;
}

struct Case {
  std::unique_ptr<elastic::ElasticOperator> elasticity;
  FluidFilmProblem problem;
  contact::State dry;

  FluidFilmState solve() const { return solve_fluid_film(*elasticity, problem, dry); }
};

Case pressed(const Field& height, double pressure, double oil, double speed,
             double modulus = 80e9) {
  const Grid grid{height.cols(), height.rows(), kSide,
                  kSide * static_cast<double>(height.rows()) / static_cast<double>(height.cols())};
  Case result;
  result.elasticity = elastic::make_periodic(grid, modulus);
  result.problem.contact.height = height;
  result.problem.contact.control = contact::MeanPressure{pressure};
  result.problem.film = Field::Constant(height.rows(), height.cols(), oil);
  result.problem.sliding_speed = speed;
  result.problem.lubricant.viscosity = material::constant_viscosity(0.2);
  result.dry = contact::solve(*result.elasticity, result.problem.contact);
  return result;
}

TEST(LoadSearch, FindsTheZeroOfIncreasingFunctionsOnBothSides) {
  for (const double root : {0.9, 0.31, 0.02, -0.3, -7.0}) {
    LoadSearch search;
    double position = 1;
    int n = 0;
    while (std::abs(std::asinh(3 * (position - root))) > 1e-6 && n < 60) {
      position = search.next(position, std::asinh(3 * (position - root)));
      ++n;
    }
    EXPECT_NEAR(position, root, 1e-5);
    EXPECT_LT(n, 25) << root;
  }
}

// The square of a position up to 1 is the solids' share: of a film that carries 36 % of the load in
// the dry contact's gap, and less in a wider one, they take at least 64 %.
TEST(LoadSearch, FirstLeavesTheSolidsWhatTheFilmCannotCarry) {
  EXPECT_NEAR(LoadSearch().next(1, std::log(1.36)), 0.8, 1e-15);
  EXPECT_LT(LoadSearch().next(1, std::log(3.0)), 0.8);
}

// The surface gives way while the load is searched for.
TEST(LoadSearch, FindsAZeroThatMovesWhileItIsSearched) {
  for (const double moved : {0.6, 0.05}) {
    for (const double slope : {0.2, 5.0}) {
      LoadSearch search;
      double position = 1;
      int n = 0;
      const auto value = [&] { return slope * (position - (n < 4 ? 0.31 : moved)); };
      for (; n < 4 || std::abs(value()) > 1e-6; ++n) {
        ASSERT_LT(n, 60) << moved << " " << slope;
        position = search.next(position, value());
      }
      EXPECT_NEAR(position, moved, 1e-6 / slope);
    }
  }
}

TEST(FluidFilm, IsTheDryContactToTheBitWithoutOilOrSpeed) {
  for (const auto& [oil, speed] : {std::pair{0.0, 1.0}, std::pair{1e-6, 0.0}}) {
    const Case at = pressed(bumps(32), 50e6, oil, speed);
    const FluidFilmState state = at.solve();
    EXPECT_TRUE(state.convergence.converged());
    EXPECT_TRUE((state.contact.pressure == at.dry.pressure).all());
    EXPECT_EQ(state.fluid_pressure, 0);
    EXPECT_EQ(state.viscous_stress, 0);
    EXPECT_EQ(state.solid_pressure, 50e6);
  }
}

TEST(FluidFilm, TendsToTheDryContactWithTheSpeed) {
  double share_before = 1;
  for (const double speed : {1.0, 0.1, 0.01, 1e-6}) {
    const Case at = pressed(bumps(32), 50e6, 0.6e-6, speed);
    const FluidFilmState state = at.solve();
    ASSERT_TRUE(state.convergence.converged()) << speed;
    const double share = state.fluid_pressure / 50e6;
    EXPECT_LT(share, share_before) << speed;
    share_before = share;
  }
  EXPECT_LT(share_before, 1e-5);
  const Case slow = pressed(bumps(32), 50e6, 0.6e-6, 1e-6);
  const FluidFilmState state = slow.solve();
  EXPECT_TRUE((state.contact.pressure == slow.dry.pressure).all());
  EXPECT_LT(state.viscous_stress, 1e-5 * 50e6);
}

TEST(FluidFilm, SharesTheLoad) {
  const Case at = pressed(bumps(32), 20e6, 0.6e-6, 1.0);
  const FluidFilmState state = at.solve();
  ASSERT_TRUE(state.convergence.converged());
  EXPECT_GT(state.fluid_pressure, 0.02 * 20e6);
  EXPECT_GT(state.solid_pressure, 0);
  EXPECT_NEAR((state.contact.pressure.mean() + state.film.pressure.mean()) / 20e6, 1, 1e-3);
  EXPECT_LT((state.contact.pressure > 0).count(), (at.dry.pressure > 0).count());
  EXPECT_GT(state.mean_gap, at.dry.gap.mean());
  // Solids touch where there is no film, and the gap is what both pressures leave.
  EXPECT_TRUE(((state.contact.pressure == 0) || (state.film.pressure == 0)).all());
  Field displacement(32, 32);
  at.elasticity->apply(state.contact.pressure + state.film.pressure, displacement);
  const Field gap =
      state.contact.separation + displacement - at.problem.contact.height - state.contact.gap;
  EXPECT_LT(gap.abs().maxCoeff(), 0.02 * state.mean_gap);
}

/// Mean pressure of the gap of `state` along its first row, by the film solver for lines: widest at
/// both ends, where the vent is.
double pressure_on_a_line(const FluidFilmState& state, double amplitude, Index n) {
  const double middle = state.contact.gap.row(0).mean();
  reynolds::FilmProblem line;
  line.grid = reynolds::line_grid(-kSide / 2, kSide / 2, n);
  line.film = line.grid.node.unaryExpr(
      [&](double x) { return middle - amplitude * std::cos(2 * std::numbers::pi * x / kSide); });
  line.speed = 0.5;  // half of 1 m/s
  line.left_pressure = line.right_pressure = 101325;
  line.liquid = reynolds::constant_liquid(0.2);
  line.cavitation = reynolds::Cavitation::mass_conserving;
  const reynolds::FilmSolution solution = reynolds::solve_film(line);
  EXPECT_TRUE(solution.convergence.converged());
  return solution.load / kSide;
}

TEST(FluidFilm, LiftsAFloodedWaveOffWhereALineFilmCarriesTheLoad) {
  // As good as rigid, so that the gap is the wave's.
  const double pressure = 2e6;
  const auto error = [&](Index n) {
    const Case at = pressed(wave(n), pressure, 50e-6, 1.0, 1e15);
    const FluidFilmState state = at.solve();
    EXPECT_TRUE(state.convergence.converged());
    EXPECT_EQ(state.solid_pressure, 0);
    EXPECT_TRUE((state.contact.pressure == 0).all());
    EXPECT_GT(state.contact.gap.minCoeff(), 0);
    return pressure_on_a_line(state, 1e-6, 4000) / pressure - 1;
  };
  const double coarse = error(64);
  const double fine = error(256);
  EXPECT_LT(std::abs(fine), std::abs(coarse));
  test::expect_within("EHL", "full film over a wave, 256 pixels", "mean pressure, relative",
                      "film on a line, 4000 cells", std::abs(fine), 5e-4);
}

TEST(FluidFilm, GivesWayOnSofterSurfaces) {
  const Case at = pressed(bumps(32), 20e6, 0.6e-6, 0.2, 8e9);
  const FluidFilmState state = at.solve();
  EXPECT_TRUE(state.convergence.converged());
  EXPECT_GT(state.fluid_pressure, 0.001 * 20e6);
  EXPECT_NEAR((state.solid_pressure + state.fluid_pressure) / 20e6, 1, 1e-3);
}

TEST(FluidFilm, PressureIsThatOfTheGapItMakes) {
  for (const double modulus : {80e9, 8e9}) {
    const Case at = pressed(bumps(32), 20e6, 0.6e-6, 1.0, modulus);
    const FluidFilmState state = at.solve();
    ASSERT_TRUE(state.convergence.converged()) << modulus;
    ASSERT_GT(state.fluid_pressure, 0.01 * 20e6);
    Field displacement(32, 32);
    at.elasticity->apply(state.contact.pressure + state.film.pressure, displacement);
    reynolds::PatchProblem patch;
    patch.grid = at.elasticity->grid();
    patch.gap = state.contact.separation + displacement - at.problem.contact.height;
    patch.gap = (state.contact.pressure > 0).select(0.0, patch.gap.max(0.0));
    patch.viscosity = 0.2;
    patch.entrainment_speed = 0.5;
    const reynolds::PatchFilm again = reynolds::steady_film(patch, at.problem.film);
    EXPECT_NEAR(again.mean_pressure / 20e6, state.fluid_pressure / 20e6, 3e-3) << modulus;
  }
}

TEST(FluidFilm, SaysWhenItDidNotConverge) {
  Case at = pressed(bumps(32), 20e6, 0.6e-6, 1.0);
  at.problem.max_evaluations = 1;
  const FluidFilmState state = at.solve();
  EXPECT_EQ(state.convergence.status, Status::iteration_limit);
  EXPECT_GT(std::abs(state.load_error), 1e-3);
  EXPECT_GE(state.convergence.certificate, std::abs(state.load_error));
}

TEST(FluidFilm, TellsHowFarTheSharedLoadIs) {
  const Case at = pressed(bumps(32), 20e6, 0.6e-6, 1.0);
  std::vector<double> certificates;
  const Observer observer = [&](const Progress& progress) {
    EXPECT_TRUE(std::isnan(progress.fraction));
    if (progress.convergence == nullptr) return true;
    EXPECT_EQ(progress.convergence->tolerance, at.problem.tolerance);
    const double one = progress.convergence->certificate;
    if (certificates.empty() || certificates.back() != one) certificates.push_back(one);
    return true;
  };
  const FluidFilmState state = solve_fluid_film(*at.elasticity, at.problem, at.dry, observer);
  ASSERT_TRUE(state.convergence.converged());
  EXPECT_EQ(static_cast<int>(certificates.size()), state.convergence.iterations - 1);
}

TEST(FluidFilm, StopsAtAnyQuestion) {
  const Case at = pressed(bumps(32), 20e6, 0.6e-6, 1.0);
  test::expect_to_stop_at_once([&](const Observer& observer) {
    return solve_fluid_film(*at.elasticity, at.problem, at.dry, observer).convergence;
  });
}

TEST(FluidFilm, IsNotWarnedOfForBeingStopped) {
  const Case at = pressed(bumps(32), 20e6, 0.6e-6, 1.0);
  FluidFilmState state = at.solve();
  state.convergence.status = Status::stopped;
  EXPECT_TRUE(warnings(state, at.problem).empty());
}

TEST(FluidFilm, FlatSurfacesSqueezeTheOilOut) {
  const Case at = pressed(Field::Zero(8, 8), 1e6, 1e-6, 1.0);
  const FluidFilmState state = at.solve();
  EXPECT_TRUE(state.convergence.converged());
  EXPECT_EQ(state.fluid_pressure, 0);
  EXPECT_NEAR(state.film.oil.outside, 64 * 1e-6, 1e-15);
}

TEST(FluidFilm, AnEyringOilShearsLess) {
  Case at = pressed(bumps(32), 20e6, 0.6e-6, 1.0);
  const FluidFilmState newtonian = at.solve();
  at.problem.lubricant.shear = material::ree_eyring_shear(1e5);
  const FluidFilmState eyring = at.solve();
  ASSERT_TRUE(newtonian.convergence.converged() && eyring.convergence.converged());
  EXPECT_LT(eyring.viscous_stress, newtonian.viscous_stress);
  EXPECT_LT(eyring.fluid_pressure, newtonian.fluid_pressure);
}

TEST(FluidFilm, RejectsWhatMakesNoSense) {
  Case at = pressed(bumps(16), 20e6, 0.6e-6, -1.0);
  EXPECT_THROW(at.solve(), InputError);
  at.problem.sliding_speed = 1;
  EXPECT_NO_THROW(at.solve());
  at.problem.film = Field::Zero(3, 3);
  EXPECT_THROW(at.solve(), InputError);
  at = pressed(bumps(16), 20e6, 0.6e-6, 1.0);
  at.elasticity = elastic::make_free(at.elasticity->grid(), 80e9);
  EXPECT_THROW(at.solve(), InputError);
}

}  // namespace
}  // namespace tabor::friction
