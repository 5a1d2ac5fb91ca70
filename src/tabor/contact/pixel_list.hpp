#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "tabor/core/parallel.hpp"
#include "tabor/core/types.hpp"

// Lists pixels that satisfy a condition, and loops and sums over such lists on all threads.
namespace tabor::contact {

using PixelList = std::vector<std::uint32_t>;  ///< linear pixel indices, ascending

/// Returns the i < n for which chosen(i) holds, ascending.
template <typename Chosen>
PixelList list_where(Index n, const Chosen& chosen) {
  std::vector<PixelList> lists(static_cast<std::size_t>((n + kBlock - 1) / kBlock));
  parallel_for(n, kBlock, [&](Index begin, Index end) {
    PixelList& list = lists[static_cast<std::size_t>(begin / kBlock)];
    for (Index i = begin; i < end; ++i) {
      if (chosen(i)) list.push_back(static_cast<std::uint32_t>(i));
    }
  });
  std::size_t size = 0;
  for (const PixelList& list : lists) size += list.size();
  PixelList all;
  all.reserve(size);
  for (const PixelList& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

/// Calls body(k) for every k < n.
template <typename Body>
void for_each(std::size_t n, const Body& body) {
  parallel_for(static_cast<Index>(n), kBlock, [&](Index begin, Index end) {
    for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k) body(k);
  });
}

/// Returns the sum of term(k) over k < n, in fixed blocks.
template <typename Term>
double sum_over(std::size_t n, const Term& term) {
  return deterministic_sum(static_cast<Index>(n), [&](Index begin, Index end) {
    double partial = 0;
    for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k) {
      partial += term(k);
    }
    return partial;
  });
}

}  // namespace tabor::contact
