#include "tabor/elastic/line.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/validation.hpp"
#include "support/worst.hpp"
#include "tabor/core/error.hpp"
#include "tabor/reference/hertz_line.hpp"

namespace tabor::elastic {
namespace {

using std::numbers::pi;

constexpr double kModulus = 1.2e9;
constexpr auto kShapes = {PressureShape::uniform, PressureShape::linear};

const char* name_of(PressureShape shape) {
  return shape == PressureShape::uniform ? "uniform" : "linear";
}

std::vector<double> applied(const LineHalfSpace& line, const Eigen::VectorXd& pressure) {
  std::vector<double> result(static_cast<std::size_t>(line.size()));
  line.apply({pressure.data(), result.size()}, result);
  return result;
}

Eigen::Map<const Eigen::VectorXd> vector(const std::vector<double>& values) {
  return {values.data(), static_cast<Index>(values.size())};
}

double place(const LineHalfSpace& line, Index i) {
  return line.spacing() * (static_cast<double>(i) - 0.5 * static_cast<double>(line.size() - 1));
}

/// Largest error of the displacement under Hertz' pressure with n spacings in the half width,
/// wherever its edge falls between two nodes, relative to p0 b / E*.
double worst_hertz_error(Index n, PressureShape shape) {
  const reference::HertzLineContact hertz = reference::hertz_line_at_load(2.5e-3, kModulus, 5000);
  double worst = 0;
  for (const double shift : {0.0, 0.25, 0.5, 0.75}) {
    const LineHalfSpace line(6 * n + 1, hertz.half_width / (static_cast<double>(n) + shift),
                             kModulus, shape);
    Eigen::VectorXd pressure(line.size());
    for (Index i = 0; i < line.size(); ++i) pressure[i] = hertz.pressure(place(line, i));
    const auto u = applied(line, pressure);
    for (Index i = 0; i < line.size(); ++i) {
      const double expected = hertz.displacement(place(line, i), line.datum());
      worst = test::worse(worst, std::abs(u[static_cast<std::size_t>(i)] - expected));
    }
  }
  return worst / (hertz.max_pressure * hertz.half_width / kModulus);
}

TEST(LineHalfSpace, FindsHertzAndConvergesWithTheGrid) {
  for (const PressureShape shape : kShapes) {
    const double coarse = worst_hertz_error(100, shape);
    test::expect_within(
        "Elastic operator",
        fmt::format("line, {} pressure, 100 nodes in half the contact", name_of(shape)),
        "displacement under Hertz' pressure, relative to p0 b / E*", "Hertz 1882", coarse, 2e-3);
    // The square-root edge of the pressure limits the order to 3/2, less a logarithm.
    EXPECT_GT(std::log2(coarse / worst_hertz_error(800, shape)) / 3, 1.3) << name_of(shape);
  }
}

TEST(LineHalfSpace, IsTheIntegralOfTheLogarithm) {
  // Midpoint rule on one element, away from it and on it (there split at the singular point).
  const Index n = 64;
  const int points = 200000;
  for (const PressureShape shape : kShapes) {
    const LineHalfSpace line(n, 2e-6, kModulus, shape);
    for (const Index offset : {0, 1, 2, 3, 4, 5, 9, 40}) {
      double mean = 0;
      const double half = shape == PressureShape::uniform ? 0.5 : 1;
      for (int i = 0; i < points; ++i) {
        const double s = half * (2 * (i + 0.5) / points - 1);
        const double weight = shape == PressureShape::uniform ? 1 : 1 - std::abs(s);
        mean += weight * std::log(std::abs(static_cast<double>(offset) - s)) * 2 * half / points;
      }
      const double expected =
          -2 * 2e-6 / (pi * kModulus) * (mean - std::log(static_cast<double>(n)));
      EXPECT_NEAR(line.influence(offset) / expected, 1, 3e-6) << name_of(shape) << " " << offset;
    }
  }
}

TEST(LineHalfSpace, IsSymmetricAndStoresEnergy) {
  for (const PressureShape shape : kShapes) {
    const LineHalfSpace line(37, 1e-6, kModulus, shape);
    const Eigen::MatrixXd matrix = line.matrix();
    EXPECT_EQ((matrix - matrix.transpose()).norm(), 0);
    EXPECT_GT(matrix.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0);
  }
}

TEST(LineHalfSpace, TransformsAgreeWithTheMatrix) {
  for (const PressureShape shape : kShapes) {
    for (const Index n : {3, 8, 97, 300}) {
      const LineHalfSpace line(n, 1e-6, kModulus, shape);
      const Eigen::VectorXd pressure = 1e7 * Eigen::VectorXd::Random(n);
      const Eigen::VectorXd expected = line.matrix() * pressure;
      EXPECT_LE((vector(applied(line, pressure)) - expected).norm(), 1e-13 * expected.norm()) << n;
      std::vector<double> differences(static_cast<std::size_t>(n));
      line.apply_differential({pressure.data(), differences.size()}, differences);
      const Eigen::VectorXd expected_differences = line.differential_matrix() * pressure;
      EXPECT_LE((vector(differences) - expected_differences).norm(), 1e-13 * expected.norm()) << n;
    }
  }
}

TEST(LineHalfSpace, DifferentialFormIsThePlainFormDifferentiatedTwice) {
  for (const PressureShape shape : kShapes) {
    const Index n = 150;
    const LineHalfSpace line(n, 1e-6, kModulus, shape);
    const Eigen::MatrixXd plain = line.matrix();
    const Eigen::MatrixXd differential = line.differential_matrix();
    const Eigen::MatrixXd expected =
        plain.topRows(n - 2) - 2 * plain.middleRows(1, n - 2) + plain.bottomRows(n - 2);
    EXPECT_LE((differential.middleRows(1, n - 2) - expected).cwiseAbs().maxCoeff(),
              1e-14 * plain.cwiseAbs().maxCoeff());
    EXPECT_EQ((differential.row(0) - plain.row(0)).norm(), 0);
    EXPECT_EQ((differential.row(n - 1) - plain.row(n - 1)).norm(), 0);
  }
}

TEST(LineHalfSpace, BothFormsGiveTheSameDisplacement) {
  const Index n = 2000;
  const LineHalfSpace line(n, 1e-7, kModulus);
  const Eigen::VectorXd pressure = 1e7 * (Eigen::VectorXd::Random(n).array() + 1);
  const auto expected = applied(line, pressure);
  std::vector<double> u(expected.size());
  line.apply_differential({pressure.data(), u.size()}, u);
  displacement_from_differences(u, u);
  test::expect_within(
      "Elastic operator", "line, 2000 nodes", "differential against plain form, relative",
      "each other",
      (vector(u) - vector(expected)).cwiseAbs().maxCoeff() / vector(expected).cwiseAbs().maxCoeff(),
      1e-9);
}

TEST(LineHalfSpace, DifferentialKernelDecaysWithTheSquareOfTheDistance) {
  for (const PressureShape shape : kShapes) {
    const LineHalfSpace line(20000, 1e-7, kModulus, shape);
    const double scale = 2 * line.spacing() / (pi * kModulus);
    for (const Index k : {50, 1000, 19000}) {
      const double leading = scale / (static_cast<double>(k) * static_cast<double>(k));
      EXPECT_NEAR(line.second_difference(k) / leading, 1, 1e-3) << k;
    }
    EXPECT_LT(line.second_difference(0), 0);
  }
}

// A wave p cos(theta i) on an endless line: u_hat = 2 p_hat / (E* |q|) (Johnson 1985, eq. 13.7) for
// each of the waves theta + 2 pi m that the nodes cannot tell apart, each with the share that the
// element's shape has of it; a second difference multiplies by -4 sin^2(theta / 2).
TEST(LineHalfSpace, GivesEveryWaveItsCompliance) {
  const Index n = 20000;
  double worst = 0;
  for (const PressureShape shape : kShapes) {
    const LineHalfSpace line(n, 1e-6, kModulus, shape);
    Eigen::ArrayXd kernel(n);
    for (Index k = 0; k < n; ++k) kernel[k] = (k == 0 ? 1 : 2) * line.second_difference(k);
    const Eigen::ArrayXd offset = Eigen::ArrayXd::LinSpaced(n, 0, static_cast<double>(n - 1));
    for (const double theta : {0.05, 0.3, 1.0, 2.5}) {
      const double summed = (kernel * (theta * offset).cos()).sum();
      double compliance = 0;
      for (int m = -3000; m <= 3000; ++m) {
        const double wave = theta + 2 * pi * m;
        const double share = std::sin(0.5 * wave) / (0.5 * wave);
        compliance += 2 * line.spacing() / (kModulus * std::abs(wave)) *
                      (shape == PressureShape::uniform ? share : share * share);
      }
      const double expected = -4 * std::pow(std::sin(0.5 * theta), 2) * compliance;
      worst = test::worse(worst, std::abs(summed / expected - 1));
    }
  }
  test::expect_within("Elastic operator", "line, waves of 2.5 to 126 nodes", "compliance, relative",
                      "2 / (E* q)", worst, 1e-6);
}

TEST(LineHalfSpace, DoesNotDependOnTheUnitOfLength) {
  const Eigen::VectorXd pressure = Eigen::VectorXd::Random(50);
  const auto metres = applied(LineHalfSpace(50, 1e-6, kModulus), pressure);
  const auto micrometres = applied(LineHalfSpace(50, 1, kModulus), pressure);
  EXPECT_LE((1e6 * vector(metres) - vector(micrometres)).norm(),
            1e-13 * vector(micrometres).norm());
}

TEST(LineHalfSpace, ServesTheContactSolversAsAMapOfOneRow) {
  const Grid grid{40, 1, 40e-6, 3e-3};
  const auto elasticity = make_line(grid, kModulus);
  const Field pressure = 1e7 * Field::Random(1, 40);
  Field displacement;
  elasticity->apply(pressure, displacement);
  const auto expected =
      applied(LineHalfSpace(40, 1e-6, kModulus), pressure.row(0).transpose().matrix());
  EXPECT_LE((displacement.row(0).transpose().matrix() - vector(expected)).norm(),
            1e-14 * vector(expected).norm());
  FieldF single;
  elasticity->apply(FieldF(pressure.cast<float>()), single);
  EXPECT_LE((single.cast<double>() - displacement).abs().maxCoeff(),
            1e-6 * displacement.abs().maxCoeff());
  EXPECT_FALSE(elasticity->drops_mean());
}

TEST(LineHalfSpace, RejectsWhatMakesNoSense) {
  EXPECT_THROW(LineHalfSpace(2, 1e-6, kModulus), InputError);
  EXPECT_THROW(LineHalfSpace(10, 0, kModulus), InputError);
  EXPECT_THROW(LineHalfSpace(10, 1e-6, -1), InputError);
  EXPECT_THROW(LineHalfSpace(10, 1e-6, std::nan("")), InputError);
  EXPECT_THROW(make_line({10, 2, 1e-5, 1e-5}, kModulus), InputError);
}

}  // namespace
}  // namespace tabor::elastic
