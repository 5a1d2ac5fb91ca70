#include "tabor/reference/ehl_films.hpp"

#include <cmath>
#include <numbers>

namespace tabor::reference {
namespace {

using std::numbers::pi;

// Moes' limits of the line contact.
double line_ri(double M) { return 2.45 / M; }
double line_ei(double M) { return 2.05 * std::pow(M, -0.2); }
double line_rp(double L) { return 1.05 * std::pow(L, 2. / 3); }
double line_ep(double M, double L) { return 0.99 * std::pow(M, -0.125) * std::pow(L, 0.75); }

double moes_line(double M, double L) {
  const double s = 3 - std::exp(-1 / (2 * M));
  double elastic = line_ei(M);
  if (L > 0) {
    const double r = std::exp(1 - 3 / (L + 4));
    const double t = -std::expm1(-3.5 * std::pow(M, 0.125) * std::pow(L, -0.25));
    elastic = std::pow(std::pow(line_ep(M, L) * t, r) + std::pow(elastic, r), 1 / r);
  }
  return std::pow(std::pow(elastic, s) + std::pow(line_ri(M), s), 1 / s);
}

/// Film [m] of h / (R sqrt(2 U)).
double in_metres(double moes_film, double radius, double speed_group) {
  return moes_film * radius * std::sqrt(2 * speed_group);
}

}  // namespace

double LineContactFilm::speed_group() const {
  return viscosity * entrainment_speed / (2 * effective_modulus * radius);
}
double LineContactFilm::load_group() const { return load / (2 * effective_modulus * radius); }
double LineContactFilm::material_group() const {
  return 2 * pressure_coefficient * effective_modulus;
}
double LineContactFilm::moes_load() const { return load_group() / std::sqrt(2 * speed_group()); }
double LineContactFilm::moes_viscosity() const {
  return material_group() * std::pow(2 * speed_group(), 0.25);
}

double LineContactFilm::rigid_isoviscous() const {
  return in_metres(line_ri(moes_load()), radius, speed_group());
}
double LineContactFilm::elastic_isoviscous() const {
  return in_metres(line_ei(moes_load()), radius, speed_group());
}
double LineContactFilm::rigid_piezoviscous() const {
  return in_metres(line_rp(moes_viscosity()), radius, speed_group());
}
double LineContactFilm::elastic_piezoviscous() const {
  return in_metres(line_ep(moes_load(), moes_viscosity()), radius, speed_group());
}
double LineContactFilm::moes_min_film() const {
  return in_metres(moes_line(moes_load(), moes_viscosity()), radius, speed_group());
}

double LineContactFilm::dowson_higginson_min_film() const {
  return 2.65 * std::pow(speed_group(), 0.7) * std::pow(material_group(), 0.54) *
         std::pow(load_group(), -0.13) * radius;
}

double LineContactFilm::grubin_film() const {
  const double entrained = viscosity * entrainment_speed * pressure_coefficient * std::sqrt(radius);
  return std::pow(2.3664 * entrained * std::pow(pi * effective_modulus / load, 0.125), 8. / 11);
}

double grubin_gap(double x) {
  const double q = std::abs(x);
  return 2 * (q * std::sqrt(q * q - 1) - std::acosh(q));
}

double grubin_inlet_integral(double film) {
  // x = cosh(t) makes the gap smooth, t = e^y makes the integrand die out exponentially at both
  // ends: the plain sum over y then converges faster than any power.
  const double step = 0.02;
  double sum = 0;
  for (int i = 0; i < 1700; ++i) {
    const double t = std::exp(-30 + step * i);
    // sinh(2 t) - 2 t, by its series where the difference would lose its digits.
    const double u = 4 * t * t;
    const double d = t < 0.1 ? 2 * t * u / 6 * (1 + u / 20 * (1 + u / 42 * (1 + u / 72)))
                             : std::sinh(2 * t) - 2 * t;
    sum += d / std::pow(film + d, 3) * std::sinh(t) * t;
  }
  return sum * step;
}

double PointContactFilm::speed_group() const {
  return viscosity * entrainment_speed / (2 * effective_modulus * radius_x);
}
double PointContactFilm::load_group() const {
  return load / (2 * effective_modulus * radius_x * radius_x);
}
double PointContactFilm::material_group() const {
  return 2 * pressure_coefficient * effective_modulus;
}
double PointContactFilm::moes_load() const {
  return load_group() * std::pow(2 * speed_group(), -0.75);
}
double PointContactFilm::moes_viscosity() const {
  return material_group() * std::pow(2 * speed_group(), 0.25);
}

double PointContactFilm::nijenbanning_central() const {
  return in_metres(nijenbanning_central_film(moes_load(), moes_viscosity(), radius_x / radius_y),
                   radius_x, speed_group());
}

double PointContactFilm::hamrock_dowson_central() const {
  const double k = std::pow(radius_y / radius_x, 2 / pi);
  return 2.69 * std::pow(speed_group(), 0.67) * std::pow(material_group(), 0.53) *
         std::pow(load_group(), -0.067) * (1 - 0.61 * std::exp(-0.73 * k)) * radius_x;
}

double PointContactFilm::hamrock_dowson_min() const {
  const double k = std::pow(radius_y / radius_x, 2 / pi);
  return 3.63 * std::pow(speed_group(), 0.68) * std::pow(material_group(), 0.49) *
         std::pow(load_group(), -0.073) * -std::expm1(-0.68 * k) * radius_x;
}

double nijenbanning_central_film(double M, double L, double ratio) {
  const double elliptic = 1 + 0.006 * std::log(ratio) + 0.63 * std::pow(ratio, 4. / 7);
  const double ri =
      145 * std::pow(1 + 0.796 * std::pow(ratio, 14. / 15), -15. / 7) / (ratio * M * M);
  const double ei =
      3.18 * std::pow(elliptic, -14. / 25) * std::pow(ratio, -1. / 15) * std::pow(M, -2. / 15);
  const double rp = 1.29 * std::pow(1 + 0.691 * ratio, -2. / 3) * std::pow(L, 2. / 3);
  const double ep = 1.48 * std::pow(elliptic, -7. / 20) * std::pow(ratio, -1. / 24) *
                    std::pow(M, -1. / 12) * std::pow(L, 0.75);
  const double s = 1.5 * (1 + std::exp(-1.2 * ei / ri));
  const double isoviscous =
      std::pow(ri, 1.5) + std::pow(std::pow(ei, -4) + std::pow(1.8 / ratio, -4), -0.375);
  const double piezoviscous = L > 0 ? std::pow(std::pow(rp, -8) + std::pow(ep, -8), -s / 8) : 0;
  return std::pow(std::pow(isoviscous, 2 * s / 3) + piezoviscous, 1 / s);
}

}  // namespace tabor::reference
