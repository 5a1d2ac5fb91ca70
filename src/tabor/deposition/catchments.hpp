#pragma once

#include <vector>

#include "tabor/deposition/pools.hpp"
#include "tabor/deposition/ranks.hpp"

namespace tabor::deposition {

/// Catchments of a surface: how many pixels drain to each lowest place, and the path of overflow.
/// For pools with ordered ties, where a flow path never meets equal heights.
class Catchments {
 public:
  explicit Catchments(Pools& pools);

  /// Number of pixels whose rain reaches this pool first.
  struct Source {
    PoolId pool;
    std::int32_t area;
  };

  /// Lets liquid that lies on the pixels [quanta] run into the pools, once and without rain before.
  void drain(const std::vector<Volume>& liquid);

  /// Returns the first pool that is not full that liquid from `pool` comes to.
  PoolId overflow(PoolId pool);

  /// Returns all pixels by the pools that their rain reaches first.
  const std::vector<Source>& sources() const { return sources_; }

 private:
  Rank rank(Pixel p) const;
  PoolId across_saddle(PoolId full);
  void pour(PoolId first, Volume carried);

  Pools& pools_;
  std::vector<Source> sources_;  ///< of all pixels, by pools
  std::vector<PoolId> passed_;
};

}  // namespace tabor::deposition
