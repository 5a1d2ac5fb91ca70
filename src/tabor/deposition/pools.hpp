#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "tabor/core/large_pages.hpp"
#include "tabor/deposition/terrain.hpp"

// Stores the depressions of a surface as a tree (depression hierarchy) with the liquid in them.
namespace tabor::deposition {

using PoolId = std::int32_t;

inline constexpr PoolId kNoPool = -1;
inline constexpr Pixel kSeveral = -1;
inline constexpr PoolId kOcean = 0;  ///< of an open edge: lies below everything and never fills

/// Treatment of equal heights.
enum class Ties {
  connected,  ///< equal neighbours are one place (the rule of the droplets)
  ordered     ///< a lower pixel number counts as lower: no two heights are ever equal
};

/// End of the flow path of a droplet: a pool that was not full then.
struct FlowPath {
  PoolId end = 0;
  Height bound = kDry;  ///< the path is the same while the level at its end is below
};

/// Depression of the surface: one component of the sublevel sets {height <= h}. It is active, and
/// holds liquid, from the moment its children are full until it is full itself. Half a cache line
/// holds all that a droplet reads of it.
struct alignas(32) Pool {
  PoolId parent = kNoPool;  ///< the pool that it joins at its rim; kNoPool for the last one
  PoolId owner = kNoPool;   ///< itself, or a step towards the active pool it now belongs to
  Height level = kDry;      ///< of the liquid; kDry before the pool is active
  Height stop = kNoRim;     ///< where it next takes in pixels, or its rim
  std::int32_t area = 0;    ///< pixels under or at the level; before it is active, of full children
  std::int32_t remainder = 0;  ///< liquid above the level, less than one quantum over the area
  FlowPath overflow = {};      ///< when it is full: where the overflow ran last. With ordered ties,
                               ///< before that: the leaf across its saddle where it has only one
                               ///< sibling, else kNoPool

  /// True where the pool holds liquid. Not defined for the ocean, whose level lies below
  /// everything.
  bool active() const { return level != kDry; }
  bool full() const { return level == stop; }
  /// True where it is full and not part of another pool yet: what flows in flows out over the
  /// saddle.
  bool spills() const { return full() && parent != kNoPool; }
};

/// Data of a pool that is needed when it takes in pixels or becomes part of another.
struct Growth {
  std::int32_t open_children = 0;  ///< that are not full
  std::int32_t next = 0;           ///< the first pixel not taken in yet, among the arcs
  std::int32_t rim = 0;            ///< behind its last pixel, among the arcs
  std::int32_t lowest = kNoPlace;  ///< its lowest pixel, where its children meet, or the complement
                                   ///< of the place of several; of a leaf kNoPlace
  static constexpr std::int32_t kNoPlace = std::numeric_limits<std::int32_t>::min();
};

/// Depression hierarchy of a surface (Barnes, Callaghan & Wickert 2020): all pools that it can ever
/// have, as the tree in which they merge, and the liquid in them. Volumes are whole numbers, so
/// that liquid is conserved exactly.
class Pools {
 public:
  /// `terrain` must outlive the pools, but its heights are copied and may be released. Lists of
  /// pixels can be had while ties are ordered.
  Pools(const Terrain& terrain, Ties ties, bool lists_pixels = false);

  /// Removes all liquid from pools with ordered ties and connects the ties, which is faster than to
  /// build pools anew. Not after renumber(), which removes pools.
  void connect_ties();

  const Terrain& terrain() const { return *terrain_; }
  std::size_t count() const { return pools_.size(); }
  const Pool& operator[](PoolId id) const { return pools_[static_cast<std::size_t>(id)]; }
  /// Returns the smallest pool that the pixel can ever be part of.
  PoolId pool_at(Pixel p) const { return sites_[static_cast<std::size_t>(p)].pool; }
  Height height(Pixel p) const { return sites_[static_cast<std::size_t>(p)].height; }
  /// Returns the leaf that steepest descent from the pixel leads to, or kOcean. Only while ties are
  /// ordered.
  PoolId drains_to(Pixel p) const { return drains_to_[static_cast<std::size_t>(p)]; }

  /// Places of the pixels of one pool alone, from the lowest up.
  struct Places {
    std::int32_t begin = 0;
    std::int32_t end = 0;
  };
  Places places_of(PoolId id) const { return {first_arc(id), growth(id).rim}; }
  Height height_at(std::int32_t place) const { return arc(place); }
  /// Returns the pixel at a place; for pools that list pixels.
  Pixel pixel_at(std::int32_t place) const { return listed_[static_cast<std::size_t>(place)]; }

  /// Returns the pool that now holds the liquid of `id`; `id` itself while it is not active.
  PoolId owner(PoolId id) {
    PoolId root = id;
    while (true) {
      const PoolId up = step_up(root);
      if (up == root) break;
      root = up;
    }
    if (root != id) shorten(id, root);
    return root;
  }

