#include "tabor/topography/digest.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include "tabor/core/parallel.hpp"

namespace tabor::topography {
namespace {

constexpr std::uint64_t kFactor =
    0x9e3779b97f4a7c15;  // odd, bits without a pattern: 2^64 / golden ratio

/// The next state of a digest. For one state it maps different words to different states.
std::uint64_t mixed(std::uint64_t state, std::uint64_t word) {
  state = (state ^ word) * kFactor;
  return state ^ (state >> 29);
}

std::uint64_t bits_of(double value) { return std::bit_cast<std::uint64_t>(value + 0.0); }

/// Four digests side by side, as one would wait for its own multiplications.
std::uint64_t digest_of_block(const double* values, Index n) {
  std::array<std::uint64_t, 4> lanes = {1, 2, 3, 4};
  Index i = 0;
  for (; i + 4 <= n; i += 4) {
    for (Index k = 0; k < 4; ++k) {
      auto& lane = lanes[static_cast<std::size_t>(k)];
      lane = mixed(lane, bits_of(values[i + k]));
    }
  }
  std::uint64_t digest = static_cast<std::uint64_t>(n);
  for (; i < n; ++i) digest = mixed(digest, bits_of(values[i]));
  for (const std::uint64_t lane : lanes) digest = mixed(digest, lane);
  return digest;
}

}  // namespace

std::uint64_t digest_of(const Field& height, const Grid& grid) {
  std::vector<std::uint64_t> blocks(
      static_cast<std::size_t>((height.size() + kBlock - 1) / kBlock));
  parallel_for(height.size(), kBlock, [&](Index begin, Index end) {
    blocks[static_cast<std::size_t>(begin / kBlock)] =
        digest_of_block(height.data() + begin, end - begin);
  });
  std::uint64_t digest = kFactor;
  for (const Index count : {height.rows(), height.cols(), grid.ny, grid.nx}) {
    digest = mixed(digest, static_cast<std::uint64_t>(count));
  }
  for (const double length : {grid.lx, grid.ly}) digest = mixed(digest, bits_of(length));
  for (const std::uint64_t block : blocks) digest = mixed(digest, block);
  return std::max<std::uint64_t>(1, digest);
}

}  // namespace tabor::topography
