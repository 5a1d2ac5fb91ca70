#pragma once

#include "tabor/ehl/surface.hpp"

namespace tabor::analysis {

/// Reads the scans that cases of elastohydrodynamic films name, treats them, and generates their
/// finishes. May be called by several threads at a time.
ehl::SurfaceSource ehl_surfaces();

}  // namespace tabor::analysis
