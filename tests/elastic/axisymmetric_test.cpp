#include "tabor/elastic/axisymmetric.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/validation.hpp"
#include "support/worst.hpp"
#include "tabor/core/error.hpp"
#include "tabor/elastic/half_space.hpp"
#include "tabor/reference/hertz.hpp"

namespace tabor::elastic {
namespace {

using std::numbers::pi;

constexpr double kModulus = 55e9;
constexpr auto kShapes = {PressureShape::uniform, PressureShape::linear};
const reference::HertzContact kHertz = reference::hertz_at_load(12.7e-3, kModulus, 100);

const char* name_of(PressureShape shape) {
  return shape == PressureShape::uniform ? "uniform" : "linear";
}

Eigen::VectorXd hertz_pressure(const Eigen::ArrayXd& radii) {
  return radii.unaryExpr([](double r) { return reference::hertz_pressure(kHertz, r); }).matrix();
}

Eigen::VectorXd displaced(const AxisymmetricHalfSpace& half_space,
                          const Eigen::VectorXd& pressure) {
  Eigen::VectorXd u(pressure.size());
  const auto n = static_cast<std::size_t>(pressure.size());
  half_space.apply({pressure.data(), n}, {u.data(), n});
  return u;
}

// Johnson 1985, eqs. 3.29: centre 2 p c / E*, rim 4 p c / (pi E*); far away a point force.
TEST(DiscDisplacement, HasItsKnownValues) {
  const double c = 3e-5;
  EXPECT_NEAR(disc_displacement(0, c, kModulus) * kModulus / (2 * c), 1, 1e-15);
  EXPECT_NEAR(disc_displacement(c, c, kModulus) * kModulus / (4 * c / pi), 1, 1e-15);
  EXPECT_NEAR(disc_displacement(1e6 * c, c, kModulus) * kModulus * 1e6 / c, 1, 1e-12);
  EXPECT_EQ(disc_displacement(c, 0, kModulus), 0);
}

TEST(DiscDisplacement, IsContinuousAtTheRim) {
  const double c = 3e-5;
  const double rim = disc_displacement(c, c, kModulus);
  for (const double factor : {1 - 1e-12, 1 + 1e-12}) {
    EXPECT_NEAR(disc_displacement(c * factor, c, kModulus) / rim, 1, 1e-9);
  }
}

// In long double: in double the library's integrals lose four digits near modulus 1.
TEST(DiscDisplacement, IsThatOfTheStandardLibrarysEllipticIntegrals) {
  double worst = 0;
  for (double q = 0.001; q < 4; q += 0.0173) {
    const long double k = q < 1 ? static_cast<long double>(q) : 1 / static_cast<long double>(q);
    const long double second = std::comp_ellint_2(k);
    const long double integral =
        q < 1 ? second : (second - (1 - k * k) * std::comp_ellint_1(k)) / k;
    const double expected = 4 / pi * static_cast<double>(integral);
    worst = test::worse(worst, std::abs(disc_displacement(q, 1, 1) / expected - 1));
  }
  test::expect_within("Elastic operator", "disc of uniform pressure, r/c from 0 to 4",
                      "displacement, relative", "elliptic integrals in long double", worst, 2e-14);
}

/// Largest error of the displacement under Hertz' pressure, relative to the approach.
double hertz_error(const Eigen::ArrayXd& radii, PressureShape shape) {
  const AxisymmetricHalfSpace half_space(radii, kModulus, shape);
  const Eigen::VectorXd u = displaced(half_space, hertz_pressure(radii));
  double worst = 0;
  for (Index i = 0; i < u.size(); ++i) {
    worst = test::worse(worst, std::abs(u[i] - reference::hertz_displacement(kHertz, radii[i])));
  }
  return worst / kHertz.approach;
}

/// The same on equal spacings, n of them in the contact radius, wherever its edge falls between two
/// nodes: the error is that of the square-root edge and nearly vanishes for some places.
double worst_hertz_error(Index n, PressureShape shape) {
  double worst = 0;
  for (const double shift : {0.0, 0.25, 0.5, 0.75}) {
    const double spacing = kHertz.radius / (static_cast<double>(n) + shift);
    const Index n_nodes = 6 * n / 5;
    worst = test::worse(
        worst,
        hertz_error(uniform_radii(n_nodes, spacing * static_cast<double>(n_nodes - 1)), shape));
  }
  return worst;
}

TEST(AxisymmetricHalfSpace, FindsHertzAndConvergesWithTheGrid) {
  for (const PressureShape shape : kShapes) {
    for (const auto& [n, tolerance] : {std::pair{100, 1e-3}, {200, 4e-4}, {400, 1.6e-4}}) {
      test::expect_within(
          "Elastic operator",
          fmt::format("rings, {} pressure, {} nodes in the contact", name_of(shape), n),
          "displacement under Hertz' pressure, relative to the approach", "Hertz 1882",
          worst_hertz_error(n, shape), tolerance);
    }
    const double order =
        std::log2(worst_hertz_error(50, shape) / worst_hertz_error(200, shape)) / 2;
    EXPECT_GT(order, 1.3) << name_of(shape);  // 3/2, that of the edge, less a logarithm
  }
}

TEST(AxisymmetricHalfSpace, FindsHertzOnAGradedGrid) {
  // 165 of the nodes lie in the contact; those of an equal spacing would be 20.
  const Eigen::ArrayXd radii = graded_radii(300, 15 * kHertz.radius, 100);
  for (const PressureShape shape : kShapes) {
    EXPECT_LE(hertz_error(radii, shape), 1e-3) << name_of(shape);
  }
}

// A cone of pressure p (1 - r/c): u(0) = (2 / E*) integral p dr = p c / E*.
TEST(AxisymmetricHalfSpace, LinearShapeIsExactUnderACone) {
  const Eigen::ArrayXd radii = uniform_radii(11, 1e-4);
  const AxisymmetricHalfSpace half_space(radii, kModulus, PressureShape::linear);
  const Eigen::VectorXd pressure = 1e6 * (1 - radii / 1e-4).matrix();
  const Eigen::VectorXd u = displaced(half_space, pressure);
  EXPECT_NEAR(u[0] / (1e6 * 1e-4 / kModulus), 1, 1e-14);
  // Elsewhere: the same cone on a grid eight times finer.
  const Eigen::ArrayXd fine = uniform_radii(81, 1e-4);
  const Eigen::VectorXd u_fine =
      displaced(AxisymmetricHalfSpace(fine, kModulus, PressureShape::linear),
                1e6 * (1 - fine / 1e-4).matrix());
  for (Index i = 0; i < u.size(); ++i) {
    EXPECT_NEAR(u[i] / u_fine[8 * i], 1, 1e-7) << i;
  }
}

TEST(AxisymmetricHalfSpace, UniformShapeIsExactUnderADisc) {
  const Eigen::ArrayXd radii = graded_radii(40, 1e-4, 5);
  const AxisymmetricHalfSpace half_space(radii, kModulus);
  const Eigen::VectorXd u = displaced(half_space, Eigen::VectorXd::Ones(40));
  for (Index i = 0; i < 40; ++i) {
    EXPECT_NEAR(u[i] / disc_displacement(radii[i], 1e-4, kModulus), 1, 1e-13);
  }
}

// A pressure that is the same at all nodes ends at the last one.
TEST(AxisymmetricHalfSpace, LinearShapeIsExactUnderADisc) {
  const Eigen::ArrayXd radii = graded_radii(40, 1e-4, 5);
  const AxisymmetricHalfSpace half_space(radii, kModulus, PressureShape::linear);
  const Eigen::VectorXd u = displaced(half_space, Eigen::VectorXd::Ones(40));
  for (Index i = 0; i < 40; ++i) {
    EXPECT_NEAR(u[i] / disc_displacement(radii[i], radii[39], kModulus), 1, 1e-13);
  }
}

TEST(AxisymmetricHalfSpace, LoadOfAUniformPressureIsThatOfTheDisc) {
  for (const PressureShape shape : kShapes) {
    const AxisymmetricHalfSpace half_space(graded_radii(50, 2e-4, 8), kModulus, shape);
    EXPECT_NEAR(half_space.load_weights().sum() / (pi * 4e-8), 1, 1e-14);
    EXPECT_GT(half_space.load_weights().minCoeff(), 0);
  }
}

TEST(AxisymmetricHalfSpace, LoadOfHertzPressureIsItsLoad) {
  for (const PressureShape shape : kShapes) {
    const AxisymmetricHalfSpace half_space(uniform_radii(400, 1.5 * kHertz.radius), kModulus,
                                           shape);
    const double load =
        (half_space.load_weights() * hertz_pressure(half_space.radii()).array()).sum();
    EXPECT_NEAR(load / kHertz.load, 1, 3e-4) << name_of(shape);
  }
}

// The same pressure by Love's rectangles and a transform: nothing shared but the half-space.
TEST(AxisymmetricHalfSpace, AgreesWithTheFreeHalfSpaceOfMaps) {
  const Index n = 257;
  const double side = 3 * kHertz.radius;
  const Grid grid{n, n, side, side};
  const auto place = [&](Index i) {
    return (static_cast<double>(i) - 0.5 * static_cast<double>(n - 1)) * grid.dx();
  };
  Field pressure(n, n);
  for (Index y = 0; y < n; ++y) {
    for (Index x = 0; x < n; ++x) {
      pressure(y, x) = reference::hertz_pressure(kHertz, std::hypot(place(x), place(y)));
    }
  }
  Field map;
  make_free(grid, kModulus)->apply(pressure, map);
  const Index half = (n - 1) / 2;
  const Eigen::ArrayXd radii = uniform_radii(half + 1, place(n - 1));
  const Eigen::VectorXd u =
      displaced(AxisymmetricHalfSpace(radii, kModulus), hertz_pressure(radii));
  double worst = 0;
  for (Index i = 0; i <= half; ++i) {
    worst = test::worse(worst, std::abs(u[i] - map(half, half + i)) / kHertz.approach);
  }
  test::expect_within("Elastic operator", "rings, 129 nodes, and a map of 257 x 257",
                      "displacement under Hertz' pressure, relative to the approach", "each other",
                      worst, 1e-3);
}

TEST(AxisymmetricHalfSpace, HasThePressureOfTheInverseProblem) {
  // Well conditioned: the pressure comes back from its displacement.
  for (const PressureShape shape : kShapes) {
    const AxisymmetricHalfSpace half_space(uniform_radii(60, 1e-4), kModulus, shape);
    const Eigen::VectorXd pressure = Eigen::VectorXd::Random(60);
    const Eigen::VectorXd back =
        Eigen::MatrixXd(half_space.matrix()).partialPivLu().solve(displaced(half_space, pressure));
    EXPECT_LE((back - pressure).norm(), 1e-10 * pressure.norm()) << name_of(shape);
  }
}

TEST(RadialGrid, GrowsByTheGivenRatio) {
  const Eigen::ArrayXd radii = graded_radii(101, 2e-3, 7);
  EXPECT_EQ(radii[0], 0);
  EXPECT_EQ(radii[100], 2e-3);
  EXPECT_NEAR((radii[100] - radii[99]) / (radii[1] - radii[0]), 7, 1e-10);
  const Eigen::ArrayXd uniform = uniform_radii(5, 4.0);
  EXPECT_LE((uniform - Eigen::ArrayXd::LinSpaced(5, 0, 4)).abs().maxCoeff(), 1e-15);
}

TEST(RadialGrid, EdgesStandHalfWayBetweenNodes) {
  Eigen::ArrayXd radii(4);
  radii << 0, 1, 3, 7;
  Eigen::ArrayXd expected(5);
  expected << 0, 0.5, 2, 5, 7;
  EXPECT_EQ((ring_edges(radii) - expected).abs().maxCoeff(), 0);
}

TEST(AxisymmetricHalfSpace, RejectsWhatMakesNoSense) {
  const Eigen::ArrayXd good = uniform_radii(5, 1);
  EXPECT_THROW(AxisymmetricHalfSpace(good, 0), InputError);
  EXPECT_THROW(AxisymmetricHalfSpace(good, std::nan("")), InputError);
  EXPECT_THROW(AxisymmetricHalfSpace(good.head(2), kModulus), InputError);
  EXPECT_THROW(AxisymmetricHalfSpace(good + 0.1, kModulus), InputError);
  EXPECT_THROW(AxisymmetricHalfSpace(good.reverse(), kModulus), InputError);
  Eigen::ArrayXd hole = good;
  hole[2] = std::nan("");
  EXPECT_THROW(AxisymmetricHalfSpace(hole, kModulus), InputError);
  EXPECT_THROW(graded_radii(2, 1, 1), InputError);
  EXPECT_THROW(graded_radii(10, -1, 1), InputError);
  EXPECT_THROW(graded_radii(10, 1, 0), InputError);
}

}  // namespace
}  // namespace tabor::elastic
