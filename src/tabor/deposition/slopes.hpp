#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "tabor/deposition/pools.hpp"

namespace tabor::deposition {

class Confluences;
class Descent;

/// Stores where the dry surface leads a droplet, found once and valid for any amount of liquid.
///
/// Most pixels have only one flow path. Consider two lower neighbours of a dry pixel. If the higher
/// one, when the liquid reaches it, lies in a pool that also holds the lower one, then the droplet
/// goes to the lower one while that is dry, and into the same pool by either when it is wet. A
/// pixel whose lower neighbours are nested like this leads to the lowest of them, and so on
/// downhill, to a lowest place (a leaf pool) or a fork: a place whose lower neighbours can fill
/// independently, so that the present levels decide. About one pixel in nine of a rough surface is
/// a fork.
///
/// If a pool covers any place on such a path it covers all places below; hence a path that starts
/// in the liquid ends in that pool, or at a fork whose branches are all in it.
class Slopes {
 public:
  using Target = std::int32_t;  ///< a PoolId, or the complement of the number of a fork

  /// A lower neighbour of a fork.
  struct Branch {
    Height height = 0;
    PoolId pool = kNoPool;  ///< the smallest pool that can cover it
    union {
      Target leads_to = 0;  ///< while it is dry
      Pixel pixel;  ///< of the only branch of a fork; of all, until it is known where they lead
    };
  };

  /// Fork with two branches or more, ascending in pixel number; or with one, if it is a pixel
  /// without lower neighbours on a saddle of several equal pixels: that pixel, with the pool above
  /// it. Two branches, the common number, are stored in the fork: half a cache line.
  struct alignas(32) Fork {
    /// Range of the branches in branches_, unless they are two.
    struct Listed {
      std::int32_t first = 0;
      PoolId none = kNoPool;  ///< where the pool of the first of two branches is
      std::int32_t n = 0;
    };
    FlowPath path;  ///< of the last droplet
    union {
      std::array<Branch, 2> two;
      Listed listed;
    };

    Fork() : two{} {}
    bool has_two() const { return listed.none != kNoPool; }
  };

  static bool is_pool(Target target) { return target >= 0; }

  /// Finds the slopes of pools with connected ties that hold no liquid yet.
  Slopes(const Pools& pools, const Descent& descent);

  Target from(Pixel p) const { return leads_to_[static_cast<std::size_t>(p)]; }
  std::size_t n_forks() const { return forks_.size(); }
  std::span<const Branch> branches(Target fork) const {
    const Fork& at = forks_[place_of(fork)];
    return at.has_two() ? std::span<const Branch>(at.two)
                        : std::span(branches_).subspan(static_cast<std::size_t>(at.listed.first),
                                                       static_cast<std::size_t>(at.listed.n));
  }
  std::span<Branch> branches(Target fork) {
    const auto all = std::as_const(*this).branches(fork);
    return {const_cast<Branch*>(all.data()), all.size()};
  }

  /// Returns the last droplet's path from a fork, or from a full pool.
  FlowPath path_from(const Pools& pools, Target at) const {
    return is_pool(at) ? pools[at].overflow : forks_[place_of(at)].path;
  }
  void remember(Target fork, const FlowPath& path) { forks_[place_of(fork)].path = path; }

  /// Follows Pools::renumber(), and removes forks that no longer matter: what leads to a fork, or
  /// to a full pool, then leads to the confluence of all paths from there.
  void settle(Pools& pools, const std::vector<PoolId>& renamed);

  void prefetch(Pixel p) const { __builtin_prefetch(&leads_to_[static_cast<std::size_t>(p)]); }
  void prefetch_fork(Target fork) const { __builtin_prefetch(&forks_[place_of(fork)]); }

  static std::size_t place_of(Target fork) {
    const Target complement = ~fork;
    return static_cast<std::size_t>(complement);
  }

 private:
  friend class SlopeFinder;

  template <class Change>
  void change_targets(const Change& change);
  void rename_pools(const std::vector<PoolId>& renamed);
  std::vector<Target> drop_forks(const Confluences& confluences);

  std::vector<Target> leads_to_;  ///< per pixel
  std::vector<Fork> forks_;
  std::vector<Branch> branches_;  ///< of the forks that have not two
};

}  // namespace tabor::deposition
