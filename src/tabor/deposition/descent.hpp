#pragma once

#include <vector>

#include "tabor/deposition/pools.hpp"

// Numbers the pools so that all descendants of a pool follow it, which makes ancestry one
// comparison.
namespace tabor::deposition {

/// Numbers the pools in the order of a walk through the tree of pools, in which all descendants of
/// a pool follow it directly.
class Descent {
 public:
  explicit Descent(const Pools& pools);

  /// Follows Pools::renumber(): pools that have become part of others leave gaps.
  void renumber(const std::vector<PoolId>& renamed, std::size_t count);

  bool within(PoolId inner, PoolId outer) const {
    return first(outer) <= first(inner) && first(inner) < end(outer);
  }
  /// Returns the numbers of a pool and its descendants: [first, end).
  std::int32_t first(PoolId id) const { return first_[static_cast<std::size_t>(id)]; }
  std::int32_t end(PoolId id) const { return end_[static_cast<std::size_t>(id)]; }
  PoolId numbered(std::int32_t first) const { return ids_[static_cast<std::size_t>(first)]; }

 private:
  void walk(const std::vector<PoolId>& child, const std::vector<PoolId>& sibling,
            std::vector<PoolId>& open);

  std::vector<std::int32_t> first_;
  std::vector<std::int32_t> end_;
  std::vector<PoolId> ids_;  ///< by numbers; out of date where a pool has become part of another
};

/// Pools that unite in one parent; finds the child that holds a descendant.
class Children {
 public:
  /// The parent holds no liquid yet: its children are pools of their own.
  Children(const Descent& descent, PoolId parent);

  std::size_t count() const { return ids_.size(); }
  PoolId operator[](std::size_t place) const { return ids_[place]; }
  /// Returns the place of the child that is, or holds, this descendant. In logarithmic time.
  std::size_t holding(PoolId descendant) const;

 private:
  const Descent* descent_;
  std::vector<PoolId> ids_;  ///< ascending in number
};

}  // namespace tabor::deposition
