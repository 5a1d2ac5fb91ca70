#include "tabor/deposition/tie_connector.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "tabor/core/large_pages.hpp"
#include "tabor/core/loops.hpp"
#include "tabor/core/watch.hpp"

namespace tabor::deposition {

TieConnector::TieConnector(Pools& pools)
    : to_(pools),
      into_(pools.count()),
      is_at_rim_(pools.count(), false),
      n_below_rim_(pools.count()),
      n_moved_(pools.count(), 0) {}

void TieConnector::connect() {
  find_ties();
  move_pixels();
  go_on_or_throw();
  move_children();
  put_in_order(to_.number_by_place(to_.count()));
  go_on_or_throw();
  find_bottoms();
}

/// A pool has height if its first pixel is below its rim; one without pixels, which only the ocean
/// can be, is below everything.
void TieConnector::find_ties() {
  for (PoolId id = 0; id < static_cast<PoolId>(to_.count()); ++id) {
    const std::int32_t first = to_.first_arc(id);
    const std::int32_t rim = to_.growth(id).rim;
    std::int32_t end = rim;  // of those below it
    while (end > first && to_.arc(end - 1) == to_.arc(rim)) --end;
    is_at_rim_[place(id)] = end < rim;
    n_below_rim_[place(id)] = end - first;
    into_[place(id)] = end > first || end == rim ? id : to_[id].parent;
  }
}

/// Returns the pool itself, or the first above it that has height.
PoolId TieConnector::with_height(PoolId id) {
  const auto into = [this](PoolId of) -> PoolId& { return into_[place(of)]; };
  while (into(id) != id) id = into(id) = into(into(id));
  return id;
}

void TieConnector::move_pixels() {
  for (auto& site : to_.sites_) {
    if (!is_at_rim_[place(site.pool)]) continue;
    if (site.height < to_.arc(to_.growth(site.pool).rim)) continue;
    site.pool = with_height(to_[site.pool].parent);
    ++n_moved_[place(site.pool)];
  }
}

void TieConnector::move_children() {
  for (Pool& pool : to_.pools_) {
    if (pool.parent != kNoPool) pool.parent = with_height(pool.parent);
  }
  to_.last_ = with_height(to_.last_);
}

/// Joins, for each pool that is left, the pixels from below, its own below its rim, and the rim.
void TieConnector::put_in_order(const Pools::Numbers& numbers) {
  LargeVector<Growth> growth(numbers.count());
  std::int32_t begin = 0;
  for (std::size_t i = 0; i < numbers.count(); ++i) {
    const PoolId old = numbers.before[i];
    const std::int32_t rim = begin + n_moved_[place(old)] + n_below_rim_[place(old)];
    growth[i] = {.next = begin, .rim = rim, .lowest = to_.growth(old).lowest};
    begin = rim + 1;
  }
  LargeVector<Pool> pools(numbers.count());
  LargeVector<Height> arcs(static_cast<std::size_t>(begin));
  for_each(numbers.count(), [&](std::size_t i) {
    const PoolId old = numbers.before[i];
    const auto first = to_.arcs_.begin() + to_.first_arc(old);
    auto next = arcs.begin() + growth[i].next;
    next = std::fill_n(next, n_moved_[place(old)], *first);
    next = std::copy_n(first, n_below_rim_[place(old)], next);
    *next = to_.arc(to_.growth(old).rim);
    pools[i] = {.parent = numbers.of(to_[old].parent)};
  });
  to_.pools_ = std::move(pools);
  to_.growth_ = std::move(growth);
  to_.arcs_ = std::move(arcs);
}

/// A pool whose children have all become parts of it is a leaf; others may have several lowest
/// pixels.
void TieConnector::find_bottoms() {
  std::vector<bool> is_leaf(to_.count(), true);
  for (const Pool& pool : to_.pools_) {
    if (pool.parent != kNoPool) is_leaf[place(pool.parent)] = false;
  }
  bool are_several = false;
  for (PoolId id = 0; id < static_cast<PoolId>(to_.count()); ++id) {
    std::int32_t& lowest = to_.growth_[place(id)].lowest;
    if (is_leaf[place(id)]) {
      lowest = Growth::kNoPlace;
    } else if (const std::int32_t first = to_.first_arc(id); to_.arc(first + 1) == to_.arc(first)) {
      lowest = kSeveral;
      are_several = true;
    }
  }
  if (are_several) list_bottoms();
}

void TieConnector::list_bottoms() {
  std::vector<bool> has_several(to_.count());
  for (std::size_t id = 0; id < to_.count(); ++id) {
    has_several[id] = to_.growth_[id].lowest == kSeveral;
  }
  std::unordered_map<PoolId, std::vector<Pixel>> several;
  for (Pixel p = 0; p < to_.terrain().size(); ++p) {
    const PoolId id = to_.pool_at(p);
    if (!has_several[place(id)]) continue;
    if (to_.height(p) == to_.arc(to_.first_arc(id))) several[id].push_back(p);
  }
  for (const auto& [id, pixels] : several) {
    to_.growth_[place(id)].lowest = ~static_cast<std::int32_t>(to_.saddles_.size());
    to_.saddles_.push_back(static_cast<Pixel>(pixels.size()));
    to_.saddles_.insert(to_.saddles_.end(), pixels.begin(), pixels.end());
  }
}

}  // namespace tabor::deposition
