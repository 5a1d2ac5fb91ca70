#pragma once

#include <vector>

#include "tabor/deposition/slopes.hpp"

namespace tabor::deposition {

/// Finds the place where all flow paths from a fork, or from a full pool, meet again (its
/// confluence). A fork is a pixel whose flow path depends on the levels (slopes.hpp).
///
/// The branch that a droplet takes at a fork changes with the levels, but often all branches lead,
/// over full pools and further forks, to the same place: a pool that is not full, or a fork or full
/// pool from which paths separate finally. Every later droplet passes there. For let more water
/// cover a place on one of the paths. The pool of that place then covers the whole path down to the
/// first full pool on it and has that pool as a part. As no liquid leaves a pool before it is full,
/// it also covers the place to which that one spilled; and so on to the confluence. A droplet in
/// this pool is where a droplet at the confluence would be.
///
/// In terms of graphs: the common post-dominators of the places that a place may flow to.
class Confluences {
 public:
  using Target = Slopes::Target;

  /// Finds the confluences for the present levels. The slopes must know the pools by their present
  /// numbers.
  Confluences(const Slopes& slopes, const Pools& pools);

  /// Returns the farthest place that every droplet from `at` passes; `at` itself if there is none.
  Target of(Target at) const { return next_[index(at)]; }

 private:
  /// Place whose successors are being visited, depth first.
  struct Visit {
    Target at = 0;
    std::size_t begin = 0;  ///< of its successors among successors_
    std::size_t place = 0;  ///< of the one to look at next
  };

  std::size_t index(Target at) const {
    return Slopes::is_pool(at) ? static_cast<std::size_t>(at) : n_pools_ + Slopes::place_of(at);
  }
  Target& next(Target at) { return next_[index(at)]; }
  void prefetch_pools(Target fork) const;
  Target last(Target at);
  void explore(Target start);
  void enter(Target at);
  void leave();
  void add_branches(Target fork);
  void add_overflow(PoolId full);

  const Slopes& slopes_;
  const Pools& pools_;
  std::size_t n_pools_;
  std::vector<Target> next_;  ///< per pool, then per fork: a place droplets from it come by
  std::vector<Visit> visits_;
  std::vector<Target> successors_;
};

}  // namespace tabor::deposition
