#pragma once

#include <cstdint>
#include <vector>

#include "tabor/core/types.hpp"

// Counts and labels the connected patches of a contact and the pixel edges and corners of their
// outlines.
namespace tabor::contact {

/// Numbers of patches; same layout as Field.
using LabelMap = Eigen::Array<std::int32_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Connected contact patches: pixels that share an edge belong together, across the border too if
/// the cell is periodic.
struct Patches {
  std::vector<Index> pixel_counts;  ///< of each patch, in order of its first pixel
  Index size() const { return static_cast<Index>(pixel_counts.size()); }
};

/// Finds the 4-connected patches; `periodic` joins patches at opposite borders.
Patches find_patches(const Mask& contact, bool periodic);

/// Returns the number of the patch of each pixel, counted from 1 in the order of `find_patches`; 0
/// where there is no contact.
LabelMap label_patches(const Mask& contact, bool periodic);

/// Numbers of neighbouring pixel pairs of which exactly one is in contact.
struct Transitions {
  Index along_rows = 0;     ///< left-right neighbours
  Index along_columns = 0;  ///< upper-lower neighbours
  Index total() const { return along_rows + along_columns; }
};

/// Counts the corners of the outlines of the contact along pixel edges; two where two outlines
/// meet.
Index count_corners(const Mask& contact, bool periodic);

/// Counts edges between contact and open pixels, across borders too if `periodic`.
Transitions count_transitions(const Mask& contact, bool periodic);

}  // namespace tabor::contact
