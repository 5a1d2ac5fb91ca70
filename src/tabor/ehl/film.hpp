#pragma once

#include <Eigen/Core>

#include "tabor/core/warning.hpp"
#include "tabor/material/lubricant.hpp"

/// What the films of all programs have in common.
namespace tabor::ehl {

/// The smallest film [m], by a parabola through the thinnest node and its neighbours.
double smallest_film(const Eigen::ArrayXd& film);

/// The liquid with a share of its pressure-viscosity coefficient; 0: pressure does not thicken it.
material::Lubricant with_share_of_coefficient(material::Lubricant lubricant, double share);

/// The warning about an inlet that is so many lengths sqrt(2 R h) longer than the dry contact.
Warning short_inlet(double lengths);

}  // namespace tabor::ehl
