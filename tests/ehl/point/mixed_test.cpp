#include "tabor/ehl/point/mixed.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "ehl/point/redlich.hpp"
#include "support/rejection.hpp"
#include "support/stopping.hpp"
#include "support/validation.hpp"
#include "tabor/ehl/point/dry.hpp"
#include "tabor/ehl/point/measures.hpp"
#include "tabor/ehl/point/roughness.hpp"
#include "tabor/synthesis/synthesis.hpp"

namespace tabor::ehl {
namespace {

using test::expect_within;
using test::rejection;
using testing::HasSubstr;

constexpr double kMicro = 1e-6;

/// Redlich's case on a small domain and a coarse grid; solids rub only where they flow, as there.
PointProblem small_case(double ball_speed, Index nodes = 65) {
  PointProblem problem = test::redlich_case(ball_speed, nodes);
  problem.inlet = 2.5;
  problem.half_width = 1.75;
  problem.nodes_y = nodes * 7 / 8;
  problem.asperities.friction_coefficient = 0;
  return problem;
}

struct Finish {
  double rms = 0;                 // [m]
  double longest = 0;             // roll-off wavelength [m]
  double stretch = 1;             // along the flow over across it
  double shortest = 10 * kMicro;  // wavelength [m] that the coarse grids of these tests can hold
};
constexpr Finish kLapped{.rms = 0.15 * kMicro, .longest = 20 * kMicro};
constexpr Finish kPolished{.rms = 0.08 * kMicro, .longest = 40 * kMicro};

/// Gaussian heights at the spacing of the paper's microscope.
Field rough(const PointProblem& problem, const Finish& finish, bool turned = false,
            std::uint64_t seed = 1) {
  constexpr double spacing = 200 * kMicro / 255;
  synthesis::SelfAffine recipe;
  recipe.grid = {256, 256, 256 * spacing, 256 * spacing};
  recipe.rms_height = finish.rms;
  recipe.roll_off_wavelength = finish.longest;
  recipe.short_cutoff_wavelength = finish.shortest;
  recipe.random_amplitudes = true;
  recipe.stretch = finish.stretch;
  recipe.seed = seed;
  Field height = synthesis::self_affine(recipe).height;
  if (turned) height = height.transpose().eval();
  return point_map(problem, {.height = height, .spacing_x = spacing, .spacing_y = spacing});
}

void expect_conditions(const PointProblem& problem, const PointResult& result) {
  EXPECT_TRUE(result.convergence.converged());
  EXPECT_LE(result.load_error, problem.tolerance);
  EXPECT_LE(result.mass_error, problem.tolerance);
  EXPECT_GE(result.film.minCoeff(), 0);
  EXPECT_GE(result.pressure.minCoeff(), 0);
  Field total = result.pressure;
  if (result.contact_pressure.size() > 0) {
    EXPECT_GE(result.contact_pressure.minCoeff(), 0);
    const Mask solid = touching_nodes(result);
    EXPECT_TRUE((solid == (result.film <= 0 || result.plastic_depth > 0)).all());
    EXPECT_EQ(solid.select(0, result.contact_pressure).maxCoeff(), 0);
    EXPECT_EQ(solid.select(result.pressure, 0).maxCoeff(), 0);
    total += result.contact_pressure;
  }
  EXPECT_LE(total.maxCoeff(), problem.plastic_pressure);
  EXPECT_NEAR(total.sum() * result.grid.pixel_area() / problem.load, 1, 1e-6);
  EXPECT_GE(result.plastic_depth.minCoeff(), 0);
  EXPECT_EQ(((problem.plastic_pressure - total) * result.plastic_depth).maxCoeff(), 0);
}

TEST(SolvePointMixed, IsTheFilmOfSmoothBodiesWhereNothingTouches) {
  PointProblem problem = small_case(1);
  problem.plastic_pressure = kNoPlasticLimit;
  const PointResult smooth = solve_point(problem);
  const PointResult mixed = solve_point_mixed(problem);
  ASSERT_TRUE(smooth.convergence.converged() && mixed.convergence.converged());
  EXPECT_LE((mixed.film - smooth.film).abs().maxCoeff(), 1e-5 * smooth.film.minCoeff());
  EXPECT_LE((mixed.pressure - smooth.pressure).abs().maxCoeff(), 1e-5 * smooth.pressure.maxCoeff());
  EXPECT_EQ(mixed.contact_pressure.size(), 0);
}

TEST(SolvePointMixed, KeepsEveryConditionFromFullFilmToContact) {
  PointResult result;
  for (const double speed : {10.0, 1.0, 0.1, 0.01, 0.003}) {
    PointProblem problem = small_case(speed);
    problem.roughness = rough(problem, kLapped);
    result = solve_point(problem, speed < 10 ? &result : nullptr);
    expect_conditions(problem, result);
  }
  EXPECT_GT(result.plastic_depth.maxCoeff(), 0);
  ASSERT_GT(result.contact_pressure.size(), 0);
  EXPECT_GT(result.contact_pressure.maxCoeff(), 0);
}

TEST(SolvePointMixed, DoesNotDependOnTheWay) {
  PointProblem problem = small_case(0.3);
  problem.roughness = rough(problem, kLapped);
  const PointResult cold = solve_point(problem);
  PointProblem slower = small_case(0.1);
  slower.roughness = problem.roughness;
  const PointResult other = solve_point(slower);
  const PointResult back = solve_point(problem, &other);
  ASSERT_TRUE(cold.convergence.converged() && other.convergence.converged() &&
              back.convergence.converged());
  EXPECT_NEAR(measure_point(problem, back).friction_coefficient,
              measure_point(problem, cold).friction_coefficient, 1e-5);
  EXPECT_LE((back.film - cold.film).abs().maxCoeff(), 1e-3 * cold.film.mean());
}

/// Seven surfaces that solids touch and flow on, on a grid that a coarser one leads to.
TEST(SolvePointMixed, TakesFewStepsOnFinerGrids) {
  int iterations = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7}) {
    PointProblem problem = small_case(2, 113);
    problem.roughness = rough(problem, kLapped, false, seed);
    const PointResult result = solve_point(problem);
    expect_conditions(problem, result);
    EXPECT_GT(result.plastic_depth.maxCoeff(), 0);
    iterations += result.convergence.iterations;
  }
  EXPECT_LE(iterations, 7 * 40);
}

