#include "tabor/deposition/tie_connector.hpp"

#include <unordered_map>
#include <utility>

#include "tabor/core/large_pages.hpp"
#include "tabor/core/watch.hpp"

namespace tabor::deposition {

TieConnector::TieConnector(Pools& pools)
    : to_(pools), into_(pools.count()), n_moved_(pools.count(), 0) {
  for (PoolId id = 0; id < static_cast<PoolId>(pools.count()); ++id) {
    into_[place(id)] = has_height(id) ? id : pools[id].parent;
  }
}

void TieConnector::connect() {
  move_pixels();
  go_on_or_throw();
  move_children();
  make_arcs(to_.number_by_place());
  go_on_or_throw();
  find_bottoms();
}

/// True for a pool without pixels, too, which only the ocean can be: it is below everything.
bool TieConnector::has_height(PoolId id) const {
  const std::int32_t first = to_.first_arc(id);
  const std::int32_t rim = to_.growth(id).rim;
  return first == rim || to_.arc(first) < to_.arc(rim);
}

/// Returns the pool itself, or the first above it that has height.
PoolId TieConnector::with_height(PoolId id) {
  const auto into = [this](PoolId of) -> PoolId& { return into_[place(of)]; };
  while (into(id) != id) id = into(id) = into(into(id));
  return id;
}

void TieConnector::move_pixels() {
  for (auto& site : to_.sites_) {
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
void TieConnector::make_arcs(const std::vector<PoolId>& number) {
  std::vector<PoolId> old(to_.count(), kNoPool);
  for (std::size_t id = 0; id < number.size(); ++id) {
    if (number[id] != kNoPool) old[place(number[id])] = static_cast<PoolId>(id);
  }
  std::vector<Growth> growth(to_.count());
  std::vector<Height> arcs;
  reserve_large_pages(arcs, to_.sites_.size() + to_.count());
  for (std::size_t i = 0; i < old.size(); ++i) {
    std::int32_t next = to_.first_arc(old[i]);
    const std::int32_t rim = to_.growth(old[i]).rim;
    arcs.insert(arcs.end(), static_cast<std::size_t>(n_moved_[place(old[i])]), to_.arc(next));
    for (; next < rim && to_.arc(next) < to_.arc(rim); ++next) arcs.push_back(to_.arc(next));
    growth[i].rim = static_cast<std::int32_t>(arcs.size());
    growth[i].lowest = to_.growth(old[i]).lowest;
    arcs.push_back(to_.arc(rim));
  }
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
  std::unordered_map<PoolId, std::vector<Pixel>> several;
  for (Pixel p = 0; p < to_.terrain().size(); ++p) {
    const PoolId id = to_.pool_at(p);
    const bool is_one =
        to_.growth(id).lowest == kSeveral && to_.height(p) == to_.arc(to_.first_arc(id));
    if (is_one) several[id].push_back(p);
  }
  for (const auto& [id, pixels] : several) {
    to_.growth_[place(id)].lowest = ~static_cast<std::int32_t>(to_.saddles_.size());
    to_.saddles_.push_back(static_cast<Pixel>(pixels.size()));
    to_.saddles_.insert(to_.saddles_.end(), pixels.begin(), pixels.end());
  }
}

}  // namespace tabor::deposition
