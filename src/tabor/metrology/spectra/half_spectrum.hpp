#pragma once

#include "tabor/core/types.hpp"

namespace tabor::metrology {

/// Returns how often frequency k of a half spectrum of n samples occurs in the full one.
inline double multiplicity(Index k, Index n) { return k == 0 || 2 * k == n ? 1 : 2; }

}  // namespace tabor::metrology
