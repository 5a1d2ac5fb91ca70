#pragma once

#include "tabor/core/types.hpp"

namespace tabor::ehl {

/// What the solids do beside the film, given while the film is solved for: their pressure adds to
/// the deflection and to the load but not to the flow; where they touch, the liquid has no pressure
/// and nothing flows through the faces of the cell, so that mass is conserved; the film there is
/// what the surfaces leave, of either sign. Empty arrays: none.
struct SolidPart {
  Field pressure;       ///< P_num [Pa], >= 0
  Field plastic_depth;  ///< h_plast [m], >= 0, adds to the film
  Mask touching;
};

/// Cells that touch, and those that touching ones close off from the border: no liquid flows
/// there, and Reynolds' equation would not say its pressure.
Mask closed_to_flow(const Mask& touching);

}  // namespace tabor::ehl
