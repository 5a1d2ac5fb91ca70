#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <limits>
#include <vector>

#include "tabor/core/parallel.hpp"
#include "tabor/core/types.hpp"

// Loops over the pixels of maps and over lists, on all threads: for each, count, sum, smallest,
// largest, select. Every result has the same bits for any number of threads.
namespace tabor {

/// Linear pixel indices, ascending.
using PixelList = std::vector<std::uint32_t>;
/// Pixels of the largest map of which there are lists.
inline constexpr Index kMostListed = Index{1} << 32;

/// Turns body(i) into a body of blocks, which calls it for every i of a block.
template <std::integral Count, typename Body>
auto blockwise(const Body& body) {
  return [&body](Index begin, Index end) {
    for (auto i = static_cast<Count>(begin); i < static_cast<Count>(end); ++i) body(i);
  };
}

/// Calls body(i) for every i < n, in any order.
template <std::integral Count, typename Body>
void for_each(Count n, const Body& body, Index block = kBlock) {
  parallel_for(static_cast<Index>(n), block, blockwise<Count>(body));
}

/// Returns the sum of term(i) over i < n, added in order within fixed blocks.
template <std::integral Count, typename Term>
double sum_over(Count n, const Term& term) {
  return deterministic_sum(static_cast<Index>(n), [&term](Index begin, Index end) {
    double partial = 0;
    for (auto i = static_cast<Count>(begin); i < static_cast<Count>(end); ++i) partial += term(i);
    return partial;
  });
}

/// Returns the number of i < n for which chosen(i) holds.
template <std::integral Count, typename Chosen>
Index count_where(Count n, const Chosen& chosen) {
  return static_cast<Index>(
      deterministic_sum(static_cast<Index>(n), [&chosen](Index begin, Index end) {
        Index count = 0;
        for (auto i = static_cast<Count>(begin); i < static_cast<Count>(end); ++i) {
          count += static_cast<Index>(chosen(i));
        }
        return static_cast<double>(count);
      }));
}

/// Returns the largest term(i) over i < n; -infinity for n = 0.
template <std::integral Count, typename Term>
double max_over(Count n, const Term& term) {
  return parallel_max(static_cast<Index>(n), [&term](Index begin, Index end) {
    double largest = -std::numeric_limits<double>::infinity();
    for (auto i = static_cast<Count>(begin); i < static_cast<Count>(end); ++i) {
      largest = std::max(largest, term(i));
    }
    return largest;
  });
}

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

/// Returns a block of an array as an Eigen array, whose expressions the compiler vectorises.
template <typename Number>
auto block_of(const Number* values, Index begin, Index end) {
  return Eigen::Map<const Eigen::Array<Number, Eigen::Dynamic, 1>>(values + begin, end - begin);
}

/// Returns the sum of term(blocks...) over blocks of arrays of n numbers, for terms that vectorise:
/// such a term adds the numbers of its block in an order of its own.
template <typename Term, typename... Number>
double sum_over_blocks(Index n, const Term& term, const Number*... values) {
  return deterministic_sum(n, [&](Index begin, Index end) {
    return static_cast<double>(term(block_of(values, begin, end)...));
  });
}

/// Smallest and largest of many numbers; infinity and -infinity for none.
struct Extent {
  double lowest;
  double highest;
};

/// Returns the smallest and the largest of n numbers.
inline Extent extent_over(Index n, const double* values) {
  std::vector<double> lowest(static_cast<std::size_t>((n + kBlock - 1) / kBlock));
  const double highest = parallel_max(n, [&](Index begin, Index end) {
    const auto block = block_of(values, begin, end);
    lowest[static_cast<std::size_t>(begin / kBlock)] = block.minCoeff();
    return block.maxCoeff();
  });
  const auto least = std::min_element(lowest.begin(), lowest.end());
  return {least == lowest.end() ? std::numeric_limits<double>::infinity() : *least, highest};
}

/// Returns the smallest and the largest value of a map.
inline Extent extent_of(const Field& map) { return extent_over(map.size(), map.data()); }

/// Returns whether all values of a map are finite.
inline bool all_finite(const Field& map) {
  const double n_finite = sum_over_blocks(
      map.size(), [](const auto& block) { return block.isFinite().count(); }, map.data());
  return n_finite == static_cast<double>(map.size());
}

}  // namespace tabor
