#pragma once

#include <cstddef>
#include <filesystem>

#include "tabor/core/types.hpp"

namespace tabor::bench {

/// A field as NumPy keeps it: version 1, "<f8", row by row. No reader of scans comes between, as a
/// pressure is no height: what a height cannot be, a pressure may. Throws std::runtime_error for
/// any other array and for numbers that are not finite.
Field read_npy(const std::filesystem::path& file);

void write_npy(const Field& field, const std::filesystem::path& file);

}  // namespace tabor::bench
