#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "tabor/core/warning.hpp"
#include "tabor/material/lubricant_density.hpp"
#include "tabor/material/lubricant_shear.hpp"
#include "tabor/material/lubricant_viscosity.hpp"

// Combines viscosity, density and shear laws to one lubricant and evaluates them at the nodes of a
// film.
namespace tabor::material {

/// Lubricant of a film: three laws, each a small value.
struct Lubricant {
  Viscosity viscosity = ConstantViscosity{0.1};
  RelativeDensity density;  ///< incompressible unless given
  Shear shear;              ///< Newtonian unless given
};

/// Values that a Reynolds solver needs at its nodes, one entry per node in each array. The caller
/// stores them, so that a Newton iteration allocates nothing.
struct NodeLaws {
  Eigen::ArrayXd viscosity;              ///< eta [Pa s]
  Eigen::ArrayXd viscosity_by_pressure;  ///< [s]
  Eigen::ArrayXd density;                ///< rho / rho0 [-]
  Eigen::ArrayXd density_by_pressure;    ///< [1/Pa]
};

/// Fills `laws` (resized to the number of pressures [Pa]) with the viscosity at low shear and the
/// density. Pressures outside computable_range() give values that are infinite, negative or NaN.
void evaluate(const Lubricant& lubricant, std::span<const double> pressure, NodeLaws& laws);

/// Returns the pressures at which viscosity and density can be computed.
PressureRange computable_range(const Lubricant& lubricant);

/// Throws InputError, naming the law, if the pressure [Pa] is outside computable_range().
void check_pressure(const Lubricant& lubricant, double pressure);

/// Returns one warning for each law whose trusted range ends below `highest_pressure` [Pa].
Warnings warnings(const Lubricant& lubricant, double highest_pressure);

}  // namespace tabor::material
