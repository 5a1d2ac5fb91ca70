#include "tabor/deposition/pool_builder.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/large_pages.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/core/watch.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>

namespace tabor::deposition {
namespace {

// Pixels in order of height lie anywhere: how many ahead of its turn one is asked of the memory.
constexpr std::size_t kNear = 16;
constexpr std::size_t kFar = 24;

constexpr std::size_t kDigits = 2048;    // of a pass of the radix sort
constexpr Index kBlockOfKeys = 1 << 20;  // that one thread sorts

/// Stable sort of `keys` by bits [shift, shift + 11), from `keys` to `sorted`. Blocks of keys are
/// counted, and then moved, side by side.
void radix_pass(const std::vector<std::uint64_t>& keys, std::vector<std::uint64_t>& sorted,
                int shift) {
  const auto n = static_cast<Index>(keys.size());
  const auto digit = [&](Index i) {
    return (keys[static_cast<std::size_t>(i)] >> shift) & (kDigits - 1);
  };
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

/// Throws InputError where the places of all heights, one a pixel and one a pool, are more than an
/// index of them counts.
void check_places(std::size_t n_places) {
  constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();
  if (n_places <= kMost) return;
  throw InputError("surface to lubricate", std::to_string(n_places) + " pixels and depressions",
                   std::to_string(kMost) + " at most", "take fewer pixels, or smooth the surface");
}

/// Pixels without a lower neighbour, equal heights by pixel number: each begins a pool.
std::size_t count_minima(const Terrain& terrain) {
  const auto is_lower = [&](Pixel q, Pixel p) {
    const Height height_q = terrain.height[static_cast<std::size_t>(q)];
    const Height height_p = terrain.height[static_cast<std::size_t>(p)];
    return height_q < height_p || (height_q == height_p && q < p);
  };
  const auto count = [&](Index begin, Index end) {
    double n = 0;
    for (auto p = static_cast<Pixel>(begin); p < end; ++p) {
      bool is_minimum = true;
      for_each_neighbour(terrain, p, [&](Pixel q) {
        is_minimum = is_minimum && q != kOutside && !is_lower(q, p);
      });
      n += is_minimum ? 1 : 0;
    }
    return n;
  };
  return static_cast<std::size_t>(deterministic_sum(terrain.size(), count));
}

}  // namespace

std::vector<Pixel> ascending_pixels(const Terrain& terrain) {
  const auto n = static_cast<std::size_t>(terrain.size());
  std::vector<std::uint64_t> keys;
  reserve_large_pages(keys, n);
  keys.resize(n);
  parallel_for(terrain.size(), kBlock, [&](Index begin, Index end) {
    for (auto p = static_cast<std::size_t>(begin); p < static_cast<std::size_t>(end); ++p) {
      const auto unsigned_height = static_cast<std::uint32_t>(terrain.height[p]) ^ 0x80000000U;
      keys[p] = (std::uint64_t{unsigned_height} << 32) | p;
    }
  });
  {
    std::vector<std::uint64_t> sorted;
    reserve_large_pages(sorted, n);
    sorted.resize(n);
    for (const int shift : {32, 43, 54}) {  // pixel numbers, the low half, are in order already
      go_on_or_throw();
      radix_pass(keys, sorted, shift);
      keys.swap(sorted);
    }
  }
  std::vector<Pixel> order(n);
  std::transform(keys.begin(), keys.end(), order.begin(),
                 [](std::uint64_t key) { return static_cast<Pixel>(key & 0xFFFFFFFFU); });
  return order;
}

void PoolBuilder::build() {
  const Terrain& terrain = to_.terrain();
  std::vector<Pixel> ascending = ascending_pixels(terrain);
  reserve_large_pages(to_.sites_, ascending.size());
  to_.sites_.resize(ascending.size());
  parallel_for(terrain.size(), kBlock, [&](Index begin, Index end) {
    for (auto p = static_cast<std::size_t>(begin); p < static_cast<std::size_t>(end); ++p) {
      to_.sites_[p].height = terrain.height[p];
    }
  });
  const std::size_t n_most = 2 * count_minima(terrain) + 1;  // a merger unites two at least
  reserve_large_pages(to_.pools_, n_most);
  reserve_large_pages(to_.growth_, n_most);
  reserve_large_pages(into_, n_most);
  if (terrain.edge == Edge::open) new_pool(kDry);  // the ocean
  for (std::size_t i = 0; i < ascending.size(); ++i) {
    go_on_or_throw(i);
    prefetch_neighbours(ascending, i + kFar);
    add(ascending[i]);
  }
  to_.last_ = grown(pool_at(0));
  release(into_);
  go_on_or_throw();
  const std::vector<PoolId> number = to_.number_by_place();
  to_.growth_ = in_order(to_.growth_, number, to_.count());
  go_on_or_throw();
  make_arcs(ascending);
}

PoolId PoolBuilder::grown(PoolId id) {
  const auto into = [this](PoolId of) -> PoolId& { return into_[static_cast<std::size_t>(of)]; };
  while (into(id) != id) id = into(id) = into(into(id));
  return id;
}

PoolId PoolBuilder::new_pool(Height base) {
  const auto id = static_cast<PoolId>(to_.pools_.size());
  Pool& added = to_.pools_.emplace_back();
  added.level = base;
  into_.push_back(id);
  to_.growth_.emplace_back();
  return id;
}

void PoolBuilder::prefetch_site(const std::vector<Pixel>& ascending, std::size_t place) const {
  if (place < ascending.size()) {
    __builtin_prefetch(&to_.sites_[static_cast<std::size_t>(ascending[place])]);
  }
}

/// The rows above and below; the neighbours in the row most likely come with the pixel itself.
void PoolBuilder::prefetch_neighbours(const std::vector<Pixel>& ascending,
                                      std::size_t place) const {
  if (place >= ascending.size()) return;
  const Pixel p = ascending[place];
  const Pixel nx = to_.terrain().nx;
  for (const Pixel q : {p, std::max(p - nx, 0), std::min(p + nx, to_.terrain().size() - 1)}) {
    __builtin_prefetch(&to_.sites_[static_cast<std::size_t>(q)]);
  }
}

void PoolBuilder::add(Pixel p) {
  const Height height = to_.height(p);
  meeting_.clear();
  PoolId last = kNoPool;  // most neighbours are in one pool
  for_each_neighbour(to_.terrain(), p, [&](Pixel q) {
    const PoolId at = q == kOutside ? kOcean : pool_at(q);
    if (at == kNoPool || at == last) return;
    last = at;
    const PoolId top = grown(at);
    if (std::find(meeting_.begin(), meeting_.end(), top) == meeting_.end()) meeting_.push_back(top);
  });
  if (meeting_.empty()) {
    pool_at(p) = new_pool(height);
  } else {
    pool_at(p) = meeting_.size() == 1 ? meeting_.front() : merge(height);
  }
}

/// The pools in meeting_ become children of a new one whose lowest pixel is at `base`.
PoolId PoolBuilder::merge(Height base) {
  const PoolId into = new_pool(base);
  for (const PoolId id : meeting_) {
    pool(id).parent = into_[static_cast<std::size_t>(id)] = into;
    ++growth(into).open_children;
  }
  return into;
}

void PoolBuilder::make_arcs(const std::vector<Pixel>& ascending) {
  check_places(to_.sites_.size() + to_.pools_.size());
  for (const auto& site : to_.sites_) ++growth(site.pool).next;
  std::int32_t begin = 0;
  for (Growth& each : to_.growth_) {
    each.rim = begin + each.next;
    each.next = std::exchange(begin, each.rim + 1);
  }
  const auto n_places = static_cast<std::size_t>(begin);
  reserve_large_pages(to_.arcs_, n_places);
  to_.arcs_.resize(n_places);
  fill_arcs(ascending);
  for (std::size_t id = 0; id < to_.pools_.size(); ++id) {
    const PoolId parent = to_.pools_[id].parent;
    to_.arcs_[static_cast<std::size_t>(to_.growth_[id].rim)] =
        parent == kNoPool ? kNoRim : pool(parent).level;
  }
}

/// Puts all heights in their places and finds the lowest pixels of all pools but leaves.
void PoolBuilder::fill_arcs(const std::vector<Pixel>& ascending) {
  for (std::size_t i = 0; i < ascending.size(); ++i) {
    go_on_or_throw(i);
    prefetch_site(ascending, i + kNear);
    const Pixel p = ascending[i];
    const auto& site = to_.sites_[static_cast<std::size_t>(p)];
    Growth& at = growth(site.pool);
    to_.arcs_[static_cast<std::size_t>(at.next++)] = site.height;
    const bool is_saddle = at.open_children > 0 && at.lowest == Growth::kNoPlace;
    if (is_saddle) at.lowest = p;
  }
}

}  // namespace tabor::deposition
