#pragma once

#include "tabor/contact/contact.hpp"

// Computes the normal stiffness of a solved contact.
namespace tabor::contact {

/// Stiffness of a contact, with its error.
struct Stiffness {
  double value = 0;  ///< -dP / d(separation) [Pa/m]; infinite for a periodic cell in full contact
  Convergence convergence;  ///< certificate: relative residual
};

/// Computes the stiffness of the contact against a small approach, at constant contact: S dp = d on
/// the pixels in contact below saturation (saturated ones take no more load), by preconditioned
/// conjugate gradients. Costs about as much as the contact solve.
Stiffness contact_stiffness(elastic::ElasticOperator& elasticity, const State& state,
                            double saturation_pressure, double tolerance = 1e-6);

}  // namespace tabor::contact
