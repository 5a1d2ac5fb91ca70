#include "tabor/reference/punches.hpp"

#include <cmath>
#include <numbers>

namespace tabor::reference {

using std::numbers::pi;

double FlatPunch::load(double indentation) const {
  return 2 * radius * effective_modulus * indentation;
}

double FlatPunch::pressure(double indentation, double r) const {
  if (std::abs(r) >= radius) return 0;
  return effective_modulus * indentation / (pi * std::sqrt(radius * radius - r * r));
}

double Cone::mean_pressure() const { return 0.5 * effective_modulus * std::tan(slope_angle); }

double Cone::contact_radius(double load) const { return std::sqrt(load / (pi * mean_pressure())); }

double Cone::indentation(double contact_radius) const {
  return 0.5 * pi * contact_radius * std::tan(slope_angle);
}

double Cone::pressure(double contact_radius, double r) const {
  return std::abs(r) < contact_radius ? mean_pressure() * std::acosh(contact_radius / std::abs(r))
                                      : 0;
}

}  // namespace tabor::reference
