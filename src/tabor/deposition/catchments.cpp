#include "tabor/deposition/catchments.hpp"

#include "tabor/core/watch.hpp"

namespace tabor::deposition {

Catchments::Catchments(Pools& pools) : pools_(pools) {
  std::vector<std::int32_t> area(pools.count(), 0);
  for (Pixel p = 0; p < pools.terrain().size(); ++p) {
    go_on_or_throw(static_cast<std::size_t>(p));
    ++area[static_cast<std::size_t>(pools.drains_to(p))];
  }
  for (std::size_t leaf = 0; leaf < area.size(); ++leaf) {
    if (area[leaf] > 0) sources_.push_back({static_cast<PoolId>(leaf), area[leaf]});
  }
}

Rank Catchments::rank(Pixel p) const {
  return p == kOutside ? kOceanRank : rank_of(pools_.height(p), p);
}

void Catchments::drain(const std::vector<Volume>& liquid) {
  std::vector<Volume> carried(pools_.count(), 0);
  for (std::size_t p = 0; p < liquid.size(); ++p) {
    go_on_or_throw(p);
    carried[static_cast<std::size_t>(pools_.drains_to(static_cast<Pixel>(p)))] += liquid[p];
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
    const PoolId known = pools_[pool].overflow.end;
    pool = pools_.owner(known == kNoPool ? across_saddle(pool) : known);
  }
  for (const PoolId full : passed_) pools_.remember_overflow(full, {pool});
  return pool;
}

/// Over the saddle pixel to its lowest neighbour in a pool that is not full yet.
PoolId Catchments::across_saddle(PoolId full) {
  const Pixel saddle = pools_.saddle(full);
  Pixel lowest = saddle;
  for_each_neighbour(pools_.terrain(), saddle, [&](Pixel q) {
    if (rank(q) < rank(lowest)) {
      const PoolId pool = q == kOutside ? kOcean : pools_.owner(pools_.pool_at(q));
      const bool is_full = pools_[pool].full() && pools_[pool].parent == pools_[full].parent;
      lowest = is_full ? lowest : q;
    }
  });
  return lowest == kOutside ? kOcean : pools_.drains_to(lowest);
}

}  // namespace tabor::deposition
