#include "tabor/core/random.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace tabor {
namespace {

/// Ten rounds of Philox 4x32 (Salmon et al. 2011, section 3.3 and table 2).
std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                    std::array<std::uint32_t, 2> key) {
  constexpr std::uint64_t multiplier_0 = 0xD2511F53;
  constexpr std::uint64_t multiplier_1 = 0xCD9E8D57;
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t product_0 = multiplier_0 * counter[0];
    const std::uint64_t product_1 = multiplier_1 * counter[2];
    counter = {static_cast<std::uint32_t>(product_1 >> 32) ^ counter[1] ^ key[0],
               static_cast<std::uint32_t>(product_1),
               static_cast<std::uint32_t>(product_0 >> 32) ^ counter[3] ^ key[1],
               static_cast<std::uint32_t>(product_0)};
    key[0] += 0x9E3779B9;
    key[1] += 0xBB67AE85;
  }
  return counter;
}

std::uint64_t joined(std::uint32_t low, std::uint32_t high) {
  return (static_cast<std::uint64_t>(high) << 32) | low;
}

double unit_interval(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1.0p-53; }

std::array<std::uint32_t, 4> draw(std::uint64_t seed, std::uint64_t stream, std::uint64_t k) {
  return philox({static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(k >> 32),
                 static_cast<std::uint32_t>(stream), static_cast<std::uint32_t>(stream >> 32)},
                {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)});
}

}  // namespace

std::uint64_t CounterRandom::bits(std::uint64_t k) const {
  const auto words = draw(seed_, stream_, k);
  return joined(words[0], words[1]);
}

double CounterRandom::uniform(std::uint64_t k) const { return unit_interval(bits(k)); }

double CounterRandom::normal(std::uint64_t k) const {
  const auto words = draw(seed_, stream_, k);
  const double radius = std::sqrt(-2 * std::log1p(-unit_interval(joined(words[0], words[1]))));
  return radius * std::cos(2 * std::numbers::pi * unit_interval(joined(words[2], words[3])));
}

std::uint64_t CounterRandom::below(std::uint64_t k, std::uint64_t n) const {
  __extension__ using Wide = unsigned __int128;
  return static_cast<std::uint64_t>((static_cast<Wide>(bits(k)) * n) >> 64);
}

}  // namespace tabor
