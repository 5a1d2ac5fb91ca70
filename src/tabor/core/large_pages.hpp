#pragma once

#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include <cstddef>
#include <cstdint>

namespace tabor::lubrication {

/// Room for n elements that the system may back by large pages: an array read in random order
/// otherwise spends as long on finding pages as on reading them. Only a hint; call on an empty
/// vector, before its elements exist.
template <class T>
void reserve_large_pages(std::vector<T>& vector, std::size_t n) {
  vector.reserve(n);
#if defined(__linux__)
  constexpr std::uintptr_t page = 4096;
  char* const first = reinterpret_cast<char*>(vector.data());
  const std::uintptr_t skipped = (page - reinterpret_cast<std::uintptr_t>(first) % page) % page;
  const std::uintptr_t size = n * sizeof(T);
  if (size >= skipped + page) {
    (void)madvise(first + skipped, (size - skipped) / page * page, MADV_HUGEPAGE);
  }
#endif
}

/// The same for a vector that has grown to its size.
template <class T>
void move_to_large_pages(std::vector<T>& vector) {
  std::vector<T> moved;
  reserve_large_pages(moved, vector.size());
  moved = vector;
  vector = std::move(moved);
}

}  // namespace tabor::lubrication
