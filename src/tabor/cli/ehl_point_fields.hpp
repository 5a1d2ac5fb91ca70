#pragma once

#include "tabor/ehl/point/point.hpp"
#include "tabor/io/hdf5.hpp"

/// What `tabor ehl point -o` keeps of a film (docs/ehl_point.md).
namespace tabor::cli {

/// Maps in /contact, curves through the centre in /along and /across, the slice-plane graph in
/// /slice_plane. `smooth`: the film without the roughness, shown behind it, or null.
void write_point(io::Hdf5Writer& writer, const ehl::PointProblem& problem,
                 const ehl::PointResult& result, const ehl::PointResult* smooth);

}  // namespace tabor::cli