/// From a coarser grid, one node changes to and fro between flowing and liquid.
TEST(SolvePointMixed, TakesStepsInTimeWhereNewtonsMethodFails) {
  PointProblem problem = small_case(50, 113);
  problem.roughness = rough(problem, kLapped, false, 1);
  const PointResult result = solve_point(problem);
  expect_conditions(problem, result);
  EXPECT_LE(result.convergence.iterations, 150);
}

TEST(SolvePointMixed, TendsToTheDryContactAsTheSpeedVanishes) {
  PointProblem problem = small_case(1e-5);
  const PointResult result = solve_point(problem);
  const PointResult dry = solve_point_dry(problem);
  ASSERT_TRUE(result.convergence.converged() && dry.convergence.converged());
  const PointMeasures measures = measure_point(problem, result);
  EXPECT_GT(measures.contact_load_share, 0.9);
  expect_within(
      "EHL", "mixed point contact, 10 um/s, 65 nodes",
      "largest difference of pressure from the dry contact, over its maximum", "the dry solver",
      (result.pressure + result.contact_pressure - dry.contact_pressure).abs().maxCoeff() /
          dry.contact_pressure.maxCoeff(),
      0.02);
}

TEST(SolvePointMixed, TakesTheBumpPlastically) {
  PointProblem problem = test::redlich_case(0.1, 133);
  problem.inlet = 1.75;
  problem.outlet = problem.half_width = 1.25;
  problem.nodes_y = 111;
  problem.roughness = point_bump(problem, 0.5 * kMicro, 10 * kMicro);
  const PointResult result = solve_point(problem);
  expect_conditions(problem, result);
  const double depth = measure_point(problem, result).max_plastic_depth;
  EXPECT_EQ(result.contact_pressure.maxCoeff(), 4e9);
  // What the cap can bend flat beyond Hertz' pressure, on a disc as wide as the bump, stays
  // elastic.
  const double elastic =
      2 * (4e9 - hertz_of(problem).max_pressure) * 2.5 * kMicro / problem.effective_modulus;
  EXPECT_LT(depth, 0.5 * kMicro);
  EXPECT_GT(depth, 0.5 * kMicro - 2 * elastic);
  test::record_unreproduced(
      "EHL", "point contact, bump of 500 nm under 4 GPa, 1.2 um between nodes", "plastic depth, nm",
      "Redlich, Bartel & Deters 2003", 350, depth / 1e-9,
      "deeper still on finer grids: beyond the Hertz pressure of 2.67 GPa the cap of 4 GPa on a "
      "disc of 2.5 um bends steel by 58 nm only, not by the remaining 150 nm");
}

