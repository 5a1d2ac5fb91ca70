#pragma once

#include <vector>

#include "tabor/core/types.hpp"

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include <cstddef>
#include <cstdint>

namespace tabor {

/// Asks the system to back n elements by large pages: an array read in random order otherwise
/// spends as long on finding pages as on reading them, and a new one on being given its pages. Only
/// a hint; call before the elements are written.
template <class T>
void ask_for_large_pages([[maybe_unused]] T* data, [[maybe_unused]] std::size_t n) {
#if defined(__linux__)
  constexpr std::uintptr_t page = 4096;
  char* const first = reinterpret_cast<char*>(data);
  const std::uintptr_t skipped = (page - reinterpret_cast<std::uintptr_t>(first) % page) % page;
  const std::uintptr_t size = n * sizeof(T);
  if (size >= skipped + page) {
    (void)madvise(first + skipped, (size - skipped) / page * page, MADV_HUGEPAGE);
  }
#endif
}

/// A map whose values are still to be written, on large pages.
template <class Map>
Map uninitialised_map(Index ny, Index nx) {
  Map map(ny, nx);
  ask_for_large_pages(map.data(), static_cast<std::size_t>(map.size()));
  return map;
}

/// Room for n elements on large pages; call on an empty vector, before its elements exist.
template <class T>
void reserve_large_pages(std::vector<T>& vector, std::size_t n) {
  vector.reserve(n);
  ask_for_large_pages(vector.data(), n);
}

/// The same for a vector that has grown to its size.
template <class T>
void move_to_large_pages(std::vector<T>& vector) {
  std::vector<T> moved;
  reserve_large_pages(moved, vector.size());
  moved = vector;
  vector = std::move(moved);
}

/// Gives back what a vector that has shrunk to less than a half of its room does not use.
template <class T>
void give_back_unused(std::vector<T>& vector) {
  if (vector.size() < vector.capacity() / 2) move_to_large_pages(vector);
}

}  // namespace tabor
