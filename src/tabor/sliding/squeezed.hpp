#pragma once

#include "tabor/core/convergence.hpp"
#include "tabor/core/types.hpp"
#include "tabor/deposition/deposition.hpp"

// Squeezes oil out of the contacts that a sliding tool makes.
namespace tabor::sliding {

/// Oil after a contact.
struct Squeezed {
  Field film;                ///< [m]
  double without_space = 0;  ///< that the gap could not hold, over the nominal area [m]
  double lost = 0;           ///< that ran off open edges, over the nominal area [m]
};

/// Squeezes a film [m] out of a contact with this gap [m]. What is thicker than max(gap, 0) is
/// rained evenly over the open gap, and all liquid there runs into its deepest places and fills
/// them; it overflows from one to another where their gap is closed. Nothing stays on the contact.
/// `sealed`: pixels of closed pockets, whose oil stays where it is; null: none.
Squeezed squeeze(const Field& film, const Field& gap, const Mask* sealed, const Grid& grid,
                 deposition::Edge edge, const Observer& observer = {});

}  // namespace tabor::sliding