/// Measures from fast to slow, each from the one before.
std::vector<PointMeasures> stribeck(const Finish& finish, const std::vector<double>& speeds) {
  std::vector<PointMeasures> curve;
  curve.reserve(speeds.size());
  PointResult last;
  for (const double speed : speeds) {
    PointProblem problem = small_case(speed);
    problem.roughness = rough(problem, finish);
    last = solve_point(problem, curve.empty() ? nullptr : &last);
    EXPECT_TRUE(last.convergence.converged()) << speed;
    curve.push_back(measure_point(problem, last));
  }
  return curve;
}

TEST(SolvePointMixed, RisesForALappedAndFallsForAPolishedSurface) {
  const std::vector<double> speeds{10, 1, 0.1, 0.01};
  const std::vector<PointMeasures> lapped = stribeck(kLapped, speeds);
  const std::vector<PointMeasures> polished = stribeck(kPolished, speeds);
  // Separated at 10 m/s, but for summits that flow under the liquid.
  EXPECT_EQ(lapped[0].boundary_load_share, 0);
  EXPECT_EQ(lapped[0].solid_contact_fraction, lapped[0].plastic_fraction);
  EXPECT_EQ(polished[0].solid_contact_fraction, 0);
  EXPECT_GT(lapped[2].friction_coefficient, 1.2 * lapped[0].friction_coefficient);
  EXPECT_GT(lapped[3].friction_coefficient, 1.2 * lapped[0].friction_coefficient);
  EXPECT_LT(polished[2].friction_coefficient, polished[0].friction_coefficient);
  EXPECT_LT(polished[3].friction_coefficient, polished[2].friction_coefficient);
  EXPECT_GT(lapped[3].contact_load_share, polished[3].contact_load_share);
  EXPECT_GT(lapped[2].plastic_fraction, 4 * polished[2].plastic_fraction);
}

TEST(SolvePointMixed, KeepsLessLiquidBetweenRidgesAlongTheFlowThanAcrossIt) {
  const Finish ground{.rms = 0.12 * kMicro, .longest = 16 * kMicro, .stretch = 8};
  const auto at_turn = [&](bool turned) {
    PointProblem problem = small_case(1);
    problem.roughness = rough(problem, ground, turned);
    const PointResult result = solve_point(problem);
    expect_conditions(problem, result);
    return measure_point(problem, result);
  };
  const PointMeasures longitudinal = at_turn(false);
  const PointMeasures transverse = at_turn(true);
  EXPECT_LT(longitudinal.fluid_volume, transverse.fluid_volume);
  EXPECT_LT(longitudinal.central_film, transverse.central_film);
  EXPECT_LT(longitudinal.min_film, transverse.min_film);
}

struct DryShares {
  const char* name;
  Finish finish;
  double contact, plastic;  // of the Hertz area, as printed
};

class DryFinish : public testing::TestWithParam<DryShares> {};

TEST_P(DryFinish, TouchesAndFlowsOnAboutThePrintedShares) {
  const auto& [name, finish, contact, plastic] = GetParam();
  PointProblem problem = test::redlich_dry(257);
  problem.roughness = rough(problem, finish);
  const PointResult result = solve_point_dry(problem);
  EXPECT_TRUE(result.convergence.converged());
  const PointMeasures measures = measure_point(problem, result);
  expect_within("EHL", std::string("dry point contact, ") + name, "share that touches",
                "Redlich, Bartel & Deters 2003; the wavelengths of our surface are chosen to fit",
                std::abs(measures.solid_contact_fraction - contact), 0.1);
  expect_within("EHL", std::string("dry point contact, ") + name, "share that flows",
                "Redlich, Bartel & Deters 2003; the wavelengths of our surface are chosen to fit",
                std::abs(measures.plastic_fraction - plastic), 0.05);
}

INSTANTIATE_TEST_SUITE_P(
    EHL, DryFinish,
    testing::Values(DryShares{"lapped-like",
                              {.rms = 0.15 * kMicro, .longest = 8 * kMicro, .shortest = 0},
                              0.45,
                              0.37},
                    DryShares{"polished-like", kPolished, 0.80, 0.06}));

TEST(MeasurePoint, CountsTheFrictionOfWhatTouchesWithoutFlowing) {
  PointProblem problem = test::redlich_dry(129);
  problem.roughness = rough(problem, kLapped);
  const PointResult result = solve_point_dry(problem);
  const Mask elastic = result.contact_pressure > 0 && result.plastic_depth <= 0;
  ASSERT_TRUE(elastic.any() && (result.plastic_depth > 0).any());
  const double cell = result.grid.pixel_area();
  EXPECT_TRUE(std::isnan(measure_point(problem, result).friction_solid));  // nobody knows
  EXPECT_TRUE(std::isnan(measure_point(problem, result).friction_coefficient));
  problem.asperities.friction_coefficient = 0;
  const double bonds = measure_point(problem, result).friction_solid;
  EXPECT_GT(bonds, 0);
  problem.asperities.friction_coefficient = 0.1;
  EXPECT_NEAR(measure_point(problem, result).friction_solid,
              bonds + 0.1 * cell * elastic.select(result.contact_pressure, 0).sum() / problem.load,
              1e-12);
  problem.asperities = {.boundary_film = 1e-9, .shear_strength = 50e6};
  EXPECT_NEAR(measure_point(problem, result).friction_solid,
              bonds + 50e6 * cell * static_cast<double>(elastic.count()) / problem.load, 1e-12);
}

