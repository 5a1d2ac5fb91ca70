#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "tabor/core/types.hpp"
#include "tabor/io/hdf5/hdf5.hpp"

// Reads HDF5 files of unknown origin in a copy of the process, once isolate_hdf5_reading()
// (protection.hpp) asked for it; otherwise reads them in this process.
namespace tabor::io {

/// True where a copy of this process completes `action`, by a result or an exception, in 2 s of
/// processor time and 256 MiB of memory, and more for large files. The HDF5 library trusts what a
/// file says about its lists, sizes and texts and crashes over damaged ones (H5HG_read of version
/// 1.10.8 checks an index only in debug builds) or asks for gigabytes. With isolation nothing is
/// read without a copy: throws Error if none can be made, InputError if it waits for something for
/// more than 5 s or is not done in a minute, and more for large files. A copy holds no FileLock,
/// and ends with this process. Without isolation `action` is not run, and the answer is true.
bool hdf5_survives(const std::filesystem::path& file, const std::function<void()>& action);

/// Returns the map of this shape that `send` makes, run in a copy of this process: it hands pieces
/// of rows from the top to its argument. Nullopt if the copy breaks, sends less or more, or needs
/// far more memory or processor time than a map of this size; throws as hdf5_survives() does.
/// `progress` is told the share received so far. Without isolation `send` is run in this process.
using SendRows = std::function<void(const std::function<void(const Field& rows)>& accept)>;
std::optional<Field> guarded_hdf5_map(const std::filesystem::path& file, std::array<Index, 2> shape,
                                      const SendRows& send,
                                      const std::function<void(double share)>& progress);

/// Throws InputError for a file over which the copy breaks.
void require_hdf5_survives(const std::filesystem::path& file, const std::function<void()>& action);

/// Returns what `read` makes of the file, which a copy of this process has read first. Throws
/// InputError, also whatever `read` throws.
template <typename Read>
auto read_guarded(const std::filesystem::path& file, const Read& read) {
  require_hdf5_survives(file, [&] { read(Hdf5Reader(file)); });
  return read(Hdf5Reader(file));
}

/// Returns the map at `path` of this file, read by a copy of this process. Throws InputError.
Field read_guarded_map(const std::filesystem::path& file, const std::string& path);

}  // namespace tabor::io
