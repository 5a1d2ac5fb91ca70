#include "tabor/friction/trapped.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tabor/core/error.hpp"

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

TEST(TrappedLiquid, WithoutLiquidThereIsNothingToReport) {
  const TrappedLiquid liquid = Map({"...", ".#.", "..."}).solve(false);
  EXPECT_TRUE(liquid.regions.empty());
  EXPECT_EQ(liquid.trapped_fraction + liquid.escaping_fraction + liquid.under_contact_fraction, 0);
}

TEST(TrappedLiquid, RefusesOtherShapesAndNan) {
  Map map({"11", "1#"});
  map.film(0, 0) = std::nan("");
  EXPECT_THROW(map.solve(false), InputError);
  map.film.resize(1, 2);
  EXPECT_THROW(map.solve(false), InputError);
}

}  // namespace
}  // namespace tabor::friction
