// Means over several surfaces: spectra on a common axis, and parameters.
#include <gmock/gmock.h>

#include <cmath>

#include "tabor/core/error.hpp"
#include "tabor/core/glob.hpp"
#include "tabor/metrology/areal/parameter_means.hpp"
#include "tabor/metrology/spectra/mean_spectrum.hpp"

namespace tabor::metrology {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// C = factor q^slope at these wavevectors.
Spectrum power_law(double factor, double slope, const std::vector<double>& q) {
  Spectrum spectrum{.q = q, .density = {}, .unit = "m^3", .hurst = {}};
  for (const double one : q) spectrum.density.push_back(factor * std::pow(one, slope));
  return spectrum;
}

std::vector<double> multiples_of(double q, std::size_t n) {
  std::vector<double> all;
  for (std::size_t i = 1; i <= n; ++i) all.push_back(static_cast<double>(i) * q);
  return all;
}

TEST(MeanSpectrum, OfOneAxisIsTheMeanAtEachWavevector) {
  const std::vector<double> q = multiples_of(2, 50);
  const MeanSpectrum mean = mean_spectrum({power_law(1, -2, q), power_law(3, -2, q)});
  EXPECT_EQ(mean.q, q);
  EXPECT_EQ(mean.unit, "m^3");
  for (std::size_t i = 0; i < q.size(); ++i) {
    const double one = std::pow(q[i], -2);
    EXPECT_NEAR(mean.density[i].mean, 2 * one, 1e-15 * one);
    EXPECT_NEAR(mean.density[i].standard_deviation, std::sqrt(2.0) * one, 1e-14 * one);
    EXPECT_EQ(mean.density[i].n, 2u);
  }
}

TEST(MeanSpectrum, KeepsTheMeanOfTheMeanSquares) {
  constexpr Index n = 32;
  std::vector<Spectrum> spectra;
  double mean_square = 0;
  for (const double amplitude : {1e-6, 2e-6, 4e-6}) {
    topography::Topography wave;
    wave.grid = {.nx = n, .ny = 2, .lx = 1e-3, .ly = 1e-3};
    wave.periodic = true;
    wave.height = Field(2, n);
    for (Index x = 0; x < n; ++x) {
      wave.height.col(x) = amplitude * std::sin(6 * kPi * static_cast<double>(x) / n);
    }
    spectra.push_back(power_spectra(wave).x);
    mean_square += amplitude * amplitude / 2 / 3;
  }
  const MeanSpectrum mean = mean_spectrum(spectra);
  double integral = 0;  // (1/pi) int C1D dq
  for (const Mean& one : mean.density) integral += one.mean * mean.q.front() / kPi;
  EXPECT_NEAR(integral, mean_square, 1e-12 * mean_square);
}

TEST(MeanSpectrum, OfOtherAxesIsExactForAPowerLaw) {
  const MeanSpectrum mean = mean_spectrum(
      {power_law(1, -2.6, multiples_of(3, 40)), power_law(5, -2.6, multiples_of(2, 30))});
  ASSERT_FALSE(mean.q.empty());
  EXPECT_EQ(mean.q.front(), 3);
  EXPECT_EQ(mean.q.back(), 60);  // the other one ends there
  for (std::size_t i = 0; i < mean.q.size(); ++i) {
    const double expected = 3 * std::pow(mean.q[i], -2.6);
    EXPECT_NEAR(mean.density[i].mean, expected, 1e-12 * expected);
  }
}

TEST(MeanSpectrum, OfOneScanHasNoDeviation) {
  const MeanSpectrum mean = mean_spectrum({power_law(1, -2, {1, 2, 3})});
  EXPECT_EQ(mean.density[1].mean, 0.25);
  EXPECT_TRUE(std::isnan(mean.density[1].standard_deviation));
}

TEST(MeanSpectrum, InterpolatesBesideAZero) {
  Spectrum filtered = power_law(1, 0, {1, 3});
  filtered.density = {2, 0};
  const MeanSpectrum mean = mean_spectrum({filtered, power_law(1, 0, {2, 3})});
  EXPECT_EQ(mean.q, (std::vector<double>{2, 3}));
  EXPECT_EQ(mean.density[0].mean, 1);
  EXPECT_EQ(mean.density[1].mean, 0.5);
}

TEST(MeanSpectrum, RejectsWhatHasNothingInCommon) {
  Spectrum other = power_law(1, -2, {1, 2});
  other.unit = "m^4";
  EXPECT_THROW(mean_spectrum({}), InputError);
  EXPECT_THROW(mean_spectrum({power_law(1, -2, {1, 2}), other}), InputError);
  EXPECT_THROW(mean_spectrum({power_law(1, -2, {1, 2}), power_law(1, -2, {3, 4})}), InputError);
  EXPECT_THROW(mean_spectrum({power_law(1, -2, {})}), InputError);
}

TEST(ParameterMeans, CountThoseThatHaveAValue) {
  const auto sq = [](double value) { return Parameter{"Sq", value, "m", "rms"}; };
  const Parameter ssk{"Ssk", std::nan(""), "1", "skewness"};
  const auto means = parameter_means({{sq(1e-6), ssk}, {sq(3e-6)}, {sq(std::nan(""))}});
  ASSERT_EQ(means.size(), 2u);
  EXPECT_EQ(means[0].symbol, "Sq");
  EXPECT_EQ(means[0].unit, "m");
  EXPECT_EQ(means[0].value.n, 2u);
  EXPECT_NEAR(means[0].value.mean, 2e-6, 1e-20);
  EXPECT_NEAR(means[0].value.standard_deviation, std::sqrt(2.0) * 1e-6, 1e-20);
  EXPECT_EQ(means[1].value.n, 0u);
  EXPECT_TRUE(std::isnan(means[1].value.mean));
}

TEST(Pattern, FitsAsInTheShell) {
  EXPECT_TRUE(fits("before_1.x3p", "before*"));
  EXPECT_TRUE(fits("before_1.x3p", "*_?.x3p"));
  EXPECT_TRUE(fits("aXbXc", "a*b*c"));
  EXPECT_TRUE(fits("", "*"));
  EXPECT_FALSE(fits("before_1.x3p", "before"));
  EXPECT_FALSE(fits("after_12.x3p", "*_?.x3p"));
  EXPECT_FALSE(fits("", "?"));
}

}  // namespace
}  // namespace tabor::metrology
