// Runs of pixels and the regions that they make.
#include "tabor/numerics/runs.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <tuple>

#include "tabor/core/random.hpp"
#include "tabor/numerics/disjoint_sets.hpp"

namespace tabor::numerics {
namespace {

/// A map of '#' and '.', row by row.
Runs runs_of(const std::vector<std::string>& rows) {
  const auto n_columns = static_cast<Index>(rows[0].size());
  return {static_cast<Index>(rows.size()), n_columns, [&](Index i) {
            return rows[static_cast<std::size_t>(i / n_columns)]
                       [static_cast<std::size_t>(i % n_columns)] == '#';
          }};
}

using Joins = std::set<std::tuple<std::size_t, std::size_t, int, int>>;

Joins joins_of(const Runs& runs, bool periodic) {
  Joins joins;
  runs.join_neighbours(periodic, [&](std::size_t a, std::size_t b, int x, int y) {
    joins.insert({a, b, x, y});
  });
  return joins;
}

TEST(Runs, StandInTheOrderOfTheirPixels) {
  const Runs runs = runs_of({"##.#", "....", ".###"});
  ASSERT_EQ(runs.size(), 3U);
  EXPECT_EQ(runs[0].begin, 0);
  EXPECT_EQ(runs[0].end, 2);
  EXPECT_EQ(runs[1].begin, 3);
  EXPECT_EQ(runs[1].end, 4);
  EXPECT_EQ(runs[2].begin, 9);
  EXPECT_EQ(runs[2].end, 12);
  EXPECT_EQ(runs.first_of(1), runs.first_of(2));
  EXPECT_EQ(runs_of({"...."}).size(), 0U);
}

TEST(Runs, TouchSideBySide) {
  const Runs runs = runs_of({"##.#", ".#.#", "#..."});
  EXPECT_EQ(joins_of(runs, false), (Joins{{0, 2, 0, 0}, {1, 3, 0, 0}}));
  EXPECT_EQ(joins_of(runs, true), (Joins{{1, 0, 1, 0}, {0, 2, 0, 0}, {1, 3, 0, 0}, {4, 0, 0, 1}}));
}

TEST(Runs, ThatFillARowOrAColumnTouchThemselves) {
  EXPECT_EQ(joins_of(runs_of({"..", "##"}), true), (Joins{{0, 0, 1, 0}}));
  EXPECT_EQ(joins_of(runs_of({"#.#"}), true), (Joins{{1, 0, 1, 0}, {0, 0, 0, 1}, {1, 1, 0, 1}}));
  EXPECT_TRUE(joins_of(runs_of({"###"}), false).empty());
}

TEST(Runs, KnowTheBordersTheyReach) {
  const Runs runs = runs_of({".#..", ".#.#", "#.#.", "####"});
  const std::vector<int> expected{Runs::kTop,  0, Runs::kRight,
                                  Runs::kLeft, 0, Runs::kLeft | Runs::kRight | Runs::kBottom};
  ASSERT_EQ(runs.size(), expected.size());
  for (std::size_t run = 0; run < runs.size(); ++run) {
    EXPECT_EQ(runs.sides(run), expected[run]) << run;
  }
  EXPECT_EQ(runs_of({"#"}).sides(0), Runs::kLeft | Runs::kRight | Runs::kTop | Runs::kBottom);
}

/// As many regions as joining pixel by pixel gives.
TEST(Runs, MakeTheRegionsOfTheirPixels) {
  const CounterRandom random(11);
  for (std::uint64_t map = 0; map < 200; ++map) {
    const Index ny = 1 + static_cast<Index>(map % 7);
    const Index nx = 1 + static_cast<Index>(map % 11);
    const auto belongs = [&](Index i) {
      return random.uniform(map * 1000 + static_cast<std::uint64_t>(i)) < 0.55;
    };
    for (const bool periodic : {false, true}) {
      const Runs runs(ny, nx, belongs);
      DisjointSets<std::size_t> by_run(runs.size());
      runs.join_neighbours(periodic,
                           [&](std::size_t a, std::size_t b, int, int) { by_run.join(a, b); });
      DisjointSets<std::size_t> by_pixel(static_cast<std::size_t>(ny * nx));
      std::size_t n_out = 0;
      const auto join = [&](Index y, Index x, Index other_y, Index other_x) {
        const Index a = y * nx + x;
        const Index b = other_y % ny * nx + other_x % nx;
        const bool is_inside = periodic || (other_y < ny && other_x < nx);
        if (is_inside && belongs(a) && belongs(b)) {
          by_pixel.join(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
        }
      };
      for (Index y = 0; y < ny; ++y) {
        for (Index x = 0; x < nx; ++x) {
          n_out += belongs(y * nx + x) ? 0 : 1;
          join(y, x, y, x + 1);
          join(y, x, y + 1, x);
        }
      }
      EXPECT_EQ(by_run.n_sets(), by_pixel.n_sets() - n_out) << map << periodic;
    }
  }
}

}  // namespace
}  // namespace tabor::numerics
