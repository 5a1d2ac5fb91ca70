#pragma once

#include "tabor/io/hdf5_guard.hpp"
#include "tabor/scan/formats/format.hpp"

namespace tabor::scan::format {

/// Rejects the file if a copy of this process does not get through `describe`.
void require_survival(const Contents& contents, const std::function<void()>& describe);

/// Heights that `send` hands over in a copy of this process; rejects the file if it breaks.
Field guarded_heights(const Contents& contents, std::array<Index, 2> shape,
                      const io::SendRows& send);

}  // namespace tabor::scan::format
