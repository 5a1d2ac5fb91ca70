#pragma once

#include "tabor/contact/contact.hpp"

namespace tabor::contact {

/// Smallest and largest value of a map.
struct Extent {
  double lowest;
  double highest;
};
Extent extent_of(const Field& map);

/// Length [m] that makes certificates dimensionless: the rms height, or for a surface of constant
/// height the displacement scale P * side / E*.
double length_scale(const elastic::ElasticOperator& elasticity, const Problem& problem);

}  // namespace tabor::contact
