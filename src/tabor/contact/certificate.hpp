#pragma once

#include <vector>

#include "tabor/contact/caps.hpp"

// Computes the duality gap, which bounds the error of an approximate contact solution.
namespace tabor::contact {

/// Pixels that matter to the optimality of a pressure field: every pixel in contact and every other
/// pixel whose gap could be the smallest. Parallel arrays.
struct Candidates {
  std::vector<double> pressure;  ///< [Pa]
  std::vector<double> residual;  ///< v = S p - z [m], up to one common constant
};

/// Returns the duality gap of the contact problem (Rey, Anciaux & Molinari 2017,
/// doi:10.1007/s00466-017-1392-5, give the energy principle):
///
///     G = <p, v> - min { <s, v> : 0 <= s <= p_sat, mean(s) = P },    v = S p - z
///
/// It bounds the energy error of p from above. The minimum is a knapsack: p_sat on the smallest v.
/// `load` is the sum of pressures P * n_pixels [Pa], `caps` are those of the candidates; the result
/// [Pa m] is summed over pixels. Only valid for a pressure that carries the load exactly.
double duality_gap(const Candidates& candidates, double load, const Caps& caps);

/// Returns the threshold of that knapsack: pixels of smaller v are full, the one at the threshold
/// carries what they leave of the load.
double knapsack_threshold(const std::vector<double>& v, double load, const Caps& caps);

}  // namespace tabor::contact
