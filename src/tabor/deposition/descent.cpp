#include "tabor/deposition/descent.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "tabor/core/watch.hpp"

namespace tabor::deposition {

Descent::Descent(const Pools& pools)
    : first_(pools.count()), end_(pools.count()), ids_(pools.count()) {
  const auto n = static_cast<PoolId>(pools.count());
  std::vector<PoolId> child(pools.count(), kNoPool);
  std::vector<PoolId> sibling(pools.count(), kNoPool);
  std::vector<PoolId> open;
  for (PoolId id = 0; id < n; ++id) {
    const PoolId parent = pools[id].parent;
    PoolId& head =
        parent == kNoPool ? open.emplace_back(id) : child[static_cast<std::size_t>(parent)];
    if (parent != kNoPool) {
      sibling[static_cast<std::size_t>(id)] = head;
      head = id;
    }
  }
  walk(child, sibling, open);
}

void Descent::walk(const std::vector<PoolId>& child, const std::vector<PoolId>& sibling,
                   std::vector<PoolId>& open) {
  const auto place = [](PoolId id) { return static_cast<std::size_t>(id); };
  std::int32_t count = 0;
  while (!open.empty()) {
    const PoolId id = open.back();
    if (id < 0) {  // the complement: all descendants have been numbered
      end_[place(~id)] = count;
      open.pop_back();
      continue;
    }
    go_on_or_throw(static_cast<std::size_t>(count));
    ids_[place(count)] = id;
    first_[place(id)] = count++;
    open.back() = ~id;
    for (PoolId next = child[place(id)]; next != kNoPool; next = sibling[place(next)]) {
      open.push_back(next);
    }
  }
}

/// A pool that has become part of another is its descendant: the other has the first of all their
/// numbers, and the last end.
void Descent::renumber(const std::vector<PoolId>& renamed, std::size_t count) {
  std::vector<std::int32_t> first(count, std::numeric_limits<std::int32_t>::max());
  std::vector<std::int32_t> end(count, 0);
  for (std::size_t old = 0; old < renamed.size(); ++old) {
    const auto now = static_cast<std::size_t>(renamed[old]);
    first[now] = std::min(first[now], first_[old]);
    end[now] = std::max(end[now], end_[old]);
  }
  for (std::size_t now = 0; now < count; ++now) {
    ids_[static_cast<std::size_t>(first[now])] = static_cast<PoolId>(now);
  }
  first_ = std::move(first);
  end_ = std::move(end);
}

Children::Children(const Descent& descent, PoolId parent) : descent_(&descent) {
  for (std::int32_t number = descent.first(parent) + 1; number < descent.end(parent);) {
    ids_.push_back(descent.numbered(number));
    number = descent.end(ids_.back());
  }
}

std::size_t Children::holding(PoolId descendant) const {
  const auto after = std::upper_bound(
      ids_.begin(), ids_.end(), descent_->first(descendant),
      [&](std::int32_t number, PoolId child) { return number < descent_->first(child); });
  return static_cast<std::size_t>(after - ids_.begin()) - 1;
}

}  // namespace tabor::deposition
