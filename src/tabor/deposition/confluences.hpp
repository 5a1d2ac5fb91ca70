#pragma once

#include <vector>

#include "tabor/deposition/slopes.hpp"

namespace tabor::deposition {

/// Where all flow paths from a fork, or from a full pool, meet again.
///
/// Which branch of a fork a droplet takes changes with the levels, but often it does not matter:
/// all branches lead, over full pools and further forks, to the same place. That is a pool that is
/// not full, or a fork or full pool from which paths part for good. Whatever is rained later, every
/// droplet comes by there. For let more water cover a place on one of the paths. The pool it
/// belongs to then covers the whole path down to the first full pool on it, has this one as a part,
/// and so, as no liquid leaves a pool before it is full, also the place to which that one spilled;
/// and so on to the confluence. A droplet in this pool is where a droplet at the confluence would
/// be.
///
/// In the words of graphs: common post-dominators of what a place may flow to.
class Confluences {
 public:
  using Target = Slopes::Target;

  /// As the levels stand. Needs slopes that know pools by their present numbers.
  Confluences(const Slopes& slopes, const Pools& pools);

  /// The farthest place by which every droplet from `at` comes; `at` itself if there is none.
  Target of(Target at) const { return next_[index(at)]; }

 private:
  /// A place whose successors are being looked at, depth first.
  struct Visit {
    Target at = 0;
    std::size_t begin = 0;  ///< of its successors among successors_
    std::size_t place = 0;  ///< of the one to look at next
  };

  std::size_t index(Target at) const {
    return Slopes::is_pool(at) ? static_cast<std::size_t>(at) : n_pools_ + Slopes::place_of(at);
  }
  Target& next(Target at) { return next_[index(at)]; }
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
