#pragma once

#include "tabor/cases/ehl/surface.hpp"

namespace tabor::cases {

/// Reads the scans that cases of elastohydrodynamic films name, treats them, and generates their
/// finishes. Several threads may call it at the same time.
ehl::SurfaceSource ehl_surfaces();

}  // namespace tabor::cases
