// Surfaces full of equal heights: every model, edge, reading and dose, against the rule taken word
// for word, against the same surface whose ties are broken, and against what holds of any film.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "deposition/agreement.hpp"
#include "deposition/tied_terrain.hpp"

namespace tabor::deposition::testing {
namespace {

TEST(TiedSurfaces, TakeDropletsByTheRuleTakenWordForWord) {
  std::uint64_t n_wrong = 0;
  constexpr std::uint64_t kCases = 3000;
  for (std::uint64_t number = 0; number < kCases; ++number) {
    const bool agrees = fast_engine_agrees(tied_case(number, 11));
    EXPECT_TRUE(agrees || n_wrong > 0) << "case " << number;  // the first alone is named
    n_wrong += agrees ? 0 : 1;
  }
  EXPECT_EQ(n_wrong, 0U);
}

/// The surface of solid and liquid after each of these films, without droplets.
std::vector<std::vector<std::int64_t>> levels_after(const Terrain& terrain,
                                                    const std::vector<Volume>& films) {
  Pools pools(terrain, Ties::ordered);
  std::vector<std::vector<std::int64_t>> levels;
  rain_evenly(pools, films,
              [&](std::size_t, const RainState&) { levels.push_back(levels_of(pools)); }, {});
  return levels;
}

/// From a trace to a flood a thousand times as deep as the surface is high.
std::vector<Volume> films_for(Height range) {
  std::vector<Volume> films;
  for (const double share : {1e-9, 1e-3, 0.02, 0.1, 0.3, 0.5, 0.8, 1.0, 2.0, 1000.0}) {
    films.push_back(std::llround(share * range));
  }
  return films;
}

// Of two equal heights the lower pixel number counts as lower: a surface on which it is lower, by
// less than any step, fills alike. Each height differs by less than n quanta, so the volume that
// runs another way is less than n^2, and no level differs by more than that.
TEST(TiedSurfaces, FillAsWithTheirTiesBroken) {
  for (std::uint64_t number = 0; number < 2000; ++number) {
    Terrain tied = tied_terrain(number, 14);
    const auto [low, high] = std::minmax_element(tied.height.begin(), tied.height.end());
    const Height lowest = *low;
    const Height scale = 2000000000 / (1 + *high - lowest);  // quanta per step
    for (Height& height : tied.height) height = (height - lowest) * scale;
    Terrain broken = tied;
    for (Pixel p = 0; p < broken.size(); ++p) broken.height[static_cast<std::size_t>(p)] += p;
    const std::vector<Volume> films =
        films_for(*std::max_element(tied.height.begin(), tied.height.end()) + 1);
    const auto levels = levels_after(tied, films);
    const auto expected = levels_after(broken, films);
    const std::int64_t most = Volume{tied.size()} * (tied.size() + 1);
    ASSERT_LT(most, scale / 10);  // far less than a step
    std::int64_t worst = 0;
    for (std::size_t i = 0; i < films.size(); ++i) {
      for (std::size_t p = 0; p < levels[i].size(); ++p) {
        worst = std::max(worst, std::abs(levels[i][p] - expected[i][p]));
      }
    }
    ASSERT_LE(worst, most) << "case " << number;
  }
}

constexpr double kStep = 0.01e-6;  // [m]

struct Surface {
  Field height;
  Grid grid;
  Edge edge = Edge::closed;
};

Surface surface_of(const Terrain& terrain) {
  Field height(terrain.ny, terrain.nx);
  for (Pixel p = 0; p < terrain.size(); ++p) {
    height.data()[p] = kStep * terrain.height[static_cast<std::size_t>(p)];
  }
  return {height, {terrain.nx, terrain.ny, 1e-6 * terrain.nx, 1e-6 * terrain.ny}, terrain.edge};
}

/// Liquid stands level, and nowhere above what is beside it.
bool lies_still(const Film& film, const Surface& surface, const Terrain& terrain) {
  const Field top = surface.height + film.thickness;
  const double same = 4 * film.height_quantum + 1e-12 * top.abs().maxCoeff();
  bool is_still = film.thickness.minCoeff() >= 0 && film.thickness.allFinite();
  for (Pixel p = 0; p < terrain.size(); ++p) {
    if (!(film.thickness.data()[p] > 0)) continue;
    for_each_neighbour(terrain, p, [&](Pixel q) {
      is_still = is_still && (q == kOutside ? false : top.data()[q] >= top.data()[p] - same);
    });
  }
  return is_still;
}

/// What is rained is on the surface or has left it; less than a quantum per pixel may not show yet.
bool is_conserved(const Film& film, const Surface& surface) {
  const double shown = film.thickness.sum() * surface.grid.pixel_area();
  const double hidden = film.height_quantum * surface.grid.area();
  const double rounding = 1e-9 * film.dosed_volume;
  return std::abs(film.deposited_volume + film.lost_volume - film.dosed_volume) <= rounding &&
         std::abs(shown - film.deposited_volume) <= hidden + rounding &&
         (film.lost_volume == 0 || surface.edge == Edge::open);
}

// 1e-12 to 1e6 g/m^2 of oil.
TEST(TiedSurfaces, TakeAnyDoseOfAnyModelOnAnyEdge) {
  for (std::uint64_t number = 0; number < 240; ++number) {
    Terrain terrain = tied_terrain(number, 12);
    Draw draw(number, 80);
    Dose dose;
    for (int i = 0; i < 6; ++i) {
      const double density = std::pow(10.0, -15 + 18 * draw.uniform());  // [kg/m^2]
      dose.mean_films.push_back(mean_film(density, 900));
    }
    dose.mean_films.push_back(mean_film(1e3, 900));
    dose.droplet_height = draw.below(2) == 0 ? 1e-7 : 3e-8;
    dose.reading = static_cast<Reading>(draw.below(2));
    for (const Model model : {Model::limit, Model::droplets, Model::bottom_fill, Model::uniform}) {
      for (const Edge edge : {Edge::closed, Edge::periodic, Edge::open}) {
        terrain.edge = edge;
        const Surface surface = surface_of(terrain);
        dose.model = model;
        dose.edge = edge;
        for (const Film& film : deposit(surface.height, surface.grid, dose)) {
          const bool is_literal = model == Model::droplets && dose.reading == Reading::literal;
          EXPECT_TRUE(is_literal || is_conserved(film, surface))
              << "case " << number << ' ' << name(model) << ' ' << name(edge) << ' '
              << film.mean_film;
          const bool runs = model == Model::limit || model == Model::droplets;
          EXPECT_TRUE(!runs || lies_still(film, surface, terrain))
              << "case " << number << ' ' << name(model) << ' ' << name(edge) << ' '
              << film.mean_film;
        }
      }
    }
  }
}

/// Waves with noise, by the numbers of its pixels [m].
Field rough_waves(Pixel side) {
  const CounterRandom random(5);
  Field height(side, side);
  for (Index y = 0; y < side; ++y) {
    for (Index x = 0; x < side; ++x) {
      const auto noise = random.uniform(static_cast<std::uint64_t>(y * 4096 + x));
      height(y, x) = 1e-6 * (noise + std::sin(0.31 * static_cast<double>(x)) +
                             std::cos(0.23 * static_cast<double>(y)));
    }
  }
  return height;
}

/// Places that droplets have looked at, per droplet and pixel.
double looks_on(const Terrain& terrain, int droplets_per_pixel = 5) {
  Pools pools(terrain, Ties::connected);
  const auto droplet = static_cast<Height>(std::llround(1e-7 / terrain.quantum));
  RainState last;
  rain_droplets(pools, droplet, Reading::conserving, 1,
                {Volume{droplets_per_pixel} * droplet * terrain.size()},
                [&](std::size_t, const RainState& state) { last = state; }, {});
  return static_cast<double>(last.n_looks) / static_cast<double>(last.n_droplets + terrain.size());
}

/// On a rough surface with the film of an earlier rain: pools all over it, flat, many of them full.
double looks_on_flat_pools(Pixel side, double earlier_film) {
  Field height = rough_waves(side);
  const Grid grid{side, side, 1e-6 * side, 1e-6 * side};
  const Dose earlier{.mean_films = {earlier_film}, .model = Model::limit};
  height += deposit(height, grid, earlier).front().thickness;
  return looks_on(quantise(height, Edge::closed));
}

// A count, the same on every machine: as many looks per droplet on sixteen times as many pixels.
TEST(FlatPools, CostADropletAsMuchOnALargeSurfaceAsOnASmallOne) {
  for (const double film : {0.2e-6, 0.5e-6, 1e-6}) {
    const double few = looks_on_flat_pools(64, film);
    const double many = looks_on_flat_pools(256, film);
    EXPECT_LT(many, 1.5 * few) << film;
    EXPECT_LT(many, 20) << film;
  }
}

// Pools of mirror images meet over two or four saddles of equal height.
TEST(MirroredSurfaces, CostADropletLittleMoreThanOneOfTheImages) {
  for (const Edge edge : {Edge::closed, Edge::periodic}) {
    Terrain terrain = quantise(rough_waves(128), edge);
    const double one = looks_on(terrain);
    mirror(terrain);
    EXPECT_LT(looks_on(terrain), 2 * one);
  }
}

// Mirrored, a slope with pits has a saddle of two pixels between each pit and the next.
TEST(MirroredSurfaces, CostADropletNoMoreWhereChainsOfPoolsAreFull) {
  const auto looks_on_slope = [](Pixel side) {
    Field height = rough_waves(side);
    for (Index x = 0; x < side; ++x) height.col(x) += 0.1e-6 * static_cast<double>(x);
    Terrain terrain = quantise(height, Edge::closed);
    mirror(terrain);
    return looks_on(terrain, 10);
  };
  const double few = looks_on_slope(64);
  const double many = looks_on_slope(256);
  EXPECT_LT(many, 2 * few);
  EXPECT_LT(many, 10);
}

// On a tilted surface one pool takes in the others one after the other, each a step further from
// the pool that holds all.
TEST(GrowingPool, CostsADropletAsMuchOnALargeSurfaceAsOnASmallOne) {
  const auto looks_when_nearly_full = [](Pixel side) {
    Field height = rough_waves(side);
    for (Index x = 0; x < side; ++x) {
      height.col(x) += 3e-6 * static_cast<double>(x) / static_cast<double>(side);
    }
    return looks_on(quantise(height, Edge::closed), 30);
  };
  const double few = looks_when_nearly_full(64);
  const double many = looks_when_nearly_full(256);
  EXPECT_LT(many, 1.5 * few);
  EXPECT_LT(many, 10);
}

}  // namespace
}  // namespace tabor::deposition::testing
