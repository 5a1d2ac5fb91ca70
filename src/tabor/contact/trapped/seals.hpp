#pragma once

#include <vector>

#include "tabor/contact/trapped/pockets.hpp"
#include "tabor/core/types.hpp"

// Finds the pressure at which each pocket of liquid opens a way out.
namespace tabor::contact {

/// Returns the seal of each pocket [Pa]: of all paths by four neighbours from the pocket to gap
/// with a way out, the one whose largest contact pressure is smallest, and that pressure. A path
/// crosses another pocket at the pressure of its liquid. Pixels are joined in the order of rising
/// pressure (union-find); those at the cap come last and need no order. At most the cap, which
/// bounds the pressure of the liquid anyway; infinite without one where there is no way out.
/// `pressure` [Pa], shape (ny, nx); `liquid`: pressure of each pocket [Pa]; `cap`: saturation
/// pressure [Pa].
std::vector<double> seals_of(const Field& pressure, const Pockets& pockets,
                             const std::vector<double>& liquid, const Grid& grid, bool periodic,
                             double cap);

}  // namespace tabor::contact
