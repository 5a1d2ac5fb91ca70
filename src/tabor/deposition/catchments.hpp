#pragma once

#include <vector>

#include "tabor/deposition/pools.hpp"

namespace tabor::deposition {

/// The dry valleys of a surface: which lowest place each pixel drains to, and how overflow runs on.
/// For pools with ordered ties, where a droplet's path down never meets equal heights.
class Catchments {
 public:
  explicit Catchments(Pools& pools);

  /// The same film [quanta] on every pixel. The result does not depend on the order of pouring, so
  /// that raining a film in parts is the same as raining it at once.
  void rain(Volume film);

 private:
  bool lower(Pixel a, Pixel b) const;
  Pixel downhill(Pixel p) const;
  void drain_all();
  PoolId overflow(PoolId full);
  PoolId across_saddle(PoolId full);

  Pools& pools_;
  std::vector<PoolId> drains_to_;   ///< per pixel: leaf pool, or kOcean
  std::vector<std::int32_t> area_;  ///< per pool: pixels draining to it
  std::vector<PoolId> runs_to_;     ///< per full pool: where its overflow went last, or kNoPool
  std::vector<PoolId> passed_;
};

}  // namespace tabor::deposition
