#include "tabor/reference/waves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tabor::reference {

using std::numbers::pi;

double flattening_pressure(double effective_modulus, double wavevector, double amplitude) {
  return 0.5 * effective_modulus * wavevector * amplitude;
}

double WestergaardWave::full_contact_pressure() const {
  return flattening_pressure(effective_modulus, 2 * pi / wavelength, amplitude);
}

double WestergaardWave::half_width(double mean_pressure) const {
  const double ratio = std::min(1.0, mean_pressure / full_contact_pressure());
  return wavelength / pi * std::asin(std::sqrt(ratio));
}

double WestergaardWave::area_fraction(double mean_pressure) const {
  return 2 * half_width(mean_pressure) / wavelength;
}

double WestergaardWave::separation(double mean_pressure) const {
  const double ratio = std::min(1.0, mean_pressure / full_contact_pressure());
  return amplitude * (ratio > 0 ? 1 - ratio + ratio * std::log(ratio) : 1);
}

double WestergaardWave::pressure(double mean_pressure, double x) const {
  const double full = full_contact_pressure();
  const double psi = pi * x / wavelength;
  if (mean_pressure >= full) return mean_pressure + full * std::cos(2 * psi);
  // Johnson eq. 13.9, with sin^2(pi a / L) = P / p*.
  const double sine = std::sin(psi);
  const double inside = mean_pressure / full - sine * sine;
  return inside > 0 ? 2 * full * std::abs(std::cos(psi)) * std::sqrt(inside) : 0;
}

double jgh_full_contact_pressure(double effective_modulus, double amplitude, double wavelength) {
  // cos cos is two modes of half the amplitude, |q| = sqrt(2) 2 pi / L each; they add at a crest.
  return 2 * flattening_pressure(effective_modulus, 2 * std::numbers::sqrt2 * pi / wavelength,
                                 amplitude / 2);
}

double jgh_area_at_low_load(double load_ratio) {
  const double root = std::cbrt(3 * load_ratio / (8 * pi));
  return pi * root * root;
}

double jgh_area_at_high_load(double load_ratio) { return 1 - 1.5 / pi * (1 - load_ratio); }

}  // namespace tabor::reference
