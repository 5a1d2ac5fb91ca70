#pragma once

#include <unordered_map>
#include <vector>

#include "tabor/lubrication/pools.hpp"

namespace tabor::lubrication {

/// Where a droplet on a pixel, or on a full pool, runs: over solid and liquid as they stand, to
/// the first pool that is not full.
///
/// Every pixel caches the pool its way led to, with a certificate: the way stays the same while the
/// level of that pool is strictly below a bound, the lowest height at which some pixel on the way
/// would prefer another neighbour. This one level is enough. A pixel on the way is flooded only by
/// a pool that holds the end of the way too, and a full pool on the way stands still until it
/// merges with the pool the way ends in. Where equal heights join several pools, what joins them
/// may grow without that level noticing: there ways are cut, and the saddle is judged anew.
class Router {
 public:
  explicit Router(Pools& pools);

  PoolId from_pixel(Pixel start);
  PoolId from_full_pool(PoolId id) { return follow(id); }

  /// Asks the processor, in three steps some droplets apart, to fetch what from_pixel(start) will
  /// read: its way; the pool it leads to and, if the way may be doubtful, the pixels around; their
  /// pool.
  void prefetch_way(Pixel start) const {
    __builtin_prefetch(&ways_[static_cast<std::size_t>(start)]);
  }
  void prefetch_end(Pixel start) const {
    const Way& way = ways_[static_cast<std::size_t>(start)];
    if (is_pool(way.target)) {
      pools_.prefetch(way.target);
    }
    if (way.bound != kNoRim) {
      pools_.prefetch_around(start);
    }
  }
  void prefetch_home(Pixel start) const {
    if (ways_[static_cast<std::size_t>(start)].bound != kNoRim) {
      pools_.prefetch(pools_.home(start));
    }
  }

 private:
  using Target = std::int32_t;  ///< a PoolId, or the complement of a Pixel

  static bool is_pool(Target target) { return target >= 0; }
  static Target toward(Pixel p) { return ~p; }

  struct Way {
    Target target = 0;
    Height bound = kDry;  ///< valid while the level at the target is below
  };

  /// A neighbour a droplet may choose: compared by current height, then pixel number.
  struct Candidate {
    Height height = kNoRim;
    Pixel pixel = kOutside;
    PoolId wet_by = kNoPool;
    bool before(const Candidate& other) const {
      return height < other.height || (height == other.height && pixel < other.pixel);
    }
  };

  /// The lowest candidate, and the height at which the choice becomes doubtful.
  struct Choice {
    Candidate best;
    Height doubt = kNoRim;
    void consider(const Candidate& candidate);
    bool leads_below(Height height) const { return best.height < height; }
    Way way(Height below) const;
  };

  /// Regions of equal height on a saddle of several pixels, and where each of them drains.
  struct Saddle {
    std::int32_t open_children = 0;       ///< of the pool above when this was found
    std::vector<std::int32_t> region_of;  ///< per saddle pixel
    std::unordered_map<PoolId, std::int32_t> region_of_full;
    std::vector<Choice> drain;  ///< per region
  };

  struct Step {
    Pixel pixel = 0;
    Height bound = kNoRim;
    std::size_t plateau_end = 0;  ///< pixels of plateau_ up to here share this step
    bool doubtful = false;        ///< bounded by another neighbour that could be chosen later
  };

  PoolId follow(Target start);
  bool valid(const Way& way);
  Way step(Pixel p);
  Candidate candidate(Pixel q);
  Choice choose(Pixel p);
  Way across_plateau(Pixel p);
  Target drain_of_saddle(PoolId above, PoolId full, Pixel on);
  Saddle find_regions(PoolId above);
  void record(Target target);
  Height bound_of_agreement(Pixel p, PoolId end, Height way_bound);
  PoolId known_end(Pixel p, Height& bound);

  Pools& pools_;
  std::vector<Way> ways_;
  std::vector<Step> trail_;
  std::vector<Pixel> plateau_;
  std::unordered_map<PoolId, Saddle> saddles_;
};

}  // namespace tabor::lubrication
