// Spectral moments by differences, and what random-surface theory makes of them.
#include <gtest/gtest.h>

#include <cmath>

#include "support/sample_surfaces.hpp"
#include "values.hpp"

namespace tabor::metrology::test {

using namespace tabor::test;
namespace {

double moment(const topography::Topography& topography, const char* symbol) {
  return value(topography, ParameterSet::spectral, symbol);
}

constexpr double kAmplitude = 2e-6, kLength = 1e-4;
constexpr int kWaves = 5;
const double q = 2 * pi * kWaves / kLength;

/// sin(x)/x of half a pixel's phase: what a difference makes of a slope.
double attenuation(Index n) {
  const double half = pi * kWaves / static_cast<double>(n);
  return std::sin(half) / half;
}

TEST(SpectralMoments, OfAWaveAreItsClosedForms) {
  const Index n = 4000;
  const auto wave =
      surface({n, 8, kLength, 1e-6}, [](double x, double) { return kAmplitude * std::sin(q * x); });
  const double square = kAmplitude * kAmplitude / 2, damping = attenuation(n);
  // The open ends leave out one or two of 4000 differences.
  EXPECT_NEAR(moment(wave, "m0") / square, 1, 1e-12);
  EXPECT_NEAR(moment(wave, "m2_x") / (square * std::pow(q * damping, 2)), 1, 1.1 / n);
  EXPECT_NEAR(moment(wave, "m4_x") / (square * std::pow(q * damping, 4)), 1, 2.2 / n);
  EXPECT_EQ(moment(wave, "m2_y"), 0);
  EXPECT_EQ(moment(wave, "m4_y"), 0);
  EXPECT_NEAR(moment(wave, "m2") / (moment(wave, "m2_x") / 2), 1, 1e-14);
  EXPECT_NEAR(moment(wave, "m4") / (3.0 / 8 * moment(wave, "m4_x")), 1, 1e-12);
}

/// a (cos qx + cos qy)
topography::Topography egg_box(Index n) {
  return surface({n, n, kLength, kLength}, [](double x, double y) {
    return kAmplitude * (std::cos(q * x) + std::cos(q * y));
  });
}

TEST(SpectralMoments, OfAnEggBoxAreItsClosedForms) {
  const auto box = egg_box(500);
  const double square = kAmplitude * kAmplitude, d = attenuation(500);
  EXPECT_NEAR(moment(box, "m0") / square, 1, 1e-12);
  EXPECT_NEAR(moment(box, "m2") / (square * std::pow(q * d, 2) / 2), 1, 4e-3);
  EXPECT_NEAR(moment(box, "m4") / (3.0 / 8 * square * std::pow(q * d, 4)), 1, 8e-3);
  // alpha = a^2 (3/8) a^2 q^4 / (a^2 q^2 / 2)^2
  EXPECT_NEAR(moment(box, "alpha"), 1.5, 0.02);
  EXPECT_NEAR(moment(box, "D_sum") / (0.75 * q * q / (6 * pi * std::numbers::sqrt3)), 1, 0.02);
}

TEST(SpectralMoments, OfAPeriodicEggBoxAreExactByItsSpectrum) {
  auto box = egg_box(60);
  box.periodic = true;
  const double square = kAmplitude * kAmplitude;
  const auto error = [&](const char* symbol, double exact) {
    return std::abs(moment(box, symbol) / exact - 1);
  };
  EXPECT_LT(error("m0_psd", square), 1e-12);
  EXPECT_LT(error("m2_x_psd", square / 2 * q * q), 1e-12);
  EXPECT_LT(error("m2_psd", square / 2 * q * q), 1e-12);
  EXPECT_LT(error("m4_y_psd", square / 2 * std::pow(q, 4)), 1e-12);
  EXPECT_LT(error("m4_psd", 3.0 / 8 * square * std::pow(q, 4)), 1e-12);
  EXPECT_LT(error("alpha_psd", 1.5), 1e-12);
}

/// The window keeps the variance only on average: a wave of many periods is nearly unchanged.
TEST(SpectralMoments, OfAWindowedWaveAreNearItsClosedForms) {
  const auto wave = surface({512, 40, kLength, 1e-5}, [](double x, double) {
    return kAmplitude * std::sin(8 * q * x + 0.3);
  });
  const double square = kAmplitude * kAmplitude / 2;
  EXPECT_NEAR(moment(wave, "m0_psd") / square, 1, 1e-3);
  EXPECT_NEAR(moment(wave, "m2_x_psd") / (square * 64 * q * q), 1, 5e-3);
}

TEST(SpectralMoments, BySpectrumNeedFilledHoles) {
  auto box = egg_box(60);
  box.height(7, 8) = kHole;
  const Parameter m2 = parameter(box, ParameterSet::spectral, "m2_psd");
  EXPECT_TRUE(std::isnan(m2.value));
  EXPECT_EQ(m2.note, "needs a surface without holes");
}

TEST(SpectralMoments, GiveSummitsOfTheGreenwoodWilliamsonModel) {
  const auto box = egg_box(500);
  const double m4 = moment(box, "m4"), alpha = moment(box, "alpha");
  EXPECT_NEAR(moment(box, "R_sum") * std::sqrt(m4), 3.0 / 8 * std::sqrt(pi), 1e-12);
  EXPECT_NEAR(std::pow(moment(box, "sigma_sum"), 2) / moment(box, "m0"), 1 - 0.8968 / alpha, 1e-12);
}

TEST(SpectralMoments, SkipDifferencesThatTouchAHole) {
  auto box = egg_box(200);
  const double m4 = moment(box, "m4_x");
  punch_holes(box, 0.05);
  EXPECT_NEAR(moment(box, "m4_x") / m4, 1, 0.03);
}

TEST(SpectralMoments, OfAPlaneHaveNoSummits) {
  const auto plane = surface({9, 9, 9, 9}, [](double x, double y) { return 2 * x + y; });
  EXPECT_NEAR(moment(plane, "m2_x"), 4, 1e-12);
  EXPECT_NEAR(moment(plane, "m2_y"), 1, 1e-12);
  const auto flat = surface({9, 9, 9, 9}, [](double, double) { return 1.0; });
  EXPECT_TRUE(std::isnan(moment(flat, "alpha")));
  EXPECT_NE(parameter(flat, ParameterSet::spectral, "alpha").note, "");
}

}  // namespace
}  // namespace tabor::metrology::test
