#include "tabor/deposition/pools.hpp"

#include <algorithm>

#include "tabor/core/large_pages.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/deposition/pool_builder.hpp"
#include "tabor/deposition/tie_connector.hpp"

namespace tabor::deposition {

Pools::Pools(const Terrain& terrain, Ties ties, bool lists_pixels) : terrain_(&terrain) {
  PoolBuilder(*this, lists_pixels).build();
  if (ties == Ties::connected) {
    connect_ties();
  } else {
    remove_liquid();
  }
}

void Pools::connect_ties() {
  release(drains_to_);
  release(listed_);
  TieConnector(*this).connect();
  remove_liquid();
}

/// Leaves hold liquid from the start; all other pools wait for their children. A leaf without
/// height is full at once, and so may be what it becomes part of: which are leaves is said before
/// the first begins.
void Pools::remove_liquid() {
  const bool has_ocean = terrain_->edge == Edge::open;
  const auto count = static_cast<PoolId>(pools_.size());
  parallel_for(count, kBlock, [&](Index begin, Index end) {
    for (auto id = static_cast<PoolId>(begin); id < end; ++id) {
      Growth& growth = growth_[static_cast<std::size_t>(id)];
      growth.open_children = 0;
      growth.next = first_arc(id);
      Pool& pool = pools_[static_cast<std::size_t>(id)];
      pool = {.parent = pool.parent, .owner = id, .overflow = pool.overflow};
    }
  });
  for (const Pool& child : pools_) {
    if (child.parent != kNoPool) ++growth_[static_cast<std::size_t>(child.parent)].open_children;
  }
  std::vector<PoolId> leaves;
  for (PoolId id = has_ocean ? kOcean + 1 : 0; id < count; ++id) {
    if (waits(id)) continue;
    pools_[static_cast<std::size_t>(id)].level = arc(growth(id).next);
    leaves.push_back(id);
  }
  if (has_ocean) pools_[kOcean].area = 1;  // a droplet raises it by its own volume
  n_filling_ = static_cast<PoolId>(leaves.size());
  beyond_ = 0;
  closed_.clear();
  changed_.clear();
  for (const PoolId leaf : leaves) take_in(leaf);
}

/// Numbers n pools in the order in which a walk along the rows meets them, so that pools of
/// neighbouring pixels are neighbours in memory; those without pixels vanish. The pixels get the
/// new numbers at once; the pools are still to be put in order.
Pools::Numbers Pools::number_by_place(std::size_t n) {
  Numbers numbers{.now = std::vector<PoolId>(n, kNoPool), .before = {}};
  numbers.before.reserve(n);
  const auto number = [&numbers](PoolId old) {
    PoolId& now = numbers.now[static_cast<std::size_t>(old)];
    if (now == kNoPool) {
      now = static_cast<PoolId>(numbers.before.size());
      numbers.before.push_back(old);
    }
    return now;
  };
  if (terrain_->edge == Edge::open) number(kOcean);
  for (Site& site : sites_) site.pool = number(site.pool);
  last_ = numbers.of(last_);
  return numbers;
}

void Pools::shorten(PoolId id, PoolId root) {
  while (id != root) {
    const PoolId up = step_up(id);
    pools_[static_cast<std::size_t>(id)].owner = root;
    id = up;
  }
}

Volume Pools::pour(PoolId id, Volume carried) {
  Pool& pool = pools_[static_cast<std::size_t>(id)];
  while (pool.stop != kNoRim) {
    const Volume space = (Volume{pool.stop} - pool.level) * pool.area - pool.remainder;
    if (carried < space) {
      const Volume total = pool.remainder + carried;
      const Volume rise = total / pool.area;
      pool.level += static_cast<Height>(rise);
      pool.remainder = static_cast<std::int32_t>(total - rise * pool.area);
      return 0;
    }
    carried -= space;
    pool.level = pool.stop;
    pool.remainder = 0;
    take_in(id);
    if (pool.full() || carried == 0) return carried;
  }
  beyond_ += carried;
  return 0;
}

Volume Pools::raise(PoolId id, Height rise) {
  Pool& pool = pools_[static_cast<std::size_t>(id)];
  if (pool.stop == kNoRim) {
    beyond_ += Volume{rise} * pool.area;
    return Volume{rise} * pool.area;
  }
  const Volume climb = std::min<Volume>(rise, Volume{pool.stop} - pool.level);
  const Volume volume = climb * pool.area;
  pool.level = static_cast<Height>(pool.level + climb);
  if (pool.level == pool.stop) take_in(id);
  return volume;
}

Volume Pools::volume_to(PoolId id, Height level) const {
  const Pool& pool = (*this)[id];
  Volume volume = -pool.remainder;
  Volume area = pool.area;
  Height reached = pool.level;
  const std::int32_t rim = growth(id).rim;
  std::int32_t next = growth(id).next;
  for (Height stop = pool.stop; stop != kNoRim; stop = arc(next)) {
    const Height to = std::min(stop, level);
    volume += (Volume{to} - reached) * area;
    if (to == level || next == rim) return volume;
    reached = stop;
    for (; next < rim && arc(next) == stop; ++next) ++area;
  }
  return volume + 1;
}

/// The pool `id` has risen to its stop, or begins: takes in the pixels there. If it is full then
/// and the last of its siblings to be so, their parent begins (several times where arcs have no
/// height, as they may with ordered ties).
void Pools::take_in(PoolId id) {
  while (true) {
    Pool& pool = pools_[static_cast<std::size_t>(id)];
    Growth& growth = growth_[static_cast<std::size_t>(id)];
    std::int32_t next = growth.next;
    while (next < growth.rim && arc(next) == pool.level) ++next;
    pool.area += next - growth.next;
    growth.next = next;
    pool.stop = arc(next);
    if (!pool.full() || !fill_up(id)) return;
    id = pool.parent;
  }
}

/// The pool `id` is full and becomes part of its parent; true if that one begins.
bool Pools::fill_up(PoolId id) {
  const Pool& pool = (*this)[id];
  Pool& parent = pools_[static_cast<std::size_t>(pool.parent)];
  Growth& of_parent = growth_[static_cast<std::size_t>(pool.parent)];
  parent.area += pool.area;
  --n_filling_;
  if (of_parent.lowest < 0) changed_.push_back(pool.parent);
  if (--of_parent.open_children > 0) {
    if (of_parent.lowest < 0) closed_.push_back(id);
    return false;
  }
  parent.level = pool.level;
  ++n_filling_;
  return true;
}

std::span<const Pixel> Pools::bottom(PoolId id) const {
  const std::int32_t& lowest = growth(id).lowest;
  if (lowest >= 0) return {&lowest, 1};
  const std::int32_t place = ~lowest;
  const Pixel* const listed = &saddles_[static_cast<std::size_t>(place)];
  return {listed + 1, static_cast<std::size_t>(*listed)};
}

std::vector<PoolId> Pools::renumber() {
  const auto n_before = static_cast<PoolId>(pools_.size());
  std::vector<PoolId> renamed(pools_.size(), kNoPool);
  const auto new_number = [&](PoolId id) -> PoolId& {
    return renamed[static_cast<std::size_t>(id)];
  };
  PoolId n_kept = 0;
  for (PoolId id = 0; id < n_before; ++id) {
    if (owner(id) == id) new_number(id) = n_kept++;
  }
  for (PoolId id = 0; id < n_before; ++id) new_number(id) = new_number(owner(id));
  for (PoolId id = 0; id < n_before; ++id) {
    if (const Pool& old = (*this)[id]; old.owner == id) {
      Pool pool = old;
      pool.owner = new_number(id);
      pool.parent = pool.parent == kNoPool ? kNoPool : new_number(pool.parent);
      pool.overflow.end = new_number(pool.overflow.end);
      const auto place = static_cast<std::size_t>(pool.owner);  // never behind the old one
      pools_[place] = pool;
      growth_[place] = growth(id);
    }
  }
  pools_.resize(static_cast<std::size_t>(n_kept));
  give_back_unused(pools_);
  growth_.resize(static_cast<std::size_t>(n_kept));
  give_back_unused(growth_);
  closed_.clear();
  changed_.clear();
  parallel_for(static_cast<Index>(sites_.size()), kBlock, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      PoolId& pool = sites_[static_cast<std::size_t>(i)].pool;
      pool = new_number(pool);
    }
  });
  last_ = new_number(last_);
  return renamed;
}

bool Pools::replete() const {
  return terrain_->edge == Edge::open ? n_filling_ == 0
                                      : (*this)[last_].stop == kNoRim && (*this)[last_].active();
}

}  // namespace tabor::deposition
