#include "tabor/deposition/ranks.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "tabor/core/large_pages.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/core/watch.hpp"

namespace tabor::deposition {
namespace {

constexpr std::size_t kDigits = 2048;    // of a pass of the radix sort
constexpr Index kBlockOfKeys = 1 << 20;  // that one thread sorts

/// Stable sort by digit_of(key), from `keys` to `sorted`. Blocks of keys are counted, and then
/// moved, side by side.
template <typename Key, typename DigitOf>
void radix_pass(std::span<const Key> keys, std::span<Key> sorted, const DigitOf& digit_of) {
  const auto n = static_cast<Index>(keys.size());
  const auto digit = [&](Index i) { return digit_of(keys[static_cast<std::size_t>(i)]); };
  const auto block = [](Index i) { return static_cast<std::size_t>(i / kBlockOfKeys); };
  std::vector<std::array<std::uint32_t, kDigits>> start(block(n) + 1);
  parallel_for(n, kBlockOfKeys, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) ++start[block(i)][digit(i)];
  });
  std::uint32_t total = 0;
  for (std::size_t d = 0; d < kDigits; ++d) {
    for (auto& of_block : start) total += std::exchange(of_block[d], total);
  }
  parallel_for(n, kBlockOfKeys, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      sorted[start[block(i)][digit(i)]++] = keys[static_cast<std::size_t>(i)];
    }
  });
}

/// Stable sort by a whole number of 32 bits.
template <typename Key, typename NumberOf>
void radix_sort(std::vector<Key>& keys, const NumberOf& number_of) {
  std::vector<Key> sorted;
  reserve_large_pages(sorted, keys.size());
  sorted.resize(keys.size());
  for (const int shift : {0, 11, 22}) {
    go_on_or_throw();
    radix_pass<Key>(keys, sorted,
                    [&](Key key) { return (number_of(key) >> shift) & (kDigits - 1); });
    keys.swap(sorted);
  }
}

}  // namespace

void sort_by_height(std::vector<Rank>& ranks) {
  if (ranks.size() <= kFewRanks) {
    std::sort(ranks.begin(), ranks.end());
    return;
  }
  radix_sort(ranks, [](Rank rank) { return static_cast<std::uint32_t>(rank >> 32); });
}

void sort_heights(std::span<Height> heights) {
  if (heights.size() <= kFewRanks) {
    std::sort(heights.begin(), heights.end());
    return;
  }
  std::vector<Height> sorted(heights.begin(), heights.end());
  radix_sort(sorted,
             [](Height height) { return static_cast<std::uint32_t>(height) ^ 0x80000000U; });
  std::copy(sorted.begin(), sorted.end(), heights.begin());
}

std::vector<Pixel> ascending_pixels(const Terrain& terrain) {
  const auto n = static_cast<std::size_t>(terrain.size());
  std::vector<Rank> ranks;
  reserve_large_pages(ranks, n);
  ranks.resize(n);
  parallel_for(terrain.size(), kBlock, [&](Index begin, Index end) {
    for (auto p = static_cast<Pixel>(begin); p < end; ++p) {
      const auto i = static_cast<std::size_t>(p);
      ranks[i] = rank_of(terrain.height[i], p);
    }
  });
  sort_by_height(ranks);
  std::vector<Pixel> order(n);
  std::transform(ranks.begin(), ranks.end(), order.begin(), pixel_of);
  return order;
}

}  // namespace tabor::deposition
