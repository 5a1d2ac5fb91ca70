#include "tabor/io/hdf5/chunks.hpp"

#include <algorithm>
#include <vector>

#include "tabor/core/parallel.hpp"
#include "tabor/io/files/deflate.hpp"

namespace tabor::io::hdf5 {
namespace {

constexpr Index kBatch = 32;  // chunks held at a time: some 8 MB

Index n_pieces(Index whole, Index piece) { return (whole + piece - 1) / piece; }

std::string elements_of(const ChunkLayout& layout, const CopyRow& copy_row,
                        const std::array<Index, 2>& offset) {
  const auto [rows, columns] = layout.chunk;
  const std::size_t row_size = static_cast<std::size_t>(columns) * layout.element_size;
  std::string elements(static_cast<std::size_t>(rows) * row_size, '\0');
  const Index n_rows = std::min(rows, layout.shape[0] - offset[0]);
  const Index n_columns = std::min(columns, layout.shape[1] - offset[1]);
  for (Index row = 0; row < n_rows; ++row) {
    copy_row(offset[0] + row, offset[1], n_columns,
             elements.data() + static_cast<std::size_t>(row) * row_size);
  }
  return elements;
}

/// First bytes of all elements, then second ones, and so on: alike bytes stand together.
std::string shuffled(const std::string& elements, std::size_t element_size) {
  if (element_size == 1) return elements;
  std::string bytes(elements.size(), '\0');
  const std::size_t n = elements.size() / element_size;
  for (std::size_t byte = 0; byte < element_size; ++byte) {
    char* const to = bytes.data() + byte * n;
    for (std::size_t i = 0; i < n; ++i) to[i] = elements[i * element_size + byte];
  }
  return bytes;
}

}  // namespace

void pack_chunks(const ChunkLayout& layout, const CopyRow& copy_row,
                 const std::function<void(const PackedChunk&)>& receive) {
  const Index across = n_pieces(layout.shape[1], layout.chunk[1]);
  const Index n = n_pieces(layout.shape[0], layout.chunk[0]) * across;
  for (Index first = 0; first < n; first += kBatch) {
    std::vector<PackedChunk> batch(static_cast<std::size_t>(std::min(kBatch, n - first)));
    parallel_for(static_cast<Index>(batch.size()), 1, [&](Index begin, Index end) {
      for (Index i = begin; i < end; ++i) {
        PackedChunk& chunk = batch[static_cast<std::size_t>(i)];
        chunk.offset = {(first + i) / across * layout.chunk[0],
                        (first + i) % across * layout.chunk[1]};
        chunk.bytes =
            deflate(shuffled(elements_of(layout, copy_row, chunk.offset), layout.element_size));
      }
    });
    for (const PackedChunk& chunk : batch) receive(chunk);
  }
}

}  // namespace tabor::io::hdf5
