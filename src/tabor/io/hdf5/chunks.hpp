#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>

#include "tabor/core/types.hpp"

// Packs maps into HDF5 chunks on all threads: the library itself packs on one.
namespace tabor::io::hdf5 {

/// Chunk of a two-dimensional dataset as its filters leave it, shuffled and deflated.
struct PackedChunk {
  std::array<Index, 2> offset{};  ///< row and column of its first element
  std::string bytes;
};

/// Rows and columns of a map, of its chunks, and bytes of an element.
struct ChunkLayout {
  std::array<Index, 2> shape{};
  std::array<Index, 2> chunk{};
  std::size_t element_size = 0;
};

/// Puts the elements of part of a row, as the file has them, into a buffer.
using CopyRow = std::function<void(Index row, Index column, Index count, char* to)>;

/// Packs the chunks on all threads and hands them over in order, on the calling thread. Elements
/// beyond the borders of the map are zero. The bytes do not depend on the number of threads.
void pack_chunks(const ChunkLayout& layout, const CopyRow& copy_row,
                 const std::function<void(const PackedChunk&)>& receive);

}  // namespace tabor::io::hdf5
