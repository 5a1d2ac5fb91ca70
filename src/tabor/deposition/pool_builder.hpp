#pragma once

#include <vector>

#include "tabor/deposition/basins.hpp"
#include "tabor/deposition/branches.hpp"
#include "tabor/deposition/pools.hpp"
#include "tabor/numerics/disjoint_sets.hpp"

// Builds the tree of pools of a surface, by union-find over its saddles. Ties are ordered.
namespace tabor::deposition {

/// Builds all pools: each lowest place begins one, and those that meet at a saddle become children
/// of a new one (the merge tree of the sublevel sets, from its critical pixels alone, as Chiang,
/// Lenz, Lu & Rote 2005 build contour trees). Then each pixel finds its pool.
class PoolBuilder {
 public:
  PoolBuilder(Pools& result, bool lists_pixels) : to_(result), lists_pixels_(lists_pixels) {}
  void build();

 private:
  /// Set of basins that reaches a saddle.
  struct Side {
    PoolId root;   ///< of the set
    Rank lowest;   ///< its lowest neighbour of the saddle
    PoolId basin;  ///< of that one
  };

  void join_basins(Basins& basins);
  void find_sides(Rank saddle, const UnwrittenVector<PoolId>& basin_of);
  void join_sides(Rank saddle);
  void prefetch(const Basins& basins, std::size_t i) const;
  void find_pools(UnwrittenVector<PoolId>&& basin_of);
  void place_pixels(const UnwrittenVector<PoolId>& basin_of, const Branches& branches);
  void make_pools(const Branches& branches, UnwrittenVector<PoolId>&& basin_of);
  void make_arcs();
  void fill_arcs(PoolId first, PoolId end, std::vector<std::int32_t>& next);
  void sort_arcs();
  void finish_arcs(PoolId id);
  void sort_listed(std::size_t begin, std::size_t end, std::vector<Rank>& ranks);
  Growth& growth(PoolId id) { return to_.growth_[static_cast<std::size_t>(id)]; }

  Pools& to_;
  bool lists_pixels_;
  PoolTree tree_;
  numerics::DisjointSets<PoolId> joined_;  ///< basins, as far as they have met
  std::vector<PoolId> largest_;            ///< per set of them, at its root: its pool
  std::vector<Side> sides_;                ///< of the saddle that is looked at
};

}  // namespace tabor::deposition
