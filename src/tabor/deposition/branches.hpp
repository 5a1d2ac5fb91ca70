#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "tabor/core/large_pages.hpp"
#include "tabor/deposition/pools.hpp"
#include "tabor/deposition/ranks.hpp"

// Finds the smallest pool of a tree that a pixel is in.
namespace tabor::deposition {

/// A tree of pools in the order in which they begin: first all leaves, and each behind its
/// children.
struct PoolTree {
  std::vector<PoolId> parent;
  std::vector<PoolId> spills_to;  ///< the only basin that it can run over to; kNoPool: several
  std::vector<Rank> base;         ///< the lowest pixel, where children meet
  std::size_t n_leaves = 0;

  PoolId add(Rank lowest) {
    parent.push_back(kNoPool);
    spills_to.push_back(kNoPool);
    base.push_back(lowest);
    return static_cast<PoolId>(parent.size()) - 1;
  }
};

/// The pools of a tree branch by branch (branch decomposition: Pascucci, Cole-McLaughlin &
/// Scorzelli 2004): from each leaf up to where it joins a pool that has more leaves. Bases rise
/// along a branch, so that a pool is found by few steps from branch to branch and a binary search.
class Branches {
 public:
  /// Takes the tree apart, so as to need less memory.
  explicit Branches(PoolTree&& tree);

  /// Returns the number of a pool, counted along the branches: that of the smallest one that a
  /// pixel of this basin is in.
  PoolId pool_of(PoolId basin, Rank pixel) const {
    const Branch* branch = &branches_[static_cast<std::size_t>(basin)];
    PoolId begin = branch->begin;
    while (pixel >= branch->joins_at) {
      begin = branch->joins;
      branch = &branches_[static_cast<std::size_t>(branch->joined_branch)];
    }
    return last_base_below(pixel, begin, branch->end);
  }

  std::size_t count() const { return bases_.size(); }
  PoolId parent(PoolId pool) const { return parents_[static_cast<std::size_t>(pool)]; }
  PoolId spills_to(PoolId pool) const { return spills_to_[static_cast<std::size_t>(pool)]; }
  Rank base(PoolId pool) const { return bases_[static_cast<std::size_t>(pool)]; }
  std::size_t n_leaves() const { return branches_.size(); }
  PoolId leaf_of(PoolId basin) const {
    return basin == kNoPool ? kNoPool : branches_[static_cast<std::size_t>(basin)].begin;
  }
  PoolId last() const { return last_; }  ///< the pool that holds all others

 private:
  /// Pools from a leaf up, [begin, end).
  struct Branch {
    Rank joins_at = ~Rank{0};  ///< base of the pool of another branch that it joins
    PoolId joins = kNoPool;
    PoolId joined_branch = kNoPool;
    PoolId begin = 0;
    PoolId end = 0;
  };

  static constexpr PoolId kStride = 64;

  void number_along_branches(const PoolTree& tree);
  void find_joins(const PoolTree& tree);

  /// Returns the last of the pools [begin, end) of one branch whose base is not above the pixel, as
  /// that of the first is not.
  PoolId last_base_below(Rank pixel, PoolId begin, PoolId end) const {
    const PoolId sample = begin / kStride + 1;
    if (const PoolId n = (end - 1) / kStride + 1 - sample; n > 0) {
      const Rank* const samples = &samples_[static_cast<std::size_t>(sample)];
      if (pixel < *samples) {
        end = sample * kStride;
      } else {
        begin = (sample + last_below(pixel, samples, n)) * kStride;
        end = std::min(end, begin + kStride);
      }
    }
    return begin + last_below(pixel, &bases_[static_cast<std::size_t>(begin)], end - begin);
  }

  /// Without conditional jumps, which the processor would mispredict.
  static PoolId last_below(Rank pixel, const Rank* bases, PoolId n) {
    const Rank* last = bases;
    while (n > 1) {
      const PoolId half = n / 2;
      last += last[half] <= pixel ? half : 0;
      n -= half;
    }
    return static_cast<PoolId>(last - bases);
  }

  std::vector<Branch> branches_;   ///< by leaves
  std::vector<PoolId> branch_of_;  ///< per pool of the tree, while it is taken apart
  std::vector<PoolId> number_;     ///< the same
  std::vector<Rank> samples_;      ///< each 64th base, so few that they stay in the cache
  LargeVector<Rank> bases_;
  LargeVector<PoolId> parents_;
  LargeVector<PoolId> spills_to_;
  PoolId last_ = kNoPool;
};

}  // namespace tabor::deposition
