#pragma once

#include <cstdint>

#include "tabor/core/types.hpp"

namespace tabor::topography {

/// Returns a number that tells surfaces apart: a digest of all heights, to the last bit, and of the
/// grid. 0 and -0 are the same height. Never 0; the same for any number of threads. Not for files:
/// it may change from one version to the next.
std::uint64_t digest_of(const Field& height, const Grid& grid);

}  // namespace tabor::topography
