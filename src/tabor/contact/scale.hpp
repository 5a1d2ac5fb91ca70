#pragma once

#include "tabor/contact/load_problem.hpp"

// Finds the length that makes errors of a contact dimensionless.
namespace tabor::contact {

/// Returns the length [m] that makes certificates dimensionless: the rms height, or for a surface
/// of constant height the displacement scale P * side / E*.
double length_scale(const elastic::ElasticOperator& elasticity, const LoadProblem& problem);

}  // namespace tabor::contact
