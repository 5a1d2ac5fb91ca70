#pragma once

#include <vector>

#include "tabor/core/types.hpp"

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>

// Allocates large arrays on large memory pages, which makes reading them in random order faster.
namespace tabor {

/// Asks the system to back n elements by large pages: otherwise, an array read in random order
/// spends as much time on finding pages as on reading them. Only a hint; to be called before the
/// elements are written.
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

/// Returns a map on large pages whose values are still to be written.
template <class Map>
Map uninitialised_map(Index ny, Index nx) {
  Map map(ny, nx);
  ask_for_large_pages(map.data(), static_cast<std::size_t>(map.size()));
  return map;
}

/// Reserves memory for n elements on large pages; to be called on an empty vector.
template <class T>
void reserve_large_pages(std::vector<T>& vector, std::size_t n) {
  vector.reserve(n);
  ask_for_large_pages(vector.data(), n);
}

/// Allocates elements that stay unwritten until they get a value: the threads that fill them share
/// the work of the system, which clears each page when it is first touched.
template <class T, bool OnLargePages>
struct Unwritten {
  using value_type = T;
  template <class U>
  struct rebind {
    using other = Unwritten<U, OnLargePages>;
  };

  Unwritten() = default;
  template <class U>
  explicit Unwritten(const Unwritten<U, OnLargePages>& /*other*/) {}

  T* allocate(std::size_t n) {
    T* const data = std::allocator<T>().allocate(n);
    if (OnLargePages) ask_for_large_pages(data, n);
    return data;
  }
  void deallocate(T* data, std::size_t n) { std::allocator<T>().deallocate(data, n); }

  template <class U>
  void construct(U* /*at*/) {
    static_assert(std::is_trivially_copyable_v<U>);
  }
  template <class U, class... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
  }

  bool operator==(const Unwritten&) const = default;
};

/// Vectors whose resize() writes nothing, as all new elements are to be written; the second, on
/// large pages, is to be read in random order.
template <class T>
using UnwrittenVector = std::vector<T, Unwritten<T, false>>;
template <class T>
using LargeVector = std::vector<T, Unwritten<T, true>>;

/// Moves a vector that has grown to its size to large pages.
template <class Vector>
void move_to_large_pages(Vector& vector) {
  Vector moved;
  moved.reserve(vector.size());
  ask_for_large_pages(moved.data(), vector.size());
  moved = vector;
  vector = std::move(moved);
}

/// Empties a vector and releases its memory, which the assignment of {} keeps.
template <class T, class Allocator>
void release(std::vector<T, Allocator>& vector) {
  std::vector<T, Allocator>().swap(vector);
}

/// Releases the unused memory of a vector that fills less than half of its capacity.
template <class Vector>
void give_back_unused(Vector& vector) {
  if (vector.size() < vector.capacity() / 2) move_to_large_pages(vector);
}

}  // namespace tabor
