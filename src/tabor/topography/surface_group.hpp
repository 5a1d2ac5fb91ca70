#pragma once

#include <string>

#include "tabor/io/hdf5/hdf5.hpp"
#include "tabor/topography/topography.hpp"

namespace tabor::topography {

/// Writes the group /surface of docs/results.md, the same in every file that holds a surface:
/// height, mask, axes, how it plots, where it comes from. `source` names the scan file.
void write_surface_group(io::Hdf5Writer& writer, const Topography& surface,
                         const std::string& source,
                         io::Precision precision = io::Precision::float64);

}  // namespace tabor::topography
