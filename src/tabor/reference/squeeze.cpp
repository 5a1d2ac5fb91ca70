#include "tabor/reference/squeeze.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tabor::reference {

using std::numbers::pi;

double SphereSqueeze::pressure(double h, double speed) const {
  return h < wetted_gap
             ? 3 * viscosity * radius * speed * (1 / (h * h) - 1 / (wetted_gap * wetted_gap))
             : 0;
}

double SphereSqueeze::force(double min_film, double speed) const {
  const double wetted = 1 - min_film / wetted_gap;
  return 6 * pi * viscosity * radius * radius * speed / min_film * wetted * wetted;
}

double CylinderSqueeze::pressure(double h, double speed) const {
  return 6 * viscosity * radius * speed / (h * h);
}

double CylinderSqueeze::force(double min_film, double speed) const {
  return 3 * std::numbers::sqrt2 * pi * viscosity * speed * std::pow(radius / min_film, 1.5);
}

double DiscSqueeze::pressure(double r, double film, double speed) const {
  return 3 * viscosity * speed * (radius * radius - r * r) / (film * film * film);
}

double DiscSqueeze::force(double film, double speed) const {
  return 1.5 * pi * viscosity * std::pow(radius, 4) * speed / (film * film * film);
}

double DiscSqueeze::closing_time(double force, double from, double to) const {
  return 0.75 * pi * viscosity * std::pow(radius, 4) / force * (1 / (to * to) - 1 / (from * from));
}

double BallApproach::stokes_number(double speed) const {
  return mass * speed / (6 * pi * viscosity * radius * radius);
}

double BallApproach::speed_at(double gap, double from, double speed) const {
  return std::max(0.0, speed * (1 - std::log(from / gap) / stokes_number(speed)));
}

double BallApproach::stopping_gap(double from, double speed) const {
  return from * std::exp(-stokes_number(speed));
}

}  // namespace tabor::reference