TEST(MeasurePoint, CountsWhatFlowsAsTouching) {
  PointProblem problem = small_case(0.1);
  problem.roughness = rough(problem, kLapped);
  const PointResult result = solve_point(problem);
  ASSERT_TRUE(result.convergence.converged());
  // Summits that flow under liquid that is left there.
  ASSERT_TRUE((result.plastic_depth > 0 && result.film > 0).any());
  const PointMeasures measures = measure_point(problem, result);
  EXPECT_GE(measures.solid_contact_fraction, measures.plastic_fraction);
  const double flowing = 4e9 * static_cast<double>((result.plastic_depth > 0).count()) *
                         result.grid.pixel_area() / problem.load;
  EXPECT_NEAR(measures.contact_load_share, flowing + measures.boundary_load_share, 1e-9);
  EXPECT_EQ(slice_plane(problem, result, {0}).front(), measures.solid_contact_fraction);
}

TEST(MeasurePoint, FrictionHasTheSignOfTheSliding) {
  PointProblem problem = test::redlich_dry(129);
  problem.roughness = rough(problem, kLapped);
  problem.asperities.friction_coefficient = 0.1;
  PointResult result = solve_point_dry(problem);
  result.pressure = result.contact_pressure;  // of a film as well
  result.film += 1e-8;
  const PointMeasures forwards = measure_point(problem, result);
  problem.sliding_speed = -problem.sliding_speed;
  const PointMeasures backwards = measure_point(problem, result);
  EXPECT_GT(forwards.friction_solid, 0);
  EXPECT_GT(forwards.friction_fluid, 0);
  EXPECT_EQ(backwards.friction_coefficient, -forwards.friction_coefficient);
  EXPECT_EQ(backwards.max_shear_stress, forwards.max_shear_stress);
  problem.sliding_speed = 0;
  EXPECT_EQ(measure_point(problem, result).friction_coefficient, 0);
}

TEST(SolvePointMixed, RejectsNegativeFrictionOfAsperities) {
  PointProblem problem = small_case(0.1);
  problem.asperities.friction_coefficient = -0.1;
  EXPECT_THAT(rejection([&] { solve_point(problem); }), HasSubstr("friction coefficient"));
}

TEST(SolvePointMixed, SaysWhatDidNotConverge) {
  PointProblem problem = small_case(0.1);
  problem.roughness = rough(problem, kLapped);
  problem.max_iterations = 1;
  EXPECT_TRUE(solve_point(problem).convergence.failed());
}

TEST(SolvePointMixed, StopsAtAnyQuestion) {
  PointProblem problem = small_case(0.1, 33);
  problem.roughness = rough(problem, kLapped);
  for (const int max_iterations : {60, 2}) {
    problem.max_iterations = max_iterations;
    test::expect_to_stop_at_once([&](const Observer& observer) {
      return solve_point(problem, nullptr, observer).convergence;
    });
  }
  test::expect_to_stop_at_once(
      [&](const Observer& observer) { return solve_point_dry(problem, observer).convergence; });
}

TEST(SolvePointMixed, HasTheShapeOfItsGridWhereStoppedOnACoarserOne) {
  PointProblem problem = small_case(2, 113);
  problem.roughness = rough(problem, kLapped);
  for (const int last : {2, 6, 12, 16}) {
    int questions = 0;
    const PointResult result =
        solve_point(problem, nullptr, [&](const Progress&) { return ++questions < last; });
    EXPECT_TRUE(result.convergence.stopped());
    EXPECT_EQ(result.pressure.cols(), 113);
    EXPECT_EQ(result.film.rows(), problem.nodes_y);
  }
}

TEST(SolvePointMixed, RejectsABoundaryFilmOfNothing) {
  PointProblem problem = small_case(0.1);
  problem.asperities.boundary_film = 0;
  EXPECT_THAT(rejection([&] { solve_point(problem); }), HasSubstr("boundary film"));
}

}  // namespace
}  // namespace tabor::ehl