  /// Returns owner(id), or a full pool that has become part of its parent since: faster, as it does
  /// not read the parent. Halves the path, as a pool that covers much has many others in a row.
  PoolId holder(PoolId id) {
    for (PoolId up = (*this)[id].owner; up != id; up = (*this)[id].owner) {
      ++n_steps_;
      id = pools_[static_cast<std::size_t>(id)].owner = (*this)[up].owner;
    }
    return id;
  }

  /// Pours into an active pool that is not full; returns what is left once it is full.
  Volume pour(PoolId id, Volume carried);

  /// Raises an active pool that is not full by `rise`, at most to its next stop; returns the
  /// volume.
  Volume raise(PoolId id, Height rise);

  /// Returns the volume that raises an active pool that is not full to `level`, or to its rim if
  /// that is lower; above the highest pixel of a map without a rim, the least that floods it.
  Volume volume_to(PoolId id, Height level) const;

  /// Returns the number of steps of holder() so far: the same on every machine.
  std::int64_t n_steps() const { return n_steps_; }

  void remember_overflow(PoolId full, const FlowPath& path) {
    pools_[static_cast<std::size_t>(full)].overflow = path;
  }

  /// True where some of its children are not full; else it holds liquid, or did.
  bool waits(PoolId id) const { return growth(id).open_children > 0; }

  /// Returns the only pixel over which a full pool that is not the last touches its neighbours;
  /// kSeveral if there are more.
  Pixel saddle(PoolId full) const {
    return std::max(growth((*this)[full].parent).lowest, kSeveral);
  }
  /// Returns the lowest pixels of a pool that is no leaf, ascending.
  std::span<const Pixel> bottom(PoolId id) const;

  /// Returns the pools that have filled up to a saddle of several pixels since the last call.
  std::vector<PoolId> take_closed() { return std::exchange(closed_, {}); }

  /// Returns the pools whose children meet over several pixels and of which one has become full
  /// since the last call.
  bool has_changed() const { return !changed_.empty(); }
  std::vector<PoolId> take_changed() { return std::exchange(changed_, {}); }

  /// Returns the volume poured beyond all rims: run off an open edge, or lying flat above the
  /// highest pixel.
  Volume beyond() const { return beyond_; }
  /// True once only beyond() can change: a closed or periodic map is one pool without a rim; all
  /// pools of an open one are full. pool_beyond() takes it all.
  bool replete() const;
  PoolId pool_beyond() const { return terrain_->edge == Edge::open ? kOcean : last_; }

  /// Only with connected ties: gives the pools new numbers, in the same order, and removes those
  /// that have become part of others, so that the rest lies closer together in memory. Returns for
  /// each old number the new one of the pool that holds it.
  std::vector<PoolId> renumber();

  /// Asks the processor to fetch a pool before it is needed.
  void prefetch(PoolId id) const { __builtin_prefetch(&pools_[static_cast<std::size_t>(id)]); }

 private:
  friend class PoolBuilder;
  friend class TieConnector;

  /// Height and pool stand together because they are read together, in random order.
  struct Site {
    Height height;
    PoolId pool;
  };

  /// New numbers of pools.
  struct Numbers {
    std::vector<PoolId> now;     ///< per old number; kNoPool for a pool that vanishes
    std::vector<PoolId> before;  ///< per new number

    std::size_t count() const { return before.size(); }
    PoolId of(PoolId old) const {
      return old == kNoPool ? kNoPool : now[static_cast<std::size_t>(old)];
    }
  };

  PoolId step_up(PoolId id) const {
    const Pool& pool = (*this)[id];
    if (pool.owner != id || !pool.full() || pool.parent == kNoPool) return pool.owner;
    return (*this)[pool.parent].active() ? pool.parent : id;
  }
  const Growth& growth(PoolId id) const { return growth_[static_cast<std::size_t>(id)]; }
  /// Where the heights of a pool begin among the arcs.
  std::int32_t first_arc(PoolId id) const { return id == 0 ? 0 : growth(id - 1).rim + 1; }
  Height arc(std::int32_t place) const { return arcs_[static_cast<std::size_t>(place)]; }
  void remove_liquid();
  Numbers number_by_place(std::size_t n);
  void shorten(PoolId id, PoolId root);
  void take_in(PoolId id);
  bool fill_up(PoolId id);

  const Terrain* terrain_;
  PoolId last_ = kNoPool;  ///< the one that holds all others
  PoolId n_filling_ = 0;   ///< active pools that are not full, the ocean not counted
  LargeVector<Pool> pools_;
  LargeVector<Growth> growth_;   ///< per pool
  std::vector<PoolId> closed_;   ///< see take_closed()
  std::vector<PoolId> changed_;  ///< see take_changed()
  LargeVector<Site> sites_;
  UnwrittenVector<PoolId> drains_to_;  ///< see drains_to()
  LargeVector<Height> arcs_;  ///< heights of the pixels of each pool alone, ascending, and its rim
  UnwrittenVector<Pixel> listed_;  ///< the pixels at the same places; empty where none are listed
  std::vector<Pixel> saddles_;     ///< saddles of several pixels: their number, then the pixels
  Volume beyond_ = 0;
  std::int64_t n_steps_ = 0;
};

}  // namespace tabor::deposition
