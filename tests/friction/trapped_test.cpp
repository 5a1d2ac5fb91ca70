#include "tabor/friction/trapped.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/core/random.hpp"

namespace tabor::friction {
namespace {

/// '#' is contact; '.' is a dry gap of 1 um; a digit is a gap of 1 um with that many 0.1 um of
/// liquid; letters a, b, ... are contact with 0.1, 0.2, ... um of liquid.
struct Map {
  explicit Map(const std::vector<std::string>& rows) {
    const auto ny = static_cast<Index>(rows.size());
    const auto nx = static_cast<Index>(rows.front().size());
    grid = {nx, ny, static_cast<double>(nx), static_cast<double>(ny)};
    contact.resize(ny, nx);
    film.resize(ny, nx);
    gap.resize(ny, nx);
    for (Index y = 0; y < ny; ++y) {
      for (Index x = 0; x < nx; ++x) {
        const char c = rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)];
        const bool letter = c >= 'a' && c <= 'z';
        contact(y, x) = c == '#' || letter;
        gap(y, x) = contact(y, x) ? 0 : 1e-6;
        film(y, x) = letter ? 1e-7 * (c - 'a' + 1) : c >= '0' && c <= '9' ? 1e-7 * (c - '0') : 0;
      }
    }
  }
  TrappedLiquid solve(bool periodic) const {
    return trapped_liquid(contact, film, gap, grid, periodic);
  }
  Grid grid;
  Mask contact;
  Field film;
  Field gap;
};

TEST(TrappedLiquid, ARingOfContactHoldsItsLiquid) {
  const TrappedLiquid liquid = Map({".....", ".###.", ".#3#.", ".###.", "..1.."}).solve(false);
  ASSERT_EQ(liquid.regions.size(), 2u);
  EXPECT_FALSE(liquid.regions[0].trapped);
  EXPECT_EQ(liquid.regions[0].n_pixels, 16);
  EXPECT_TRUE(liquid.regions[1].trapped);
  EXPECT_EQ(liquid.regions[1].first_pixel, 12);
  EXPECT_DOUBLE_EQ(liquid.regions[1].liquid_volume, 3e-7);
  EXPECT_DOUBLE_EQ(liquid.regions[1].gap_volume, 1e-6);
  EXPECT_DOUBLE_EQ(liquid.trapped_fraction, 0.75);
  EXPECT_DOUBLE_EQ(liquid.escaping_fraction, 0.25);
}

TEST(TrappedLiquid, ADiagonalGapIsClosed) {
  EXPECT_DOUBLE_EQ(Map({"....", ".##.", ".#1#", "..#."}).solve(false).trapped_fraction, 1);
  EXPECT_DOUBLE_EQ(Map({"....", ".#..", ".#1#", "..#."}).solve(false).trapped_fraction, 0);
}

TEST(TrappedLiquid, LiquidUnderContactIsCountedApart) {
  const TrappedLiquid liquid = Map({"###", "a1b", "###"}).solve(false);
  EXPECT_DOUBLE_EQ(liquid.under_contact_fraction, 0.75);
  EXPECT_DOUBLE_EQ(liquid.trapped_fraction, 0.25);
}

TEST(TrappedLiquid, ABorderPixelIsOpenOnlyWithoutPeriodicity) {
  const Map map({"1##", "###", "###"});
  EXPECT_EQ(map.solve(false).escaping_fraction, 1);
  EXPECT_EQ(map.solve(true).trapped_fraction, 1);
}

TEST(TrappedLiquid, APeriodicPocketAcrossTheSeamIsOneRegionAndTrapped) {
  const TrappedLiquid liquid = Map({"1#1", "###", "1#1"}).solve(true);
  ASSERT_EQ(liquid.regions.size(), 1u);
  EXPECT_EQ(liquid.regions[0].n_pixels, 4);
  EXPECT_EQ(liquid.trapped_fraction, 1);
}

