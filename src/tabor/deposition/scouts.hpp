#pragma once

#include <array>

#include "tabor/deposition/slopes.hpp"

namespace tabor::deposition {

/// Walk some droplets ahead of the rain and ask the processor to fetch what a droplet will read:
/// the arrays are far larger than a cache and read in random order. Droplets are scouted in blocks;
/// a block takes one step, reading only what was fetched for it before, while the block before it
/// takes the next. Nothing relies on what scouts see.
class Scouts {
 public:
  static constexpr std::size_t kBlock = 64;
  static constexpr std::size_t kSteps = 9;
  static constexpr std::size_t kAhead = kBlock * kSteps;  ///< droplets known beyond the present one

  Scouts(Pools& pools, Slopes& slopes) : pools_(pools), slopes_(slopes) {}

  /// Forgets where scouts stand: pools and forks have new numbers.
  void start() { ring_ = {}; }

  /// Before the droplets starts[0 .. kBlock) fall; starts[kBlock .. kBlock + kAhead) follow them.
  void advance(const Pixel* starts);

 private:
  using Target = Slopes::Target;
  struct Scout {
    Target from = 0;  ///< where its way is remembered
    Target at = 0;    ///< where that ends, or the saddle it will cross
  };
  struct Block {
    std::array<Scout, kBlock> scouts;
    std::size_t size = 0;
    void clear() { size = 0; }
    void keep(const Scout& scout) { scouts[size++] = scout; }
    std::span<Scout> all() { return {scouts.data(), size}; }
  };

  Block& block(std::size_t steps_ahead) { return ring_[(first_ + steps_ahead) % ring_.size()]; }
  void land(Block& block, const Pixel* starts) const;
  void run(Block& block) const;
  void judge(Block& block) const;
  void leave(Block& block) const;
  void cross(Block& block) const;
  void prefetch(Target target) const;
  Target next(Target at) const;

  Pools& pools_;
  Slopes& slopes_;
  std::array<Block, kSteps> ring_{};
  std::size_t first_ = 0;
};

}  // namespace tabor::deposition
