#include "tabor/deposition/pool_builder.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/core/large_pages.hpp"
#include "tabor/core/loops.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/core/watch.hpp"

namespace tabor::deposition {
namespace {

// Saddles lie anywhere: how many ahead of its turn the memory is asked for one.
constexpr std::size_t kNear = 12;
constexpr std::size_t kFar = 24;

/// Throws InputError where the places of all heights, one a pixel and one a pool, are more than an
/// index of them counts.
void check_places(std::size_t n_places) {
  constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();
  if (n_places <= kMost) return;
  throw InputError("surface to lubricate", std::to_string(n_places) + " pixels and depressions",
                   std::to_string(kMost) + " at most", "take fewer pixels, or smooth the surface");
}

}  // namespace

void PoolBuilder::build() {
  const OneThreadIfSmall limit(to_.terrain().size());
  Basins basins = find_basins(to_.terrain());
  join_basins(basins);
  go_on_or_throw();
  find_pools(std::move(basins.of_pixel));
  go_on_or_throw();
  make_arcs();
}

/// Goes from the lowest saddle to the highest. Releases saddles and bottoms.
void PoolBuilder::join_basins(Basins& basins) {
  sort_by_height(basins.saddles);
  const std::size_t n_leaves = basins.bottoms.size();
  const std::size_t n_most = 2 * n_leaves;  // a merger unites two at least
  reserve_large_pages(tree_.base, n_most);
  reserve_large_pages(tree_.parent, n_most);
  reserve_large_pages(tree_.spills_to, n_most);
  for (const Rank bottom : basins.bottoms) tree_.add(bottom);
  tree_.n_leaves = n_leaves;
  joined_ = numerics::DisjointSets<PoolId>(n_leaves);
  largest_.resize(n_leaves);
  std::iota(largest_.begin(), largest_.end(), 0);
  for (std::size_t i = 0; i < basins.saddles.size(); ++i) {
    go_on_or_throw(i);
    prefetch(basins, i);
    find_sides(basins.saddles[i], basins.of_pixel);
    if (sides_.size() > 1) join_sides(basins.saddles[i]);
  }
  release(basins.saddles);
  release(basins.bottoms);
  joined_ = numerics::DisjointSets<PoolId>();
  release(largest_);
}

/// Asks the memory for what the next saddles need: first heights and basins, the rows above and
/// below, as the neighbours in the row most likely come with the pixel itself; then the sets.
void PoolBuilder::prefetch(const Basins& basins, std::size_t i) const {
  const Terrain& terrain = to_.terrain();
  const auto of_row = [&](Pixel p, Pixel rows) {
    return static_cast<std::size_t>(std::clamp(p + rows * terrain.nx, 0, terrain.size() - 1));
  };
  if (i + kFar < basins.saddles.size()) {
    const Pixel p = pixel_of(basins.saddles[i + kFar]);
    for (const Pixel rows : {0, -1, 1}) {
      __builtin_prefetch(&basins.of_pixel[of_row(p, rows)]);
      __builtin_prefetch(&terrain.height[of_row(p, rows)]);
    }
  }
  if (i + kNear < basins.saddles.size()) {
    const Pixel p = pixel_of(basins.saddles[i + kNear]);
    for (const Pixel rows : {-1, 1}) joined_.prefetch(basins.of_pixel[of_row(p, rows)]);
  }
}

void PoolBuilder::find_sides(Rank saddle, const UnwrittenVector<PoolId>& basin_of) {
  sides_.clear();
  for_each_neighbour(to_.terrain(), pixel_of(saddle), [&](Pixel q) {
    const auto place = static_cast<std::size_t>(q);
    const Rank rank = q == kOutside ? kOceanRank : rank_of(to_.terrain().height[place], q);
    if (rank >= saddle) return;
    const PoolId basin = q == kOutside ? kOcean : basin_of[place];
    const PoolId root = joined_.root(basin);
    const auto known = std::find_if(sides_.begin(), sides_.end(),
                                    [root](const Side& side) { return side.root == root; });
    if (known == sides_.end()) {
      sides_.push_back({root, rank, basin});
    } else if (rank < known->lowest) {
      *known = {root, rank, basin};
    }
  });
}

/// The largest pools on all sides become children of a new one whose lowest pixel is the saddle.
void PoolBuilder::join_sides(Rank saddle) {
  const PoolId joined = tree_.add(saddle);
  PoolId root = sides_.front().root;
  for (const Side& side : sides_) {
    const auto pool = static_cast<std::size_t>(largest_[static_cast<std::size_t>(side.root)]);
    tree_.parent[pool] = joined;
    if (sides_.size() == 2) {
      tree_.spills_to[pool] = (&side == &sides_.front() ? sides_.back() : sides_.front()).basin;
    }
    root = joined_.join(root, side.root).root;
  }
  largest_[static_cast<std::size_t>(root)] = joined;
}

/// Finds the pool of each pixel, and numbers them all by place.
void PoolBuilder::find_pools(UnwrittenVector<PoolId>&& basin_of) {
  const Branches branches(std::move(tree_));
  place_pixels(basin_of, branches);
  go_on_or_throw();
  make_pools(branches, std::move(basin_of));
}

void PoolBuilder::place_pixels(const UnwrittenVector<PoolId>& basin_of, const Branches& branches) {
  const std::vector<Height>& heights = to_.terrain().height;
  to_.sites_.resize(heights.size());
  for_each(to_.terrain().size(), [&](Pixel p) {
    const auto place = static_cast<std::size_t>(p);
    const Height height = heights[place];
    to_.sites_[place] = {height, branches.pool_of(basin_of[place], rank_of(height, p))};
  });
}

/// Pools begin with the height of their lowest pixel as their level.
void PoolBuilder::make_pools(const Branches& branches, UnwrittenVector<PoolId>&& basin_of) {
  to_.last_ = branches.last();
  const Pools::Numbers numbers = to_.number_by_place(branches.count());
  to_.pools_.resize(numbers.count());
  to_.growth_.resize(numbers.count());
  for_each(numbers.count(), [&](std::size_t i) {
    const PoolId before = numbers.before[i];
    const Rank base = branches.base(before);
    to_.pools_[i] = {.parent = numbers.of(branches.parent(before)),
                     .level = height_of(base),
                     .overflow = {.end = numbers.of(branches.spills_to(before))}};
    to_.growth_[i] = {.lowest = pixel_of(base)};
  });
  const auto leaf = [&](PoolId basin) { return numbers.of(branches.leaf_of(basin)); };
  for_each(static_cast<PoolId>(branches.n_leaves()),
           [&](PoolId basin) { growth(leaf(basin)).lowest = Growth::kNoPlace; });
  to_.drains_to_ = std::move(basin_of);
  for_each(to_.terrain().size(), [&](Pixel p) {
    PoolId& drains_to = to_.drains_to_[static_cast<std::size_t>(p)];
    drains_to = leaf(drains_to);
  });
}

/// Puts all heights in their places, those of each pool in order.
void PoolBuilder::make_arcs() {
  check_places(to_.sites_.size() + to_.pools_.size());
  std::vector<std::int32_t> next(to_.count(), 0);  // place for a pixel of each pool
  for (std::size_t p = 0; p < to_.sites_.size(); ++p) {
    go_on_or_throw(p);
    ++next[static_cast<std::size_t>(to_.sites_[p].pool)];
  }
  std::int32_t begin = 0;
  for (std::size_t id = 0; id < next.size(); ++id) {
    const std::int32_t n = std::exchange(next[id], begin);
    to_.growth_[id].rim = begin + n;
    begin += n + 1;
  }
  to_.arcs_.resize(static_cast<std::size_t>(begin));
  if (lists_pixels_) to_.listed_.resize(to_.arcs_.size());
  const auto count = static_cast<Index>(to_.count());
  parallel_for(count, count / thread_count() + 1, [&](Index first, Index end) {
    fill_arcs(static_cast<PoolId>(first), static_cast<PoolId>(end), next);
  });
  sort_arcs();
}

/// Fills the pools [first, end): each thread goes through all pixels for its part of the pools.
void PoolBuilder::fill_arcs(PoolId first, PoolId end, std::vector<std::int32_t>& next) {
  for (std::size_t p = 0; p < to_.sites_.size(); ++p) {
    go_on_or_throw(p);
    const auto& site = to_.sites_[p];
    if (site.pool < first || site.pool >= end) continue;
    const auto place = static_cast<std::size_t>(next[static_cast<std::size_t>(site.pool)]++);
    to_.arcs_[place] = site.height;
    if (lists_pixels_) to_.listed_[place] = static_cast<Pixel>(p);
  }
}

/// Sorts small pools side by side, and each large one on all threads.
void PoolBuilder::sort_arcs() {
  constexpr Index kPoolsOfBlock = 256;
  const auto is_large = [this](PoolId id) {
    const auto [begin, end] = to_.places_of(id);
    return static_cast<std::size_t>(end - begin) > kFewRanks;
  };
  const auto count = static_cast<PoolId>(to_.count());
  for_each(
      count,
      [&](PoolId id) {
        if (!is_large(id)) finish_arcs(id);
      },
      kPoolsOfBlock);
  for (PoolId id = 0; id < count; ++id) {
    if (is_large(id)) finish_arcs(id);
  }
}

void PoolBuilder::finish_arcs(PoolId id) {
  const Pools::Places places = to_.places_of(id);
  const auto begin = static_cast<std::size_t>(places.begin);
  const auto end = static_cast<std::size_t>(places.end);
  if (!lists_pixels_) {
    sort_heights(std::span(to_.arcs_).subspan(begin, end - begin));
  } else if (end - begin > kFewRanks) {
    std::vector<Rank> ranks;
    sort_listed(begin, end, ranks);
  } else {
    thread_local std::vector<Rank> ranks;
    sort_listed(begin, end, ranks);
  }
  const PoolId parent = to_[id].parent;
  to_.arcs_[end] = parent == kNoPool ? kNoRim : to_[parent].level;
}

/// Sorts heights and pixels at these places together.
void PoolBuilder::sort_listed(std::size_t begin, std::size_t end, std::vector<Rank>& ranks) {
  ranks.clear();
  for (std::size_t i = begin; i < end; ++i) ranks.push_back(rank_of(to_.arcs_[i], to_.listed_[i]));
  sort_by_height(ranks);
  for (std::size_t i = begin; i < end; ++i) {
    to_.arcs_[i] = height_of(ranks[i - begin]);
    to_.listed_[i] = pixel_of(ranks[i - begin]);
  }
}

}  // namespace tabor::deposition