TEST(TrappedLiquid, AGrooveThroughAPeriodicCellIsOpen) {
  EXPECT_EQ(Map({"###", "111", "###"}).solve(true).escaping_fraction, 1);
  EXPECT_EQ(Map({"#1#", "#1#", "#1#"}).solve(true).escaping_fraction, 1);
  // A staircase that meets its own image only after crossing both seams.
  EXPECT_EQ(Map({"11##", "#11#", "##11", "1##1"}).solve(true).escaping_fraction, 1);
}

TEST(TrappedLiquid, ALongPocketThatNearlyClosesOnItselfIsTrapped) {
  EXPECT_EQ(Map({"######", "111#11", "######"}).solve(true).trapped_fraction, 1);
  EXPECT_EQ(Map({"######", "1#1111", "######", "######"}).solve(true).regions.size(), 1u);
}

/// Whether the gap around a pixel of a periodic cell reaches an image of that pixel: spreads over
/// the plane and remembers in which cell each pixel was met.
bool reaches_its_image(const Mask& contact, Index start_y, Index start_x) {
  const Index ny = contact.rows();
  const Index nx = contact.cols();
  std::map<std::pair<Index, Index>, std::pair<Index, Index>> met;  // pixel to its place
  std::vector<std::pair<Index, Index>> next{{start_y, start_x}};
  while (!next.empty()) {
    const auto [y, x] = next.back();
    next.pop_back();
    const std::pair pixel{(y % ny + ny) % ny, (x % nx + nx) % nx};
    if (contact(pixel.first, pixel.second)) continue;
    const auto [known, is_new] = met.emplace(pixel, std::pair{y, x});
    if (!is_new && known->second != std::pair{y, x}) return true;
    if (is_new) {
      for (const auto& [dy, dx] : {std::pair<Index, Index>{0, 1}, {0, -1}, {1, 0}, {-1, 0}}) {
        next.emplace_back(y + dy, x + dx);
      }
    }
  }
  return false;
}

TEST(TrappedLiquid, IsThatOfPocketsThatReachNoImageOfThemselves) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const CounterRandom random(seed);
    const Index ny = 3 + static_cast<Index>(seed % 6);
    const Index nx = 3 + static_cast<Index>(seed % 7);
    const Grid grid{nx, ny, 1, 1};
    Mask contact(ny, nx);
    for (Index i = 0; i < contact.size(); ++i) {
      contact(i) = random.uniform(static_cast<std::uint64_t>(i)) < 0.45;
    }
    const Field film = (!contact).cast<double>() * 1e-7;
    if (film.sum() == 0) continue;
    double n_trapped = 0;
    for (Index y = 0; y < ny; ++y) {
      for (Index x = 0; x < nx; ++x) {
        n_trapped += !contact(y, x) && !reaches_its_image(contact, y, x) ? 1 : 0;
      }
    }
    const TrappedLiquid found = trapped_liquid(contact, film, film, grid, true);
    const double n_open = static_cast<double>((film > 0).count());
    EXPECT_NEAR(found.trapped_fraction, n_trapped / n_open, 1e-12) << seed;
    EXPECT_NEAR(found.escaping_fraction, 1 - n_trapped / n_open, 1e-12) << seed;
  }
}

TEST(TrappedLiquid, WithoutLiquidThereIsNothingToReport) {
  const TrappedLiquid liquid = Map({"...", ".#.", "..."}).solve(false);
  EXPECT_TRUE(liquid.regions.empty());
  EXPECT_EQ(liquid.trapped_fraction + liquid.escaping_fraction + liquid.under_contact_fraction, 0);
}

TEST(TrappedLiquid, RejectsOtherShapesAndNan) {
  Map map({"11", "1#"});
  map.film(0, 0) = std::nan("");
  EXPECT_THROW(map.solve(false), InputError);
  map.film.resize(1, 2);
  EXPECT_THROW(map.solve(false), InputError);
}

}  // namespace
}  // namespace tabor::friction
