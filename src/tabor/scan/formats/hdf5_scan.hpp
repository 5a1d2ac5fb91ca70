#pragma once

#include "tabor/io/hdf5/guard.hpp"
#include "tabor/scan/formats/format.hpp"

// Reads HDF5 scan files through io/hdf5/guard.hpp and rejects files that break its copy of the
// process.
namespace tabor::scan::format {

/// Rejects the file if a copy of this process does not complete `describe`.
void require_survival(const Contents& contents, const std::function<void()>& describe);

/// Returns the heights that `send` hands over in a copy of this process; rejects the file if the
/// copy breaks.
Field guarded_heights(const Contents& contents, std::array<Index, 2> shape,
                      const io::SendRows& send);

}  // namespace tabor::scan::format
