#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ehl/point/redlich.hpp"
#include "support/rejection.hpp"
#include "support/validation.hpp"
#include "tabor/core/random.hpp"
#include "tabor/ehl/point/dry.hpp"
#include "tabor/ehl/point/measures.hpp"
#include "tabor/ehl/point/roughness.hpp"

namespace tabor::ehl {
namespace {

using test::expect_within;
using test::redlich_case;
using test::redlich_dry;
using test::rejection;
using testing::HasSubstr;

constexpr double kMicro = 1e-6;

// Heights that cubic convolution takes exactly: a parabola in x times one in y.
double parabolas(double x, double y) { return (1 + 3 * x - 2 * x * x) * (2 - y + y * y); }

PointMap map_of(double (*height)(double, double), Index n, double half_side) {
  PointMap map;
  map.spacing_x = map.spacing_y = 2 * half_side / static_cast<double>(n - 1);
  map.height = Field::NullaryExpr(n, n, [&](Index j, Index i) {
    return height(-half_side + static_cast<double>(i) * map.spacing_x,
                  -half_side + static_cast<double>(j) * map.spacing_y);
  });
  return map;
}

/// A ball whose dry contact has the radius 1 m: coordinates in half axes.
PointProblem unit_contact(Index nodes) {
  PointProblem problem;
  problem.radius_x = problem.radius_y = 100;
  problem.effective_modulus = 75;
  problem.load = 1;
  problem.nodes_x = problem.nodes_y = nodes;
  problem.inlet = problem.outlet = problem.half_width = 1;
  return problem;
}

TEST(PointMap, ReproducesParabolasBetweenItsPoints) {
  const PointProblem problem = unit_contact(17);
  const Field heights = point_map(problem, map_of(parabolas, 41, 5));
  const Eigen::ArrayXd x = point_x(problem);
  for (Index j = 0; j < 17; ++j) {
    for (Index i = 0; i < 17; ++i) {
      EXPECT_NEAR(heights(j, i), parabolas(x[i], x[j]), 1e-12);
    }
  }
}

TEST(PointMap, GoesToZeroAtItsBorder) {
  PointProblem problem = unit_contact(65);
  problem.inlet = problem.outlet = problem.half_width = 2;
  const Field heights = point_map(problem, map_of([](double, double) { return 1.0; }, 51, 1.5));
  const Eigen::ArrayXd x = point_x(problem);
  for (Index i = 0; i < x.size(); ++i) {
    const double r = std::abs(x[i]);
    const double height = heights(32, i);
    EXPECT_TRUE(height > -1e-15 && height < 1 + 1e-12);
    if (r < 0.8 * 1.5) {
      EXPECT_NEAR(height, 1, 1e-12) << r;
    } else if (r > 1.5) {
      EXPECT_EQ(height, 0) << r;
    }
  }
}

TEST(PointMap, CanLieBesideTheMiddle) {
  const PointProblem problem = unit_contact(17);
  PointMap map = map_of(parabolas, 41, 5);
  map.centre_x = 0.3;
  map.centre_y = -0.2;
  const Eigen::ArrayXd x = point_x(problem);
  const Field heights = point_map(problem, map);
  EXPECT_NEAR(heights(3, 5), parabolas(x[5] - 0.3, x[3] + 0.2), 1e-12);
}

TEST(PointMap, FinerThanTheNodesIsAveraged) {
  const PointProblem problem = unit_contact(17);
  // A checkerboard at the spacing of the points has no mean over a cell of many points.
  PointMap map = map_of([](double, double) { return 1.0; }, 1601, 2);
  for (Index j = 0; j < 1601; ++j) {
    for (Index i = 0; i < 1601; ++i) map.height(j, i) = (i + j) % 2 == 0 ? 1 : -1;
  }
  EXPECT_LT(point_map(problem, map).abs().maxCoeff(), 2e-3);
}

TEST(PointMap, RejectsMapsThatDoNotReachBeyondTheContact) {
  const PointProblem problem = unit_contact(17);
  EXPECT_THAT(rejection([&] { point_map(problem, map_of(parabolas, 41, 1.2)); }),
              HasSubstr("1.25 times the half axis"));
  PointMap map = map_of(parabolas, 41, 1.3);
  map.centre_y = 0.1;
  EXPECT_THAT(rejection([&] { point_map(problem, map); }), HasSubstr("across the flow"));
}

TEST(PointMap, RejectsHoles) {
  PointMap map = map_of(parabolas, 41, 2);
  map.height(3, 4) = NAN;
  EXPECT_THAT(rejection([&] { point_map(unit_contact(17), map); }), HasSubstr("holes"));
}

TEST(PointBump, IsHighestInItsCentreAndHasARing) {
  const PointProblem problem = redlich_dry(129);
  const double side = point_x(problem)[1] - point_x(problem)[0];
  const Field heights = point_bump(problem, 0.5e-6, 16 * side);
  EXPECT_DOUBLE_EQ(heights(64, 64), 0.5e-6);
  EXPECT_DOUBLE_EQ(heights.maxCoeff(), 0.5e-6);
  // Half a wavelength from the top: -10^(-10/4) of the height.
  EXPECT_NEAR(heights(64, 72), -0.5e-6 * std::pow(10, -2.5), 1e-15);
  EXPECT_NEAR(heights(72, 64), heights(64, 72), 1e-15);
}

TEST(PointBump, RejectsAGridTooCoarseForIt) {
  EXPECT_THAT(rejection([] { point_bump(redlich_dry(65), 0.5e-6, 10e-6); }),
              HasSubstr("give more nodes"));
}

TEST(SolvePointDry, IsHertzForSmoothBodies) {
  PointProblem problem = redlich_dry(129);
  problem.plastic_pressure = kNoPlasticLimit;
  const PointResult result = solve_point_dry(problem);
  const reference::HertzEllipse hertz = hertz_of(problem);
  EXPECT_TRUE(result.convergence.converged());
  expect_within("EHL", "dry point contact, 129 nodes", "approach, relative", "Hertz 1882",
                std::abs(-result.separation / hertz.approach - 1), 1e-4);
  expect_within("EHL", "dry point contact, 129 nodes", "largest pressure, relative", "Hertz 1882",
                std::abs(result.contact_pressure.maxCoeff() / hertz.max_pressure - 1), 1e-4);
  EXPECT_NEAR(measure_point(problem, result).solid_contact_fraction, 1, 0.01);
}

TEST(SolvePointDry, IsHertzForAnEllipse) {
  PointProblem problem = redlich_dry(129);
  problem.plastic_pressure = kNoPlasticLimit;
  problem.radius_y = 4 * problem.radius_x;
  const PointResult result = solve_point_dry(problem);
  const reference::HertzEllipse hertz = hertz_of(problem);
  expect_within("EHL", "dry elliptic contact, 129 nodes", "largest pressure, relative",
                "Hertz 1882", std::abs(result.contact_pressure.maxCoeff() / hertz.max_pressure - 1),
                1e-4);
}

/// Independent heights at the nodes.
Field white_roughness(const PointProblem& problem, double rms) {
  const CounterRandom random(3);
  return Field::NullaryExpr(problem.nodes_y, problem.nodes_x, [&](Index j, Index i) {
    return rms * random.normal(static_cast<std::uint64_t>(j * problem.nodes_x + i));
  });
}

TEST(SolvePointDry, KeepsTheConditionsOfContact) {
  PointProblem problem = redlich_dry(97);
  problem.roughness = white_roughness(problem, 0.1 * kMicro);
  const PointResult result = solve_point_dry(problem);
  EXPECT_TRUE(result.convergence.converged());
  EXPECT_LE(result.load_error, 1e-9);
  EXPECT_GE(result.film.minCoeff(), 0);
  EXPECT_GE(result.contact_pressure.minCoeff(), 0);
  EXPECT_LE(result.contact_pressure.maxCoeff(), problem.plastic_pressure);
  EXPECT_EQ((result.film * result.contact_pressure).maxCoeff(), 0);
  EXPECT_EQ(
      ((problem.plastic_pressure - result.contact_pressure) * result.plastic_depth).maxCoeff(), 0);
  EXPECT_GT(result.plastic_depth.maxCoeff(), 0);
  EXPECT_EQ(result.pressure.abs().maxCoeff(), 0);
}

TEST(SolvePointDry, BumpReachesPressuresThatTheCapTakesAsDepth) {
  PointProblem problem = redlich_dry(145);
  problem.plastic_pressure = kNoPlasticLimit;
  problem.roughness = point_bump(problem, 0.5 * kMicro, 10 * kMicro);
  const PointResult elastic = solve_point_dry(problem);
  EXPECT_GT(elastic.contact_pressure.maxCoeff(), 20e9);
  EXPECT_EQ(elastic.plastic_depth.size(), 0);
  problem.plastic_pressure = 4e9;
  const PointResult plastic = solve_point_dry(problem);
  EXPECT_EQ(plastic.contact_pressure.maxCoeff(), 4e9);
  EXPECT_GT(plastic.plastic_depth.maxCoeff(), 0.4 * kMicro);
  EXPECT_LT(plastic.plastic_depth.maxCoeff(), 0.5 * kMicro);
}

TEST(SolvePointDry, WarningsAContactThatReachesTheBorder) {
  PointProblem problem = redlich_dry(65);
  problem.inlet = problem.outlet = problem.half_width = 1;
  problem.plastic_pressure = 2.2e9;  // widens the contact
  EXPECT_THAT(texts_of(solve_point_dry(problem).warnings), testing::Contains(HasSubstr("border")));
}

TEST(SolvePointDry, RejectsInputThatMakesNoSense) {
  PointProblem problem = redlich_dry(65);
  problem.load = -1;
  EXPECT_THAT(rejection([&] { solve_point_dry(problem); }), HasSubstr("load"));
}

/// A film and a pressure that are the same everywhere.
PointResult uniform(const PointProblem& problem, double film, double pressure) {
  PointResult result;
  result.grid = point_grid(problem);
  result.film = Field::Constant(problem.nodes_y, problem.nodes_x, film);
  result.pressure = Field::Constant(problem.nodes_y, problem.nodes_x, pressure);
  return result;
}

TEST(MeasurePoint, KnowsUniformFilms) {
  const PointProblem problem = redlich_case(1, 65);
  const PointResult result = uniform(problem, 2e-7, 1e9);
  const PointMeasures measures = measure_point(problem, result);
  EXPECT_NEAR(measures.hertz_radius, 54.45e-6, 0.05e-6);
  EXPECT_NEAR(measures.hertz_pressure, 2.667e9, 3e6);
  EXPECT_NEAR(measures.central_film, 2e-7, 1e-20);
  EXPECT_NEAR(measures.mean_central_film, 2e-7, 1e-20);
  EXPECT_NEAR(measures.film_at_centre, 2e-7, 1e-20);
  EXPECT_EQ(measures.max_pressure, 1e9);
  EXPECT_EQ(measures.contact_load_share, 0);
  EXPECT_EQ(measures.solid_contact_fraction, 0);
  EXPECT_EQ(measures.friction_solid, 0);
  const double hertz_circle = std::numbers::pi * measures.hertz_radius * measures.hertz_radius;
  EXPECT_NEAR(measures.fluid_volume / (2e-7 * hertz_circle), 1, 0.02);
  // Ree and Eyring: tau_E asinh(eta u_s / (h tau_E)), at every node.
  const double viscosity = material::viscosity_at(problem.lubricant.viscosity, 1e9).value;
  const double stress = 6.8e6 * std::asinh(viscosity * 1 / (2e-7 * 6.8e6));
  EXPECT_NEAR(measures.max_shear_stress, stress, 1e-9 * stress);
  EXPECT_NEAR(measures.friction_fluid, stress * result.grid.area() / problem.load,
              1e-9 * measures.friction_fluid);
  EXPECT_EQ(measures.friction_coefficient, measures.friction_fluid);
}

TEST(MeasurePoint, TheCentralFilmOfRoughBodiesIsAMean) {
  PointProblem problem = redlich_case(1, 65);
  PointResult result = uniform(problem, 2e-7, 1e9);
  Index column = 0;
  point_x(problem).abs().minCoeff(&column);
  result.film(32, column) = 1e-6;
  const PointMeasures smooth = measure_point(problem, result);
  EXPECT_EQ(smooth.central_film, 1e-6);
  EXPECT_EQ(smooth.film_at_centre, 1e-6);
  problem.roughness = Field::Zero(65, 65);
  const PointMeasures rough = measure_point(problem, result);
  EXPECT_EQ(rough.central_film, rough.mean_central_film);
  EXPECT_GT(rough.central_film, 2e-7);
  EXPECT_LT(rough.central_film, 5e-7);
}

TEST(MeasurePoint, SharesLoadAndFrictionWithSolids) {
  const PointProblem problem = redlich_case(1, 65);
  PointResult result = uniform(problem, 2e-7, 1e9);
  result.contact_pressure = Field::Zero(65, 65);
  result.plastic_depth = Field::Zero(65, 65);
  const double fluid = measure_point(problem, result).friction_fluid;
  for (Index i = 42; i < 52; ++i) {  // ten nodes in the contact
    result.film(32, i) = 0;
    result.pressure(32, i) = 0;
    result.contact_pressure(32, i) = 4e9;
    result.plastic_depth(32, i) = static_cast<double>(i) * 1e-9;
  }
  const PointMeasures measures = measure_point(problem, result);
  const double area = 10 * result.grid.pixel_area();
  EXPECT_NEAR(measures.contact_load_share, 4e9 * area / problem.load, 1e-12);
  EXPECT_NEAR(measures.friction_solid, 4e9 / 6 * area / problem.load, 1e-12);
  EXPECT_NEAR(measures.friction_fluid, fluid * (1 - 10.0 / (65 * 65)), 1e-12);
  EXPECT_EQ(measures.max_pressure, 4e9);
  EXPECT_EQ(measures.max_plastic_depth, 51e-9);
  EXPECT_EQ(measures.min_film, 0);
  const double share = 10.0 / static_cast<double>(hertz_area(problem).count());
  EXPECT_NEAR(measures.solid_contact_fraction, share, 1e-12);
  EXPECT_NEAR(measures.plastic_fraction, share, 1e-12);
}

/// Friction of Hertz' pressure on a film [m] that is the same everywhere, by rings.
double friction_by_rings(const PointProblem& problem, double film) {
  const reference::HertzEllipse hertz = hertz_of(problem);
  constexpr int n = 2000;
  double force = 0;
  for (int k = 0; k < n; ++k) {
    const double r = (k + 0.5) / n * hertz.half_axis_x;
    const double pressure = hertz.max_pressure * std::sqrt(1 - std::pow((k + 0.5) / n, 2));
    const double viscosity = material::viscosity_at(problem.lubricant.viscosity, pressure).value;
    const double stress = 6.8e6 * std::asinh(viscosity * problem.sliding_speed / (film * 6.8e6));
    force += stress * 2 * std::numbers::pi * r * hertz.half_axis_x / n;
  }
  return force / problem.load;
}

TEST(MeasurePoint, FindsTheFrictionOfASmoothFilm) {
  for (const double speed : {0.1, 1.0, 10.0}) {
    const PointProblem problem = redlich_case(speed, 193);
    const double film = film_groups_of(problem).hamrock_dowson_central();
    PointResult result = uniform(problem, film, 0);
    const reference::HertzEllipse hertz = hertz_of(problem);
    const Eigen::ArrayXd x = point_x(problem);
    const Eigen::ArrayXd y = point_y(problem);
    result.pressure = Field::NullaryExpr(
        193, 193, [&](Index j, Index i) { return reference::hertz_pressure(hertz, x[i], y[j]); });
    const double expected = friction_by_rings(problem, film);
    expect_within("EHL", fmt::format("point contact, smooth, {} m/s", speed),
                  "friction of Hertz' pressure on Hamrock and Dowson's film, relative",
                  "Ree-Eyring stress integrated over rings",
                  std::abs(measure_point(problem, result).friction_fluid / expected - 1), 5e-3);
  }
}

TEST(SlicePlane, IsTheDistributionOfTheFilm) {
  const PointProblem problem = redlich_case(1, 65);
  PointResult result = uniform(problem, 0, 1e9);
  const Mask hertz = hertz_area(problem);
  double film = 0;
  for (Index k = 0; k < hertz.size(); ++k) {
    result.film.data()[k] = hertz.data()[k] ? film++ : 1e9;  // 0, 1, 2, ... in the contact
  }
  const std::vector<double> shares = slice_plane(problem, result, {-1, 0, film / 2, film});
  EXPECT_EQ(shares[0], 0);
  EXPECT_DOUBLE_EQ(shares[1], 1 / film);
  EXPECT_NEAR(shares[2], 0.5, 1 / film);
  EXPECT_EQ(shares[3], 1);
}

}  // namespace
}  // namespace tabor::ehl
