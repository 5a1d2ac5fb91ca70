#include "tabor/reference/waves.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace tabor::reference {
namespace {

using std::numbers::pi;

const WestergaardWave kWave{.amplitude = 1e-6, .wavelength = 1e-3, .effective_modulus = 78.55e9};
constexpr int kPoints = 4096;

double x_of(int i) { return kWave.wavelength * (i + 0.5) / kPoints; }

std::vector<double> sampled_pressure(double mean_pressure) {
  std::vector<double> p;
  for (int i = 0; i < kPoints; ++i) p.push_back(kWave.pressure(mean_pressure, x_of(i)));
  return p;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

/// Integral of p over one contact, divided by L. With sin(pi x / L) = sin(pi a / L) sin(t) the
/// integrand is smooth, so that the midpoint rule converges.
double load_over_wavelength(double mean_pressure) {
  const int n = 10000;
  const double sine = std::sin(pi * kWave.half_width(mean_pressure) / kWave.wavelength);
  double sum = 0;
  for (int k = 0; k < n; ++k) {
    const double t = pi * ((k + 0.5) / n - 0.5);
    const double psi = std::asin(sine * std::sin(t));
    const double slope = sine * std::cos(t) / std::cos(psi);  // d psi / d t
    sum += kWave.pressure(mean_pressure, psi * kWave.wavelength / pi) * slope;
  }
  return sum / n;
}

/// Displacement by the Fourier series of an even pressure, u_k = 2 p_k / (E* q_k): an independent
/// way from pressure to shape.
double displacement(const std::vector<double>& p, double x, int n_modes) {
  double u = 0;
  for (int k = 1; k <= n_modes; ++k) {
    const double q = 2 * pi * k / kWave.wavelength;
    double amplitude = 0;
    for (int i = 0; i < kPoints; ++i) {
      amplitude += 2 * p[static_cast<std::size_t>(i)] * std::cos(q * x_of(i)) / kPoints;
    }
    u += 2 * amplitude / (kWave.effective_modulus * q) * std::cos(q * x);
  }
  return u;
}

double gap(const std::vector<double>& p, double x) {
  const double height = kWave.amplitude * std::cos(2 * pi * x / kWave.wavelength);
  return displacement(p, x, 200) - height;
}

TEST(Westergaard, PressureAveragesToTheMeanPressure) {
  for (const double ratio : {0.01, 0.3, 0.9, 0.999}) {
    const double mean_pressure = ratio * kWave.full_contact_pressure();
    EXPECT_NEAR(load_over_wavelength(mean_pressure) / mean_pressure, 1, 1e-9) << ratio;
  }
}

TEST(Westergaard, FullContactPressureAveragesToTheMeanPressure) {
  const double mean_pressure = 2 * kWave.full_contact_pressure();
  EXPECT_NEAR(mean(sampled_pressure(mean_pressure)) / mean_pressure, 1, 1e-12);
}

TEST(Westergaard, PressureFlattensTheWaveInsideTheContactOnly) {
  const double mean_pressure = 0.3 * kWave.full_contact_pressure();
  const double a = kWave.half_width(mean_pressure);
  const auto p = sampled_pressure(mean_pressure);
  const double floor = gap(p, 0);
  EXPECT_NEAR(gap(p, 0.5 * a), floor, 1e-4 * kWave.amplitude);
  EXPECT_NEAR(gap(p, 0.9 * a), floor, 1e-3 * kWave.amplitude);
  EXPECT_GT(gap(p, 1.3 * a), floor + 0.01 * kWave.amplitude);
}

TEST(Westergaard, PressureVanishesOutsideTheHalfWidth) {
  const double mean_pressure = 0.3 * kWave.full_contact_pressure();
  const double a = kWave.half_width(mean_pressure);
  EXPECT_GT(kWave.pressure(mean_pressure, 0.999 * a), 0);
  EXPECT_EQ(kWave.pressure(mean_pressure, 1.001 * a), 0);
}

TEST(Westergaard, TouchesEverywhereFromTheFullContactPressureOn) {
  const double full = kWave.full_contact_pressure();
  EXPECT_LT(kWave.area_fraction(0.999 * full), 1);
  EXPECT_DOUBLE_EQ(kWave.area_fraction(full), 1);
  EXPECT_DOUBLE_EQ(kWave.area_fraction(2 * full), 1);
}

TEST(Westergaard, LightContactIsThatOfAHertzCylinder) {
  // a^2 = 4 P L R / (pi E*) per wavelength, R = L^2 / (4 pi^2 D) (Johnson 1985, eq. 4.43).
  const double mean_pressure = 1e-5 * kWave.full_contact_pressure();
  const double radius = std::pow(kWave.wavelength / (2 * pi), 2) / kWave.amplitude;
  const double hertz =
      std::sqrt(4 * mean_pressure * kWave.wavelength * radius / (pi * kWave.effective_modulus));
  EXPECT_NEAR(kWave.half_width(mean_pressure) / hertz, 1, 1e-5);
}

TEST(FlatteningPressure, OfACosineIsWestergaardsFullContact) {
  EXPECT_DOUBLE_EQ(flattening_pressure(78.55e9, 2 * pi / 1e-3, 1e-6), pi * 78.55e9 * 1e-6 / 1e-3);
}

TEST(JohnsonGreenwoodHigginson, FullContactPressureIsRootTwoTimesTheOneDimensionalOne) {
  EXPECT_NEAR(jgh_full_contact_pressure(78.55e9, 1e-6, 1e-3),
              std::numbers::sqrt2 * kWave.full_contact_pressure(), 1);
}

TEST(JohnsonGreenwoodHigginson, LowLoadIsTwoHertzContactsPerCell) {
  // Crest radius R = L^2/(4 pi^2 D), load P L^2 / 2 on each of the two crests of a cell.
  const double modulus = 70e9, amplitude = 1e-6, wavelength = 1e-3;
  const double ratio = 1e-4;
  const double mean_pressure = ratio * jgh_full_contact_pressure(modulus, amplitude, wavelength);
  const double radius = std::pow(wavelength / (2 * pi), 2) / amplitude;
  const double load = 0.5 * mean_pressure * wavelength * wavelength;
  const double a = std::cbrt(0.75 * load * radius / modulus);
  EXPECT_NEAR(jgh_area_at_low_load(ratio), 2 * pi * a * a / (wavelength * wavelength), 1e-12);
}

TEST(JohnsonGreenwoodHigginson, HighLoadEndsInFullContact) {
  EXPECT_EQ(jgh_area_at_high_load(1), 1);
  EXPECT_NEAR((1 - jgh_area_at_high_load(0.98)) / 0.02, 3 / (2 * pi), 1e-12);
}

TEST(JohnsonGreenwoodHigginson, TableRisesAndMeetsBothAsymptotes) {
  for (std::size_t i = 1; i < kJghTable.size(); ++i) {
    EXPECT_GT(kJghTable[i].area_fraction, kJghTable[i - 1].area_fraction);
  }
  const auto& low = kJghTable.front();
  const auto& high = kJghTable.back();
  // Neighbours push asperities together: the area stands above that of lone Hertz contacts.
  EXPECT_GT(low.area_fraction, jgh_area_at_low_load(low.load_ratio));
  EXPECT_NEAR(low.area_fraction / jgh_area_at_low_load(low.load_ratio), 1, 0.03);
  EXPECT_NEAR(high.area_fraction, jgh_area_at_high_load(high.load_ratio), 3e-3);
}

}  // namespace
}  // namespace tabor::reference
