#include "tabor/deposition/catchments.hpp"

#include "tabor/core/rows.hpp"
#include "tabor/core/watch.hpp"

namespace tabor::deposition {

Catchments::Catchments(Pools& pools)
    : pools_(pools),
      drains_to_(static_cast<std::size_t>(pools.terrain().size()), kNoPool),
      runs_to_(pools.count(), kNoPool) {
  drain_all();
  std::vector<std::int32_t> area(pools.count(), 0);
  for (const PoolId leaf : drains_to_) ++area[static_cast<std::size_t>(leaf)];
  for (std::size_t leaf = 0; leaf < area.size(); ++leaf) {
    if (area[leaf] > 0) sources_.push_back({static_cast<PoolId>(leaf), area[leaf]});
  }
}

/// Order of height, pixel numbers breaking ties; beyond an open edge lies the lowest place.
bool Catchments::lower(Pixel a, Pixel b) const {
  if (a == kOutside || b == kOutside) return a == kOutside && b != kOutside;
  const Height height_a = pools_.height(a);
  const Height height_b = pools_.height(b);
  return height_a < height_b || (height_a == height_b && a < b);
}

/// The lowest neighbour if it is lower than p, else p itself.
Pixel Catchments::downhill(Pixel p) const {
  Pixel lowest = p;
  for_each_neighbour(pools_.terrain(), p, [&](Pixel q) {
    if (lower(q, lowest)) lowest = q;
  });
  return lowest;
}

/// First one step for each pixel, stored as the complement of the next one, then all steps.
void Catchments::drain_all() {
  const Terrain& terrain = pools_.terrain();
  const auto drains_to = [this](Pixel p) -> PoolId& {
    return drains_to_[static_cast<std::size_t>(p)];
  };
  for_each_row(terrain.ny, [&](Index row) {
    for (auto p = static_cast<Pixel>(row * terrain.nx), end = p + terrain.nx; p < end; ++p) {
      const Pixel next = downhill(p);
      drains_to(p) = next == kOutside ? kOcean : next == p ? pools_.pool_at(p) : ~next;
    }
  });
  std::vector<Pixel> path;
  for (Pixel start = 0; start < terrain.size(); ++start) {
    go_on_or_throw(static_cast<std::size_t>(start));
    path.clear();
    Pixel p = start;
    for (; drains_to(p) < 0; p = ~drains_to(p)) path.push_back(p);
    for (const Pixel passed : path) drains_to(passed) = drains_to(p);
  }
}

void Catchments::drain(const std::vector<Volume>& liquid) {
  std::vector<Volume> carried(pools_.count(), 0);
  for (std::size_t p = 0; p < liquid.size(); ++p) {
    go_on_or_throw(p);
    carried[static_cast<std::size_t>(drains_to_[p])] += liquid[p];
  }
  for (std::size_t pool = 0; pool < carried.size(); ++pool) {
    go_on_or_throw(pool);
    pour(static_cast<PoolId>(pool), carried[pool]);
  }
}

/// Pours into the first pool that is not full, and into those it overflows to.
void Catchments::pour(PoolId first, Volume carried) {
  while (carried > 0) {
    first = overflow(first);
    carried = pools_.pour(first, carried);
  }
}

/// With path compression: as long as a pool is full and apart, what it spills into is full and
/// apart too, or merges with it.
PoolId Catchments::overflow(PoolId pool) {
  passed_.clear();
  pool = pools_.owner(pool);
  while (pools_[pool].full()) {
    passed_.push_back(pool);
    const PoolId known = runs_to_[static_cast<std::size_t>(pool)];
    pool = pools_.owner(known == kNoPool ? across_saddle(pool) : known);
  }
  for (const PoolId full : passed_) runs_to_[static_cast<std::size_t>(full)] = pool;
  return pool;
}

/// Over the saddle pixel to its lowest neighbour in a pool that is not full yet.
PoolId Catchments::across_saddle(PoolId full) {
  const Pixel saddle = pools_.saddle(full);
  Pixel lowest = saddle;
  for_each_neighbour(pools_.terrain(), saddle, [&](Pixel q) {
    if (lower(q, lowest)) {
      const PoolId pool = q == kOutside ? kOcean : pools_.owner(pools_.pool_at(q));
      const bool is_full = pools_[pool].full() && pools_[pool].parent == pools_[full].parent;
      lowest = is_full ? lowest : q;
    }
  });
  return lowest == kOutside ? kOcean : drains_to_[static_cast<std::size_t>(lowest)];
}

}  // namespace tabor::deposition
