#include "tabor/reference/bearings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace tabor::reference {
namespace {

using std::numbers::pi;

/// Integrals of cos^2 and cos^4 from -pi/2 to t.
double cos2_integral(double t) { return 0.5 * (t + 0.5 * pi) + 0.25 * std::sin(2 * t); }
double cos4_integral(double t) {
  return 0.375 * (t + 0.5 * pi) + 0.25 * std::sin(2 * t) + std::sin(4 * t) / 32;
}

/// p h0^2 / (12 eta u_m sqrt(2 R h0)) at tan(t) = x / sqrt(2 R h0), if p' = 0 at `exit`.
double martin_shape(double t, double exit) {
  const double cosine = std::cos(exit);
  return cos2_integral(t) - cos4_integral(t) / (cosine * cosine);
}

double solve_exit_angle() {
  double low = 0.4;
  double high = 0.5;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (martin_shape(middle, middle) > 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double square(double x) { return x * x; }
double cube(double x) { return x * x * x; }

}  // namespace

double martin_exit_angle() {
  static const double angle = solve_exit_angle();
  return angle;
}

double CylinderFilm::film(double x) const { return min_film + x * x / (2 * radius); }

double CylinderFilm::martin_exit() const {
  return std::sqrt(2 * radius * min_film) * std::tan(martin_exit_angle());
}

double CylinderFilm::martin_pressure(double x) const {
  if (x >= martin_exit()) return 0;
  const double length = std::sqrt(2 * radius * min_film);
  return 12 * viscosity * entrainment_speed * length / (min_film * min_film) *
         martin_shape(std::atan(x / length), martin_exit_angle());
}

double CylinderFilm::martin_load() const {
  // By parts: the integral of p is -x dp, and x dp is elementary.
  return 6 * square(std::cos(martin_exit_angle())) * viscosity * entrainment_speed * radius /
         min_film;
}

double CylinderFilm::sommerfeld_pressure(double x) const {
  return -4 * viscosity * entrainment_speed * x / square(film(x));
}

double CylinderFilm::half_sommerfeld_load() const {
  return 4 * viscosity * entrainment_speed * radius / min_film;
}

double KapitzaFilm::film(double x, double y) const {
  return min_film + x * x / (2 * radius_x) + y * y / (2 * radius_y);
}

double KapitzaFilm::pressure(double x, double y) const {
  return -12 * viscosity * entrainment_speed * x /
         ((3 + 2 * radius_x / radius_y) * square(film(x, y)));
}

double KapitzaFilm::load() const {
  return 12 * std::numbers::sqrt2 * pi * viscosity * entrainment_speed * radius_x *
         std::sqrt(radius_y / min_film) / (3 + 2 * radius_x / radius_y);
}

double KapitzaFilm::film_at_load(double given_load) const {
  return min_film * square(load() / given_load);
}

double LinearSlider::pressure(double x) const {
  const double h = inlet_film + (outlet_film - inlet_film) * x / length;
  return 6 * viscosity * sliding_speed * length * (inlet_film - h) * (h - outlet_film) /
         ((square(inlet_film) - square(outlet_film)) * h * h);
}

double LinearSlider::load() const {
  const double K = inlet_film / outlet_film - 1;
  return 6 * viscosity * sliding_speed * square(length / (K * outlet_film)) *
         (std::log1p(K) - 2 * K / (2 + K));
}

double RayleighStep::step_pressure() const {
  // The flow U h/2 - h^3 p'/(12 eta) is the same before and behind the step.
  return 6 * viscosity * sliding_speed * (inlet_film - outlet_film) /
         (cube(inlet_film) / step_place + cube(outlet_film) / (length - step_place));
}

double RayleighStep::pressure(double x) const {
  return step_pressure() * (x < step_place ? x / step_place : (length - x) / (length - step_place));
}

double RayleighStep::load() const { return 0.5 * length * step_pressure(); }

double CavitatedPocket::flow() const {
  return 0.5 * sliding_speed * land_film +
         cube(land_film) * (ambient_pressure - cavity_pressure) / (12 * viscosity * begin);
}

double CavitatedPocket::fill() const { return 2 * flow() / (sliding_speed * pocket_film); }

double CavitatedPocket::end_pressure() const {
  // The land behind the pocket passes the flow of the land before it.
  return ambient_pressure + (ambient_pressure - cavity_pressure) * (length - end) / begin;
}

double CavitatedPocket::reformation() const {
  const double slope =
      12 * viscosity * (0.5 * sliding_speed * pocket_film - flow()) / cube(pocket_film);
  return end - (end_pressure() - cavity_pressure) / slope;
}

double CavitatedPocket::pressure(double x) const {
  const auto between = [x](double x1, double p1, double x2, double p2) {
    return p1 + (p2 - p1) * (x - x1) / (x2 - x1);
  };
  if (x < begin) return between(0, ambient_pressure, begin, cavity_pressure);
  if (x < reformation()) return cavity_pressure;
  return x < end ? between(reformation(), cavity_pressure, end, end_pressure())
                 : between(end, end_pressure(), length, ambient_pressure);
}

double CavitatedPocket::load() const {
  const double reformed = reformation();
  return 0.5 * begin * (ambient_pressure + cavity_pressure) + cavity_pressure * (reformed - begin) +
         0.5 * (end - reformed) * (cavity_pressure + end_pressure()) +
         0.5 * (length - end) * (end_pressure() + ambient_pressure);
}

double barus_pressure(double constant_viscosity_pressure, double pressure_coefficient) {
  const double reduced = pressure_coefficient * constant_viscosity_pressure;
  if (pressure_coefficient == 0) return constant_viscosity_pressure;
  return reduced < 1 ? -std::log1p(-reduced) / pressure_coefficient
                     : std::numeric_limits<double>::infinity();
}

}  // namespace tabor::reference
