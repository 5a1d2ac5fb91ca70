#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "tabor/io/hdf5/hdf5.hpp"
#include "tabor/io/hdf5/library.hpp"

namespace tabor::io::hdf5 {

/// Returns `count` compound values of this type, read by `read` (H5Dread or H5Aread bound to its
/// object); nullopt if a member is neither text nor number nor a list of numbers, or nothing could
/// be read.
std::optional<std::vector<Hdf5Record>> read_records(
    hid_t type, hid_t space, std::uint64_t count,
    const std::function<herr_t(hid_t memory_type, void* data)>& read);

}  // namespace tabor::io::hdf5
