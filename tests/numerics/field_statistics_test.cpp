#include "tabor/numerics/field_statistics.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "numerics/matrices.hpp"
#include "support/worst.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/parallel.hpp"

namespace tabor::numerics {
namespace {

constexpr double kHole = std::numeric_limits<double>::quiet_NaN();

Field with_holes(Field field) {
  for (Index i = 2; i < field.size(); i += 7) field.data()[i] = kHole;
  return field;
}

/// The definition, value by value, in long double.
double central_moment(const Field& field, int power) {
  long double mean = 0, sum = 0;
  Index n = 0;
  for (const double z : field.reshaped<Eigen::RowMajor>()) {
    if (std::isnan(z)) continue;
    mean += z;
    ++n;
  }
  mean /= static_cast<long double>(n);
  for (const double z : field.reshaped<Eigen::RowMajor>()) {
    if (!std::isnan(z)) sum += std::pow(static_cast<long double>(z) - mean, power);
  }
  return static_cast<double>(sum / static_cast<long double>(n));
}

TEST(FieldMoments, AreThoseOfTheValidValues) {
  const Field field = with_holes(test::scattered_field(23, 37));
  const FieldMoments moments = field_moments(field);
  EXPECT_EQ(moments.n, field.size() - field.isNaN().count());
  EXPECT_NEAR(moments.second, central_moment(field, 2), 1e-14);
  EXPECT_NEAR(moments.third, central_moment(field, 3), 1e-14);
  EXPECT_NEAR(moments.fourth, central_moment(field, 4), 1e-14);
  EXPECT_NEAR(moments.highest + moments.mean, field.maxCoeff<Eigen::PropagateNumbers>(), 1e-14);
  EXPECT_NEAR(moments.lowest + moments.mean, field.minCoeff<Eigen::PropagateNumbers>(), 1e-14);
}

TEST(FieldMoments, FarFromZeroLoseNothing) {
  const Field field = 1e-9 * test::scattered_field(40, 50);
  const Field far = field + 1.0;
  EXPECT_NEAR(rms_height(far) / rms_height(field), 1, 1e-6);
}

TEST(FieldMoments, OfAConstantAreZero) {
  const FieldMoments moments = field_moments(Field::Constant(7, 11, 0.1));
  EXPECT_EQ(moments.mean, 0.1);
  EXPECT_EQ(moments.second, 0);
  EXPECT_EQ(moments.fourth, 0);
  EXPECT_EQ(moments.highest, 0);
}

TEST(Rounding, IsNoHeight) {
  Field field = Field::Constant(7, 11, 3.1e-6);
  field(2, 3) *= 1 + 4e-16;
  field(4, 4) = kHole;
  EXPECT_TRUE(is_flat(field));
  EXPECT_EQ(field_moments(field).second, 0);
  EXPECT_EQ(largest_magnitude(without_rounding(field - 3.1e-6, 3.1e-6)), 0);
  EXPECT_TRUE(std::isnan(without_rounding(field - 3.1e-6, 3.1e-6)(4, 4)));
  field(2, 3) = 3.1e-6 + 1e-15;  // a nanometre's millionth, far above it
  EXPECT_FALSE(is_flat(field));
  EXPECT_GT(largest_magnitude(without_rounding(field - 3.1e-6, 3.1e-6)), 0);
}

TEST(FieldMoments, OfHolesOnlyAreAnError) {
  EXPECT_THROW(field_moments(Field::Constant(2, 3, kHole)), InputError);
  EXPECT_THROW(rms_height(Field(0, 0)), InputError);
}

TEST(FieldMoments, HaveTheSameBitsForAnyNumberOfThreads) {
  const Field field = with_holes(test::scattered_field(200, 100));
  std::vector<double> found;
  for (const int n : {1, 3}) {
    set_thread_count(n);
    found.push_back(field_moments(field).fourth);
    found.push_back(rms_slope(field, {100, 200, 1, 1}));
  }
  set_thread_count(0);
  EXPECT_EQ(found[0], found[2]);
  EXPECT_EQ(found[1], found[3]);
}

TEST(RmsHeight, OfAWaveIsItsAmplitudeOverRootTwo) {
  const Field wave = Field::NullaryExpr(8, 64, [](Index, Index x) {
    return 3e-6 * std::sin(2 * std::numbers::pi * static_cast<double>(x) / 64);
  });
  EXPECT_NEAR(rms_height(wave), 3e-6 / std::numbers::sqrt2, 1e-18);
}

constexpr Grid kGrid{.nx = 31, .ny = 23, .lx = 62, .ly = 11.5};  // pixels of 2 x 0.5

/// z = x^3 + 2 y^3 at the pixels.
Field cubic() {
  return Field::NullaryExpr(kGrid.ny, kGrid.nx, [](Index y, Index x) {
    return std::pow(kGrid.dx() * static_cast<double>(x), 3) +
           2 * std::pow(kGrid.dy() * static_cast<double>(y), 3);
  });
}

/// Mean of slope(y, x) over a box of pixels.
template <typename Slope>
double rms_of(Index first, Index last_y, Index last_x, const Slope& slope) {
  double sum = 0;
  Index n = 0;
  for (Index y = first; y < last_y; ++y) {
    for (Index x = first; x < last_x; ++x, ++n) sum += slope(y, x);
  }
  return std::sqrt(sum / static_cast<double>(n));
}

TEST(RmsSlope, WithForwardDifferencesIsTheirRootMeanSquare) {
  const Field z = cubic();
  const double expected = rms_of(0, kGrid.ny - 1, kGrid.nx - 1, [&](Index y, Index x) {
    return std::pow((z(y, x + 1) - z(y, x)) / 2, 2) + std::pow((z(y + 1, x) - z(y, x)) / 0.5, 2);
  });
  EXPECT_NEAR(rms_slope(z, kGrid) / expected, 1, 1e-14);
}

TEST(RmsSlope, WithSevenPointsIsExactForACubic) {
  const double expected = rms_of(3, kGrid.ny - 3, kGrid.nx - 3, [&](Index y, Index x) {
    const double by_x = 3 * std::pow(2 * static_cast<double>(x), 2);
    const double by_y = 6 * std::pow(0.5 * static_cast<double>(y), 2);
    return by_x * by_x + by_y * by_y;
  });
  EXPECT_NEAR(seven_point_rms_slope(cubic(), kGrid) / expected, 1, 1e-12);
}

TEST(RmsSlope, LeavesOutWhatTouchesAHole) {
  Field plane = Field::NullaryExpr(9, 9, [](Index y, Index x) {
    return 3 * static_cast<double>(x) + 4 * static_cast<double>(y);
  });
  plane(4, 4) = 1e9;
  const Grid grid{9, 9, 9, 9};
  EXPECT_GT(rms_slope(plane, grid), 1e6);
  plane(4, 4) = kHole;
  EXPECT_NEAR(rms_slope(plane, grid), 5, 1e-13);
  EXPECT_NEAR(seven_point_rms_slope(plane, grid), 5, 1e-13);
}

TEST(RmsSlope, DoesNotExistWithoutPixelsForItsStencil) {
  EXPECT_TRUE(std::isnan(rms_slope(Field::Zero(1, 9), {9, 1, 9, 1})));
  EXPECT_TRUE(std::isnan(seven_point_rms_slope(Field::Zero(9, 6), {6, 9, 6, 9})));
  EXPECT_TRUE(std::isnan(rms_slope(Eigen::ArrayXd(Eigen::ArrayXd::Zero(1)), 1.0)));
  EXPECT_TRUE(std::isnan(seven_point_rms_slope(Eigen::ArrayXd(Eigen::ArrayXd::Zero(6)), 1.0)));
}

TEST(RmsSlope, OfALineIsThatOfTheRidgesItMakes) {
  Eigen::ArrayXd line = test::scattered_vector(50).array();
  const Field ridges = line.transpose().replicate(9, 1);
  const Grid grid{50, 9, 50 * 0.3, 9};
  EXPECT_NEAR(rms_slope(line, 0.3) / rms_slope(ridges, grid), 1, 1e-13);
  EXPECT_NEAR(seven_point_rms_slope(line, 0.3) / seven_point_rms_slope(ridges, grid), 1, 1e-13);
  line[20] = kHole;
  EXPECT_FALSE(std::isnan(rms_slope(line, 0.3)));
}

TEST(MeanSquareSlopes, CountAllPairsAlongEachAxis) {
  Field z = Field::Zero(2, 3);
  z(0, 1) = 6;  // steps of 6, -6, 0, 0 along x and -6 of three along y
  const SquareSlopes slopes = mean_square_slopes(z, {3, 2, 6, 1});
  EXPECT_NEAR(slopes.along_x, 2 * 9 / 4.0, 1e-14);
  EXPECT_NEAR(slopes.along_y, 144 / 3.0, 1e-13);
  EXPECT_TRUE(std::isnan(mean_square_slopes(z.topRows(1), {3, 1, 6, 1}).along_y));
}

}  // namespace
}  // namespace tabor::numerics
