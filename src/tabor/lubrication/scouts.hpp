#pragma once

#include <array>

#include "tabor/lubrication/slopes.hpp"

namespace tabor::lubrication {

/// Walk some droplets ahead of the rain and ask the processor to fetch what a droplet will read:
/// the arrays are far larger than a cache and read in random order. A scout takes one step per
/// kStride droplets and reads only what was fetched for it before. Nothing relies on what it sees.
class Scouts {
 public:
  static constexpr std::size_t kStride = 12;
  static constexpr std::size_t kSteps = 4;
  static constexpr std::size_t kAhead = kStride * kSteps;  ///< droplets between first and last step

  Scouts(const Pools& pools, const Slopes& slopes) : pools_(pools), slopes_(slopes) {}

  /// Before droplet `k` falls; starts[k + 1 .. k + kAhead] must be known.
  void advance(const Pixel* starts, std::size_t k);

 private:
  enum class Task { look, judge, choose };
  struct Scout {
    Slopes::Target at = 0;    ///< always a pool or a fork, be it of an earlier scout
    Slopes::Target from = 0;  ///< the full pool or fork whose way is being judged
    Task task = Task::look;
  };

  void step(Scout& scout) const;
  void look(Scout& scout) const;
  void go_to(Scout& scout, Slopes::Target target) const;

  const Pools& pools_;
  const Slopes& slopes_;
  std::array<Scout, 64> ring_{};
  static_assert(kAhead < 64);
};

}  // namespace tabor::lubrication
