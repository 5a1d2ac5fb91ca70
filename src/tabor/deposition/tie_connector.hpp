#pragma once

#include <vector>

#include "tabor/deposition/pools.hpp"

namespace tabor::deposition {

/// Turns pools with ordered ties into pools with connected ties.
///
/// Where ties are ordered, a pool that meets others at several saddles of one height merges at one
/// after the other, and the pools between have no height: they begin at their rims. Where ties are
/// connected, such a pool is part of the one above, and so are the pixels at the rim of any pool.
class TieConnector {
 public:
  explicit TieConnector(Pools& pools);

  /// Leaves the liquid and the open children of the pools undefined: Pools::remove_liquid()
  /// follows.
  void connect();

 private:
  static std::size_t place(PoolId id) { return static_cast<std::size_t>(id); }
  PoolId with_height(PoolId id);
  void find_ties();
  void move_pixels();
  void move_children();
  void put_in_order(const Pools::Numbers& numbers);
  void find_bottoms();
  void list_bottoms();

  Pools& to_;
  std::vector<PoolId> into_;  ///< per pool: itself where it has height, or a step up to such a one
  std::vector<bool> is_at_rim_;            ///< per pool: some of its pixels are as high as its rim
  std::vector<std::int32_t> n_below_rim_;  ///< per pool: the others
  std::vector<std::int32_t> n_moved_;  ///< per pool: pixels that it takes from the pools below it
};

}  // namespace tabor::deposition
