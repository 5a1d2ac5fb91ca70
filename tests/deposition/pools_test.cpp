// The tree of pools with ordered ties, and where pixels drain, against flooding pixel by pixel.
#include "tabor/deposition/pools.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "deposition/random_terrain.hpp"
#include "deposition/tied_terrain.hpp"
#include "support/validation.hpp"

namespace tabor::deposition::testing {
namespace {

/// The tree that flooding finds when it drowns one pixel after the other.
struct Flooding {
  std::vector<int> pool_of;          ///< per pixel
  std::map<int, int> parent;         ///< per pool, of those that have one
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
  constexpr int kSea = -1;
  Flooding found{std::vector<int>(ascending.size(), -2), {}, std::vector<Pixel>(ascending.size())};
  const auto top = [&](int pool) {
    while (found.parent.contains(pool)) pool = found.parent.at(pool);
    return pool;
  };
  int n_pools = 0;
  for (const Pixel p : ascending) {
    std::set<int> meeting;
    Pixel lowest = p;
    for_each_neighbour(terrain, p, [&](Pixel q) {
      if (!is_lower(terrain, q, p)) return;
      meeting.insert(top(q == kOutside ? kSea : found.pool_of[static_cast<std::size_t>(q)]));
      if (is_lower(terrain, q, lowest)) lowest = q;
    });
    int& pool = found.pool_of[static_cast<std::size_t>(p)];
    pool = meeting.size() == 1 ? *meeting.begin() : n_pools++;
    if (meeting.size() > 1) {
      for (const int child : meeting) found.parent[child] = pool;
    }
    found.lowest_beside[static_cast<std::size_t>(p)] = lowest;
  }
  return found;
}

/// True if the pools have the same pixels, parents, heights and slopes under other numbers.
bool is_the_same(const Terrain& terrain, const Flooding& expected) {
  const Pools pools(terrain, Ties::ordered, true);
  std::map<PoolId, int> number;  // what each pool is called there
  if (terrain.edge == Edge::open) number[kOcean] = -1;
  bool same = true;
  for (Pixel p = 0; p < terrain.size(); ++p) {
    const int there = expected.pool_of[static_cast<std::size_t>(p)];
    same &= number.try_emplace(pools.pool_at(p), there).first->second == there;
    const Pixel next = expected.lowest_beside[static_cast<std::size_t>(p)];
    const PoolId drain = next == kOutside ? kOcean
                         : next == p      ? pools.pool_at(p)
                                          : pools.drains_to(next);
    same &= pools.drains_to(p) == drain;
  }
  same &= number.size() == pools.count();
  for (const auto& [pool, there] : number) {
    const PoolId parent = pools[pool].parent;
    const auto found = expected.parent.find(there);
    same &= (parent == kNoPool) == (found == expected.parent.end());
    if (parent != kNoPool && same) same &= number.at(parent) == found->second;
    const auto [begin, end] = pools.places_of(pool);
    for (std::int32_t place = begin; place < end; ++place) {
      same &= pools.pool_at(pools.pixel_at(place)) == pool;
      same &= pools.height_at(place) == pools.height(pools.pixel_at(place));
      same &= place == begin || pools.height_at(place - 1) <= pools.height_at(place);
    }
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

}  // namespace
}  // namespace tabor::deposition::testing
