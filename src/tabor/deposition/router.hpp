#pragma once

#include <vector>

#include "tabor/deposition/cut_paths.hpp"
#include "tabor/deposition/descent.hpp"
#include "tabor/deposition/saddles.hpp"
#include "tabor/deposition/slopes.hpp"

namespace tabor::deposition {

/// Follows the flow path of a droplet from a pixel, or from a full pool, over solid and liquid to
/// the first pool that is not full. Slopes give the path on the dry surface; forks are decided by
/// the levels of the pools around them, and full pools flow on from their saddle.
///
/// Forks and full pools remember the pool where their path ended, with a certificate: the path
/// stays the same while the level of that pool is strictly below a bound, the lowest height at
/// which some fork on the path would prefer another branch. This one level is enough: a branch on
/// the path is flooded only by a pool that also holds the end of the path, and a full pool on it
/// does not change until it merges with the pool where the path ends. Where equal heights join
/// several pools, their region may grow while that level stays: when another of them is full. Paths
/// are cut there (cut_paths.hpp).
class Router {
 public:
  explicit Router(Pools& pools)
      : pools_(pools),
        descent_(pools),
        slopes_(pools, descent_),
        saddles_(pools, descent_),
        cuts_(pools) {}

  using Target = Slopes::Target;

  const Slopes& slopes() const { return slopes_; }
  /// Returns the pool where the path ends. `start` is the target of the slope under a pixel, or a
  /// full pool.
  PoolId from(Target start) { return follow(start); }

  /// Ask the processor to fetch what from(start) reads first or, when that is there, next.
  void prefetch(Target start) const;
  void prefetch_end(Target start) const;

  /// Returns the number of places, branches and pools visited so far: a measure of work that is the
  /// same on every machine.
  std::int64_t n_looks() const { return n_looks_ + saddles_.n_looks() + pools_.n_steps(); }

  /// Removes forks whose path no longer depends on the levels, to save memory. Pools get new
  /// numbers.
  void settle();

 private:
  struct Step {
    Target from = 0;
    Height bound = kNoRim;
  };

  PoolId follow(Target at);
  Target take_branch(Target fork);
  Target spill(PoolId full);
  void record(PoolId end);
  bool valid(const FlowPath& path);
  Target toward(const Candidate& candidate) const;

  Pools& pools_;
  Descent descent_;
  Slopes slopes_;
  Saddles saddles_;
  std::vector<Step> trail_;
  CutPaths cuts_;
  std::vector<PoolId> passed_;  ///< cuts on the path of the droplet
  std::int64_t n_looks_ = 0;
};

}  // namespace tabor::deposition
