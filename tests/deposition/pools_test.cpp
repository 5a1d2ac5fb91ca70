// The tree of pools with ordered ties, and where pixels drain, against flooding pixel by pixel.
#include "tabor/deposition/pools.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "deposition/random_terrain.hpp"
#include "deposition/tied_terrain.hpp"
#include "support/validation.hpp"
#include "tabor/core/parallel.hpp"

namespace tabor::deposition::testing {
namespace {

constexpr int kSea = 0;  // number of the ocean, with an open edge or not
constexpr int kNone = -1;

/// The tree that flooding finds when it drowns one pixel after the other.
struct Flooding {
  std::vector<int> pool_of;          ///< per pixel
  std::vector<int> parent{kNone};    ///< per pool
  std::vector<Pixel> lowest_beside;  ///< per pixel: its lowest lower neighbour, or itself
};

bool is_lower(const Terrain& terrain, Pixel a, Pixel b) {
  if (a == kOutside || b == kOutside) return a == kOutside && b != kOutside;
  const Height height_a = terrain.height[static_cast<std::size_t>(a)];
  const Height height_b = terrain.height[static_cast<std::size_t>(b)];
  return height_a < height_b || (height_a == height_b && a < b);
}

Flooding flood(const Terrain& terrain) {
  std::vector<Pixel> ascending(static_cast<std::size_t>(terrain.size()));
  std::iota(ascending.begin(), ascending.end(), 0);
  std::sort(ascending.begin(), ascending.end(),
            [&](Pixel a, Pixel b) { return is_lower(terrain, a, b); });
  Flooding found{.pool_of = std::vector<int>(ascending.size()),
                 .lowest_beside = std::vector<Pixel>(ascending.size())};
  std::vector<int> up{kSea};  // per pool: a step to the largest that holds it
  const auto top = [&up](int pool) {
    const auto step = [&up](int of) -> int& { return up[static_cast<std::size_t>(of)]; };
    while (step(pool) != pool) pool = step(pool) = step(step(pool));
    return pool;
  };
  for (const Pixel p : ascending) {
    std::set<int> meeting;
    Pixel lowest = p;
    for_each_neighbour(terrain, p, [&](Pixel q) {
      if (!is_lower(terrain, q, p)) return;
      meeting.insert(top(q == kOutside ? kSea : found.pool_of[static_cast<std::size_t>(q)]));
      if (is_lower(terrain, q, lowest)) lowest = q;
    });
    found.lowest_beside[static_cast<std::size_t>(p)] = lowest;
    int& pool = found.pool_of[static_cast<std::size_t>(p)];
    pool = meeting.size() == 1 ? *meeting.begin() : static_cast<int>(up.size());
    if (meeting.size() == 1) continue;
    up.push_back(pool);
    found.parent.push_back(kNone);
    for (const int child : meeting) {
      found.parent[static_cast<std::size_t>(child)] = up[static_cast<std::size_t>(child)] = pool;
    }
  }
  return found;
}

/// True if these pools have the same pixels, parents and slopes under other numbers.
bool has_tree_of(const Pools& pools, const Flooding& expected) {
  const Terrain& terrain = pools.terrain();
  std::vector<int> number(pools.count(), kNone);  // what each pool is called there
  if (terrain.edge == Edge::open) number[kOcean] = kSea;
  bool same = true;
  for (Pixel p = 0; p < terrain.size(); ++p) {
    const int there = expected.pool_of[static_cast<std::size_t>(p)];
    int& known = number[static_cast<std::size_t>(pools.pool_at(p))];
    same &= known == kNone || known == there;
    known = there;
    const Pixel next = expected.lowest_beside[static_cast<std::size_t>(p)];
    const PoolId drain = next == kOutside ? kOcean
                         : next == p      ? pools.pool_at(p)
                                          : pools.drains_to(next);
    same &= pools.drains_to(p) == drain;
  }
  for (std::size_t id = 0; id < number.size() && same; ++id) {
    const PoolId parent = pools[static_cast<PoolId>(id)].parent;
    const int there = expected.parent[static_cast<std::size_t>(number[id])];
    same &= there == (parent == kNoPool ? kNone : number[static_cast<std::size_t>(parent)]);
  }
  const std::set<int> different(number.begin(), number.end());
  return same && different.size() == number.size() && !different.contains(kNone);
}

/// True if each pool lists its own pixels, ascending, and heights below its rim.
bool has_its_pixels(const Pools& pools, bool lists_pixels) {
  std::vector<Pixel> n_of(pools.count(), 0);
  for (Pixel p = 0; p < pools.terrain().size(); ++p) {
    ++n_of[static_cast<std::size_t>(pools.pool_at(p))];
  }
  bool same = true;
  for (PoolId id = 0; id < static_cast<PoolId>(pools.count()); ++id) {
    const auto [begin, end] = pools.places_of(id);
    same &= end - begin == n_of[static_cast<std::size_t>(id)];
    for (std::int32_t place = begin; place < end; ++place) {
      same &= place == begin || pools.height_at(place - 1) <= pools.height_at(place);
      if (!lists_pixels) continue;
      same &= pools.pool_at(pools.pixel_at(place)) == id;
      same &= pools.height_at(place) == pools.height(pools.pixel_at(place));
    }
    const PoolId parent = pools[id].parent;
    same &= end == begin || pools.height_at(end - 1) <= pools.height_at(end);
    same &= (parent == kNoPool) == (pools.height_at(end) == kNoRim);
  }
  return same;
}

bool is_the_same(const Terrain& terrain, const Flooding& expected) {
  bool same = true;
  for (const bool lists_pixels : {false, true}) {
    const Pools pools(terrain, Ties::ordered, lists_pixels);
    same &= has_tree_of(pools, expected) && has_its_pixels(pools, lists_pixels);
  }
  return same;
}

void expect_floods(const std::string& surfaces, std::uint64_t n,
                   const std::function<Terrain(std::uint64_t)>& terrain_of) {
  std::uint64_t n_wrong = 0;
  for (std::uint64_t number = 0; number < n; ++number) {
    const Terrain terrain = terrain_of(number);
    const bool same = is_the_same(terrain, flood(terrain));
    EXPECT_TRUE(same || n_wrong > 0) << "case " << number;  // the first alone is named
    n_wrong += same ? 0 : 1;
  }
  test::expect_within("Deposition", fmt::format("{} {}, all edges", n, surfaces),
                      "surfaces with another tree of pools or slope", "flooding pixel by pixel",
                      static_cast<double>(n_wrong), 0);
}

TEST(Pools, AreThoseOfFlooding) {
  expect_floods("random surfaces up to 12 x 12", 4000,
                [](std::uint64_t number) { return random_case(number, 12).terrain; });
  expect_floods("surfaces full of ties up to 14 x 14", 2000,
                [](std::uint64_t number) { return tied_terrain(number, 14); });
}

// Long branches are searched by samples: a sheet has one of hundreds of pools.
TEST(Pools, AreThoseOfFloodingOnSheets) {
  expect_floods("random sheets up to 90 x 90", 30,
                [](std::uint64_t number) { return random_case(number, 90).terrain; });
}

/// Noise on a slope, both of this height: many pools on the one, few large ones on the other.
Terrain noise_on_slope(Pixel side, Height noise, Height slope) {
  const CounterRandom random(7, 78);
  Terrain terrain{side, side, Edge::open, {}, 1};
  for (Pixel p = 0; p < terrain.size(); ++p) {
    const auto drawn =
        random.below(static_cast<std::uint64_t>(p), static_cast<std::uint64_t>(noise) + 1);
    terrain.height.push_back(static_cast<Height>(drawn) + slope * (p % side + p / side));
  }
  return terrain;
}

// So large that pixels, pools, saddles and the pixels of one pool are sorted by several threads.
TEST(Pools, AreThoseOfFloodingOnAnyNumberOfThreads) {
  const int n_before = thread_count();
  for (const Terrain& terrain : {noise_on_slope(512, 1000000, 0), noise_on_slope(300, 3, 5)}) {
    const Flooding expected = flood(terrain);
    for (const int n : {1, 3}) {
      set_thread_count(n);
      EXPECT_TRUE(is_the_same(terrain, expected)) << terrain.nx << " pixels, " << n << " threads";
    }
  }
  set_thread_count(n_before);
}

}  // namespace
}  // namespace tabor::deposition::testing
