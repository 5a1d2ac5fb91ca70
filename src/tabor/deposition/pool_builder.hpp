#pragma once

#include <vector>

#include "tabor/deposition/pools.hpp"

// Builds the tree of pools of a surface from its sorted heights, by union-find. Ties are ordered.
namespace tabor::deposition {

/// Returns all pixels, ascending in (height, pixel number). Radix sort; needs 16 bytes per pixel
/// meanwhile.
std::vector<Pixel> ascending_pixels(const Terrain& terrain);

/// Builds all pools in one pass: pixels are added from the lowest to the highest, and pools that
/// meet at a pixel become children of a new one (the merge tree of the sublevel sets, by
/// union-find).
class PoolBuilder {
 public:
  explicit PoolBuilder(Pools& result) : to_(result) {}
  void build();

 private:
  PoolId grown(PoolId id);  ///< what `id` has merged into so far
  void add(Pixel p);
  void prefetch_site(const std::vector<Pixel>& ascending, std::size_t place) const;
  void prefetch_neighbours(const std::vector<Pixel>& ascending, std::size_t place) const;
  PoolId new_pool(Height base);
  PoolId merge(Height base);
  void make_arcs(const std::vector<Pixel>& ascending);
  void fill_arcs(const std::vector<Pixel>& ascending);
  Pool& pool(PoolId id) { return to_.pools_[static_cast<std::size_t>(id)]; }
  Growth& growth(PoolId id) { return to_.growth_[static_cast<std::size_t>(id)]; }
  PoolId& pool_at(Pixel p) { return to_.sites_[static_cast<std::size_t>(p)].pool; }

  Pools& to_;
  std::vector<PoolId> into_;     ///< per pool: itself, or a step towards what it has merged into
  std::vector<PoolId> meeting_;  ///< pools around the pixel being added
};

}  // namespace tabor::deposition
