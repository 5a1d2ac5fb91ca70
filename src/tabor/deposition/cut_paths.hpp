#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "tabor/deposition/pools.hpp"

// Follows chains of pools that overflow over saddles of several pixels in one step.
namespace tabor::deposition {

/// Full pools that have spilled over a saddle of several pixels. Flow paths are cut there: when
/// another pool at the saddle becomes full, the region of equal height grows and may drain
/// elsewhere, though the level at the end of the path stays. From a cut the path leads to the next
/// one, and so on to a pool that is not full. The whole chain is one step as long as no pool
/// becomes full at any of its saddles. Then the chains through that saddle are forgotten.
class CutPaths {
 public:
  explicit CutPaths(Pools& pools) : pools_(pools) {}

  bool has(PoolId id) const {
    return !number_.empty() && number_[static_cast<std::size_t>(id)] != kNone;
  }

  /// Cuts the paths at a full pool, if they are not cut there.
  void cut(PoolId full);

  /// Returns the path to the end of the chain that begins at a cut; one that is not valid if that
  /// is not known.
  const FlowPath& whole(PoolId cut) const { return cuts_[number(cut)].whole; }

  /// Joins the paths from cuts that a droplet has passed, in this order, to chains.
  void join(const std::vector<PoolId>& passed);

  /// Forgets the chains through saddles at which pools have become full since the last call.
  void follow_pools() {
    if (pools_.has_changed()) forget_changed();
  }

  /// Forgets all cuts and the paths from them; to be called before pools get new numbers.
  void forget();

 private:
  static constexpr std::int32_t kNone = -1;

  struct Cut {
    PoolId pool = kNoPool;
    FlowPath whole;                       ///< to the end of the chain
    std::int32_t next = kNone;            ///< the cut that it leads to
    std::int32_t first_before = kNone;    ///< among before_: cuts that lead to it, or did
    std::int32_t next_at_saddle = kNone;  ///< another cut at the same saddle
  };
  /// Element of the list of cuts that lead to another.
  struct Before {
    std::int32_t cut;
    std::int32_t next;
  };

  std::size_t number(PoolId id) const {
    return static_cast<std::size_t>(number_[static_cast<std::size_t>(id)]);
  }
  void forget_changed();
  void forget_chains_through(std::int32_t cut);

  Pools& pools_;
  std::vector<std::int32_t> number_;  ///< per pool, of its cut; empty until there is one
  std::vector<Cut> cuts_;
  std::vector<Before> before_;
  std::unordered_map<PoolId, std::int32_t> first_at_saddle_;  ///< per parent of cut pools
  std::vector<std::int32_t> open_;
};

}  // namespace tabor::deposition
