#pragma once

#include "tabor/contact/contact.hpp"

// Finds the range of heights, and the length that makes errors of a contact dimensionless.
namespace tabor::contact {

/// Smallest and largest value of a map.
struct Extent {
  double lowest;
  double highest;
};
Extent extent_of(const Field& map);

/// Returns the length [m] that makes certificates dimensionless: the rms height, or for a surface
/// of constant height the displacement scale P * side / E*.
double length_scale(const elastic::ElasticOperator& elasticity, const Problem& problem);

}  // namespace tabor::contact
