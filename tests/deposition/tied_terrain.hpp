#pragma once

#include <algorithm>
#include <cstdlib>

#include "deposition/random_terrain.hpp"

namespace tabor::deposition::testing {

/// How a surface comes to have many pixels of the same height.
enum class TiedKind { steps, terraces, after_rain, plain, comb, line, mirrored };
inline constexpr int kTiedKinds = 7;

/// Numbers drawn one after the other.
class Draw {
 public:
  Draw(std::uint64_t seed, std::uint64_t stream) : random_(seed, stream) {}
  std::int32_t below(std::int64_t n) {
    return static_cast<std::int32_t>(random_.below(count_++, static_cast<std::uint64_t>(n)));
  }
  double uniform() { return random_.uniform(count_++); }

 private:
  CounterRandom random_;
  std::uint64_t count_ = 0;
};

inline Height height_of(TiedKind kind, Pixel x, Pixel y, Height n_steps, Draw& draw) {
  switch (kind) {
    case TiedKind::terraces:
      return (std::abs(x - 4) + std::abs(y - 5)) / 3 % n_steps;
    case TiedKind::plain:
      return draw.below(20) == 0 ? draw.below(n_steps) : 1;
    case TiedKind::comb:
      return x % 2 == 0 && y != 2 ? n_steps : draw.below(3);
    case TiedKind::after_rain:
    case TiedKind::mirrored:
      return draw.below(1000);
    default:
      return draw.below(n_steps);
  }
}

/// The surface of a solid and the liquid of an earlier rain, frozen: its pools are flat.
inline void rain_and_freeze(Terrain& terrain, Draw& draw) {
  const bool is_even = draw.below(2) == 0;
  Pools pools(terrain, is_even ? Ties::ordered : Ties::connected);
  const DoseReached nothing = [](std::size_t, const RainState&) {};
  const Volume film = 1 + draw.below(500);
  if (is_even) {
    rain_evenly(pools, {film}, nothing, {});
  } else {
    rain_droplets(pools, 50, Reading::conserving, 1, {film * terrain.size()}, nothing, {});
  }
  const std::vector<std::int64_t> levels = levels_of(pools);
  for (std::size_t p = 0; p < levels.size(); ++p) {
    terrain.height[p] = static_cast<Height>(levels[p]);
  }
}

/// Four mirror images of a surface: of every saddle there are two or four, and what meets over
/// them meets over all.
inline void mirror(Terrain& terrain) {
  Terrain whole = terrain;
  whole.nx = 2 * terrain.nx;
  whole.ny = 2 * terrain.ny;
  whole.height.clear();
  for (Pixel y = 0; y < whole.ny; ++y) {
    for (Pixel x = 0; x < whole.nx; ++x) {
      const Pixel row = std::min(y, whole.ny - 1 - y);
      const Pixel column = std::min(x, whole.nx - 1 - x);
      whole.height.push_back(terrain.height[static_cast<std::size_t>(row * terrain.nx + column)]);
    }
  }
  terrain = whole;
}

/// A small surface full of ties, drawn from one number.
inline Terrain tied_terrain(std::uint64_t number, Pixel largest_side) {
  Draw draw(number, 78);
  const auto kind = static_cast<TiedKind>(number % kTiedKinds);
  Terrain terrain;
  terrain.nx = 1 + draw.below(largest_side);
  terrain.ny = 1 + draw.below(largest_side);
  if (kind == TiedKind::line) (draw.below(2) == 0 ? terrain.nx : terrain.ny) = 1;
  if (kind == TiedKind::mirrored) {
    terrain.nx = (terrain.nx + 1) / 2;
    terrain.ny = (terrain.ny + 1) / 2;
  }
  terrain.edge = static_cast<Edge>(draw.below(3));
  const Height n_steps = 1 + draw.below(draw.below(2) == 0 ? 3 : 12);
  for (Pixel p = 0; p < terrain.size(); ++p) {
    terrain.height.push_back(height_of(kind, p % terrain.nx, p / terrain.nx, n_steps, draw));
  }
  if (kind == TiedKind::after_rain) rain_and_freeze(terrain, draw);
  if (kind == TiedKind::mirrored) mirror(terrain);
  return terrain;
}

/// Droplets on such a surface, until it is drowned or a while before.
inline RandomCase tied_case(std::uint64_t number, Pixel largest_side) {
  RandomCase result;
  result.terrain = tied_terrain(number, largest_side);
  Draw draw(number, 79);
  const auto [low, high] =
      std::minmax_element(result.terrain.height.begin(), result.terrain.height.end());
  const Height range = 1 + *high - *low;
  const Height droplets[] = {1, 3, 1 + range / 7, range, 5 * range};
  result.reading = static_cast<Reading>(draw.below(2));
  result.droplet = droplets[draw.below(5)];
  result.seed = number;
  result.n_droplets = 1 + draw.below(40 + 6 * result.terrain.size());
  return result;
}

}  // namespace tabor::deposition::testing
