// Shear stress over pressure along the flow, and what one asperity makes of it.
#include <gtest/gtest.h>

#include <cmath>

#include "ehl/line/akchurin.hpp"
#include "support/validation.hpp"
#include "tabor/core/error.hpp"
#include "tabor/ehl/line/line.hpp"

namespace tabor::ehl {
namespace {

using test::expect_within;
using test::table_6;

/// Table 6 with `nodes` on the reach of the contact, fine enough for a ridge of 5 um.
LineProblem fine_table_6() {
  LineProblem problem = table_6();
  problem.inlet = 600e-6;
  problem.outlet = 180e-6;
  problem.nodes = 2000;
  return problem;
}

constexpr double kWidth = 5e-6;

LineResult with_asperity(double height, double place = 0) {
  LineProblem problem = fine_table_6();
  problem.roughness = line_asperity(problem, height, kWidth, place);
  LineResult result = solve_line(problem);
  EXPECT_TRUE(result.convergence.converged()) << height;
  return result;
}

/// Of local friction, weighted with the pressure of liquid and solids.
double weighted_mean(const LineProblem& problem, const LineResult& result) {
  const Eigen::ArrayXd pressure = result.asperity_pressure.size() > 0
                                      ? (result.pressure + result.asperity_pressure).eval()
                                      : result.pressure;
  return (result.x[1] - result.x[0]) * (pressure * result.local_friction).sum() / problem.load;
}

TEST(LocalFriction, HasTheFrictionCoefficientAsItsMeanOverThePressure) {
  LineProblem smooth = table_6();
  LineProblem rough = smooth;
  rough.roughness = line_waves(rough, 200e-9, 50e-6);
  LineProblem backwards = smooth;
  backwards.sliding_speed *= -1;
  LineProblem mixed = smooth;
  mixed.entrainment_speed = 1e-3;
  mixed.asperities = {.boundary_film = 30e-9, .friction_coefficient = 0.09};
  for (const LineProblem& problem : {smooth, rough, backwards, mixed}) {
    const LineResult result = solve_line(problem);
    ASSERT_TRUE(result.convergence.converged());
    EXPECT_NEAR(weighted_mean(problem, result) / result.friction_coefficient, 1, 1e-12);
  }
}

TEST(LocalFriction, OfTouchingSolidsIsTheirOwn) {
  LineProblem problem = table_6();
  problem.entrainment_speed = 1e-4;
  problem.asperities = {.boundary_film = 30e-9, .friction_coefficient = 0.09};
  const LineResult result = solve_line(problem);
  ASSERT_GT(result.asperity_load_share, 0.5);
  Index largest = 0;
  result.asperity_pressure.maxCoeff(&largest);
  const double solid = 0.09 * result.asperity_pressure[largest];
  EXPECT_NEAR(result.shear_stress[largest] / solid, 1, 1e-12);
  EXPECT_LE(result.local_friction[largest], 0.09);
}

TEST(LocalFriction, IsZeroWithoutSliding) {
  LineProblem problem = table_6();
  problem.sliding_speed = 0;
  EXPECT_EQ(solve_line(problem).local_friction.abs().maxCoeff(), 0);
}

TEST(LocalFriction, OfAUniformFilmIsCouettesOverPressure) {
  // Constant viscosity, known film and pressure at every node: eta u_s / (h p).
  LineProblem problem = table_6();
  problem.lubricant.viscosity = material::constant_viscosity(0.3638);
  LineResult result;
  result.x = Eigen::ArrayXd::LinSpaced(100, -1e-4, 1e-4);
  result.pressure = 1e7 + 1e11 * result.x.abs();
  result.film.setConstant(100, 1e-7);
  measure_line(problem, result);
  const double stress = 0.3638 * problem.sliding_speed / 1e-7;
  EXPECT_LE((result.shear_stress / stress - 1).abs().maxCoeff(), 1e-14);
  EXPECT_LE((result.local_friction * result.pressure / stress - 1).abs().maxCoeff(), 1e-14);
}

TEST(AsperityEffect, OfAnAsperityWithoutHeightIsNone) {
  const LineResult smooth = solve_line(fine_table_6());
  const AsperityEffect none = asperity_effect(with_asperity(0), smooth, kWidth, 0);
  EXPECT_EQ(none.friction_ratio(), 1);
  EXPECT_EQ(none.pressure_ratio(), 1);
}

TEST(AsperityEffect, GrowsWithHeightButNotWithoutBound) {
  const LineResult smooth = solve_line(fine_table_6());
  double friction = 1;
  double pressure = 1;
  for (const double height : {0.5, 1.0, 1.5, 2.0}) {  // in films
    const AsperityEffect effect =
        asperity_effect(with_asperity(height * smooth.min_film), smooth, kWidth, 0);
    EXPECT_GT(effect.friction_ratio(), friction) << height;
    EXPECT_GT(effect.pressure_ratio(), pressure) << height;
    friction = effect.friction_ratio();
    pressure = effect.pressure_ratio();
  }
  EXPECT_LT(friction, 10);  // the thesis's tenfold is not reached
  EXPECT_LT(pressure, 2);
}

TEST(AsperityEffect, SeesNothingBesideTheAsperity) {
  const LineResult smooth = solve_line(fine_table_6());
  const LineResult rough = with_asperity(150e-9);
  const AsperityEffect on_it = asperity_effect(rough, smooth, kWidth, 0);
  const AsperityEffect before = asperity_effect(rough, smooth, kWidth, -60e-6);
  EXPECT_GT(on_it.friction_ratio(), 1.5);
  EXPECT_NEAR(before.friction_ratio(), 1, 0.3);
}

TEST(AsperityEffect, RecordsWhatAkchurinsAsperityMakes) {
  LineProblem problem = fine_table_6();
  problem.nodes = 8000;
  const LineResult smooth = solve_line(problem);
  problem.roughness = line_asperity(problem, 2 * smooth.min_film, 1e-6, 0);
  const LineResult rough = solve_line(problem);
  ASSERT_TRUE(rough.convergence.converged());
  const AsperityEffect effect = asperity_effect(rough, smooth, 1e-6, 0);
  const char* const name = "line contact, Table 6, one asperity 1 um wide, two smallest films high";
  test::record_unreproduced(
      "EHL", name, "local friction over that without it", "Akchurin's thesis", 10,
      effect.friction_ratio(),
      "stress of the shear between the walls; the pressure gradient adds as much on one wall as it "
      "takes from the other: docs/ehl_line.md");
  test::record_unreproduced("EHL", name, "local pressure over that without it", "Akchurin's thesis",
                            2, effect.pressure_ratio(),
                            "a ridge across the flow: what it holds back lifts it, and a higher "
                            "one presses no harder");
  EXPECT_GT(effect.friction_ratio(), 1);
  EXPECT_GT(effect.pressure_ratio(), 1);
}

TEST(LineAsperity, LiesWithinTheDomain) {
  const LineProblem problem = fine_table_6();
  for (const double place : {-601e-6, 181e-6, std::nan("")}) {
    EXPECT_THROW(line_asperity(problem, 1e-7, kWidth, place), InputError) << place;
  }
  EXPECT_THROW(line_asperity(problem, 1e-7, 1e-6, 0), InputError);  // too narrow for the grid
}

}  // namespace
}  // namespace tabor::ehl
