#pragma once

#include <cstdint>

namespace tabor {

/// Generates counter-based random numbers: the k-th number depends on (seed, stream, k) only, so
/// that any thread may draw any of them. Philox 4x32-10 (Salmon et al. 2011, SC'11,
/// doi:10.1145/2063384.2063405).
class CounterRandom {
 public:
  explicit CounterRandom(std::uint64_t seed, std::uint64_t stream = 0)
      : seed_(seed), stream_(stream) {}

  std::uint64_t bits(std::uint64_t k) const;
  double uniform(std::uint64_t k) const;  ///< in [0, 1)
  double normal(std::uint64_t k) const;   ///< mean 0, variance 1 (Box-Muller)
  /// Returns a uniform integer in [0, n), by multiply-shift of 64 random bits (bias below n /
  /// 2^64).
  std::uint64_t below(std::uint64_t k, std::uint64_t n) const;

 private:
  std::uint64_t seed_;
  std::uint64_t stream_;
};

}  // namespace tabor
