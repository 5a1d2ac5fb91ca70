// Where all paths of a droplet meet again, on valleys drawn by hand.
#include "tabor/deposition/confluences.hpp"

#include <gtest/gtest.h>

#include "tabor/deposition/router.hpp"

namespace tabor::deposition {
namespace {

// A crest (pixel 1) between a pit on the left and a puddle that spills into a valley on the right.
constexpr Pixel kPit = 0;
constexpr Pixel kCrest = 1;
constexpr Pixel kPuddle = 2;
constexpr Pixel kValley = 4;

struct Ridge {
  Terrain terrain{6, 1, Edge::closed, {10, 40, 20, 30, 0, 0}, 1};
  Pools pools{terrain, Ties::connected};
  Router router{pools};
  const Slopes& slopes = router.slopes();

  PoolId pool(Pixel p) { return pools.owner(pools.pool_at(p)); }
  void fill(Pixel p) { pools.pour(pool(p), Volume{pools[pool(p)].stop} - pools[pool(p)].level); }
};

TEST(Confluences, AreAbsentWhereTwoPoolsAreStillToFill) {
  Ridge ridge;
  const Confluences confluences(ridge.slopes, ridge.pools);
  const Slopes::Target crest = ridge.slopes.from(kCrest);
  ASSERT_FALSE(Slopes::is_pool(crest));
  EXPECT_EQ(confluences.of(crest), crest);
  EXPECT_EQ(confluences.of(ridge.pool(kPuddle)), ridge.pool(kPuddle));
}

TEST(Confluences, FollowAFullPoolOverItsSaddle) {
  Ridge ridge;
  ridge.fill(kPuddle);
  const Confluences confluences(ridge.slopes, ridge.pools);
  EXPECT_EQ(confluences.of(ridge.pool(kPuddle)), ridge.pool(kValley));
  const Slopes::Target crest = ridge.slopes.from(kCrest);
  EXPECT_EQ(confluences.of(crest), crest);  // the pit is not full yet
}

TEST(Confluences, UniteBranchesOnceNothingFlowsBackIntoAFullPool) {
  Ridge ridge;
  ridge.fill(kPuddle);
  ridge.fill(kPit);
  const Confluences confluences(ridge.slopes, ridge.pools);
  for (const Pixel p : {kPit, kCrest, kPuddle}) {
    EXPECT_EQ(confluences.of(ridge.slopes.from(p)), ridge.pool(kValley)) << p;
  }
}

TEST(Confluences, StandInTheSlopesWhenTheseSettle) {
  Ridge ridge;
  ridge.fill(kPuddle);
  ridge.fill(kPit);
  ridge.router.settle();
  EXPECT_EQ(ridge.slopes.n_forks(), 0U);
  for (const Pixel p : {kPit, kCrest, kPuddle, kValley}) {
    EXPECT_EQ(ridge.slopes.from(p), ridge.pool(kValley)) << p;
  }
}

TEST(Confluences, LeaveTheCrestBetweenTwoValleysAFork) {
  const Terrain terrain{5, 1, Edge::closed, {0, 50, 90, 60, 10}, 1};
  Pools pools(terrain, Ties::connected);
  Router router(pools);
  pools.pour(pools.owner(pools.pool_at(0)), 7);
  router.settle();
  EXPECT_EQ(router.slopes().n_forks(), 1U);
  EXPECT_FALSE(Slopes::is_pool(router.slopes().from(2)));
}

}  // namespace
}  // namespace tabor::deposition
