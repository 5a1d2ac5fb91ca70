#pragma once

#include <unordered_map>
#include <vector>

#include "tabor/deposition/slopes.hpp"

namespace tabor::deposition {

/// Where a droplet on a pixel, or on a full pool, runs: over solid and liquid as they stand, to
/// the first pool that is not full. Slopes say where the dry surface leads; what is left to judge
/// are forks, by the levels of the pools around, and full pools, which flow on from their saddle.
///
/// Each of these remembers the pool its path ended in, with a certificate: the path stays the same
/// while the level of that pool is strictly below a bound, the lowest height at which some fork on
/// it would prefer another branch. This one level is enough. A branch on the path is flooded
/// only by a pool that holds the end of the path too, and a full pool on it stands still until
/// it merges with the pool the path ends in. Where equal heights join several pools, what joins
/// them may grow without that level noticing: there paths are cut, and the saddle is judged anew.
class Router {
 public:
  explicit Router(Pools& pools) : pools_(pools), slopes_(pools) {}

  using Target = Slopes::Target;

  const Slopes& slopes() const { return slopes_; }
  /// From where the slope under a pixel leads to, or from a full pool.
  PoolId from(Target start) { return follow(start); }

  /// Asks the processor to fetch what from(start) reads first, or, when that is there, next.
  void prefetch(Target start) const;
  void prefetch_end(Target start) const;

  /// Forgets what the liquid has decided for good, so that less memory is in use. Pools get new
  /// numbers.
  void settle();

 private:
  struct Step {
    Target from = 0;
    Height bound = kNoRim;
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
  };

  /// Regions of equal height on a saddle of several pixels, and where each of them drains.
  struct Saddle {
    std::int32_t open_children = 0;       ///< of the pool above when this was found
    std::vector<std::int32_t> region_of;  ///< per saddle pixel
    std::unordered_map<PoolId, std::int32_t> region_of_full;
    std::vector<Choice> drain;  ///< per region
  };

  PoolId follow(Target at);
  Target take_branch(Target fork);
  Target spill(PoolId full);
  void record(PoolId end);
  bool valid(const FlowPath& path);
  Candidate candidate(Pixel q);
  Target toward(const Candidate& candidate) const;
  Target drain_of_saddle(PoolId above, PoolId full, Pixel on);
  Saddle find_regions(PoolId above);

  Pools& pools_;
  Slopes slopes_;
  std::vector<Step> trail_;
  std::unordered_map<PoolId, Saddle> saddles_;
};

}  // namespace tabor::deposition
