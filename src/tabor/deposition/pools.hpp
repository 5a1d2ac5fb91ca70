#pragma once

#include <span>
#include <vector>

#include "tabor/deposition/terrain.hpp"

namespace tabor::deposition {

using PoolId = std::int32_t;

inline constexpr PoolId kNoPool = -1;
inline constexpr Pixel kSeveral = -1;
inline constexpr PoolId kOcean = 0;  ///< of an open edge: lies below everything and never fills

/// What holds together pixels of equal height.
enum class Ties {
  connected,  ///< equal neighbours are one place (the rule of the droplets)
  ordered     ///< a lower pixel number counts as lower: no two heights are ever equal
};

/// Where the path of a droplet ended: in a pool that was not full then.
struct FlowPath {
  PoolId end = 0;
  Height bound = kDry;  ///< the path is the same while the level at its end is below
};

/// One component of the sublevel sets {height <= h}. It holds liquid while it is active: from the
/// moment its children are full until it is full itself. What only some of these states need shares
/// its place, so that a droplet that meets a pool reads half a cache line.
struct alignas(32) Pool {
  PoolId parent = kNoPool;  ///< what it becomes part of at its rim; kNoPool for the last one
  PoolId owner = kNoPool;   ///< itself, or a step towards the active pool it now belongs to
  Height level = kDry;      ///< of the liquid; kDry before the pool is active
  Height stop = kNoRim;     ///< where it next takes in pixels, or its rim
  union {
    std::int32_t area = 0;  ///< until it is full: pixels under or at the level (before it is
                            ///< active: of its full children)
    PoolId overflow_end;    ///< when it is full: where the overflow ran last
  };
  union {
    std::int32_t remainder = 0;  ///< while active: liquid above the level, less than one quantum
                                 ///< over the area
    std::int32_t lowest;    ///< before: its lowest pixel, or the complement of the place of several
    Height overflow_bound;  ///< when it is full
  };
  union {
    std::int32_t next = 0;  ///< until it is full: the first pixel not taken in yet, among the arcs
    Pixel saddle;           ///< when it is full: the only pixel over which it touches its
                            ///< neighbours; kSeveral if more than one
  };
  std::int32_t open_children = 0;

  bool active() const { return open_children == 0; }
  bool full() const { return level == stop; }
  /// Full and not part of another pool yet: what flows in flows out over the saddle.
  bool spills() const { return active() && full() && parent != kNoPool; }

  /// Of a full pool.
  FlowPath overflow() const { return {overflow_end, overflow_bound}; }
  void remember_overflow(const FlowPath& path) {
    overflow_end = path.end;
    overflow_bound = path.bound;
  }
};

/// All pools a surface can ever have, as the tree in which they merge, and the liquid in them.
/// Steps of the liquid are whole numbers: what is poured in is exactly what is there.
class Pools {
 public:
  /// `terrain` must outlive the pools, but its heights are copied and may be released.
  Pools(const Terrain& terrain, Ties ties);

  const Terrain& terrain() const { return *terrain_; }
  std::size_t count() const { return pools_.size(); }
  const Pool& operator[](PoolId id) const { return pools_[static_cast<std::size_t>(id)]; }
  /// The smallest pool that the pixel can ever be part of.
  PoolId pool_at(Pixel p) const { return sites_[static_cast<std::size_t>(p)].pool; }
  Height height(Pixel p) const { return sites_[static_cast<std::size_t>(p)].height; }

  /// The pool whose liquid that of `id` is now part of; `id` itself while it is not active.
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

  /// The same, but a full pool that has become part of its parent since may stand for it: saves
  /// looking at the parent.
  PoolId holder(PoolId id) const {
    while ((*this)[id].owner != id) id = (*this)[id].owner;
    return id;
  }

  /// Pours into an active pool that is not full; returns what is left once it is full.
  Volume pour(PoolId id, Volume carried);

  /// Raises an active pool that is not full by `rise`, at most to its next stop; returns the
  /// volume.
  Volume raise(PoolId id, Height rise);

  void remember_overflow(PoolId full, const FlowPath& path) {
    pools_[static_cast<std::size_t>(full)].remember_overflow(path);
  }

  Pixel saddle(PoolId full) const { return (*this)[full].saddle; }
  /// The lowest pixels of a pool that is not active.
  std::span<const Pixel> bottom(PoolId id) const;

  /// Poured beyond all rims: run off an open edge, or lying flat above the highest pixel.
  Volume beyond() const { return beyond_; }
  /// True once a closed or periodic map is one pool without a rim.
  bool flooded() const;

  /// Gives the pools new numbers, in the same order, and forgets those that have become part of
  /// others: what is still of use then lies closer together. Returns for each old number the new
  /// one of the pool that holds it.
  std::vector<PoolId> renumber();

  /// Asks the processor to fetch a pool before it is needed.
  void prefetch(PoolId id) const { __builtin_prefetch(&pools_[static_cast<std::size_t>(id)]); }

 private:
  friend class PoolBuilder;

  /// Kept together because they are read together, in no order a cache could guess.
  struct Site {
    Height height = 0;
    PoolId pool = kNoPool;
  };

  PoolId step_up(PoolId id) const {
    const Pool& pool = (*this)[id];
    if (pool.owner != id || !pool.full() || pool.parent == kNoPool) return pool.owner;
    return (*this)[pool.parent].active() ? pool.parent : id;
  }
  void shorten(PoolId id, PoolId root);
  void take_in(PoolId id);

  const Terrain* terrain_;
  Ties ties_;
  PoolId last_ = kNoPool;  ///< the one that holds all others
  std::vector<Pool> pools_;
  std::vector<Site> sites_;
  std::vector<Height> arcs_;  ///< heights of the pixels of each pool alone, ascending, and its rim
  std::vector<bool> is_rim_;  ///< per place in arcs_
  std::vector<Pixel> saddles_;  ///< saddles of several pixels: their number, then the pixels
  Volume beyond_ = 0;
};

}  // namespace tabor::deposition
