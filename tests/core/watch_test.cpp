#include "tabor/core/watch.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/core/parallel.hpp"

namespace tabor {
namespace {

/// Longer than the watch waits between two questions.
void pass_time() { std::this_thread::sleep_for(std::chrono::milliseconds(110)); }

TEST(Finishes, TellsWhoStoppedTheWork) {
  const Observer never = [](const Progress&) { return false; };
  const Observer always = [](const Progress&) { return true; };
  bool worked = false;
  EXPECT_FALSE(finishes(never, "work", [&](Watch&) { worked = true; }));
  EXPECT_FALSE(worked);
  EXPECT_TRUE(finishes(always, "work", [&](Watch&) { worked = true; }));
  EXPECT_TRUE(worked);
  EXPECT_TRUE(finishes({}, "work", [](Watch& watch) { watch.tell(0.5); }));
}

TEST(Finishes, LeavesTheStopOfAWatchAroundToItsOwner) {
  const Observer nobody;
  EXPECT_THROW(finishes(nobody, "work", [](Watch&) { throw Interrupted(); }), Interrupted);
}

TEST(Watch, AsksAtOnceAndInLoopsBelow) {
  std::vector<std::string> stages;
  const Observer observer = [&](const Progress& progress) {
    stages.emplace_back(progress.stage);
    return true;
  };
  const Watch watch(observer, "rain");
  EXPECT_EQ(stages.size(), 1u);
  go_on_or_throw();
  EXPECT_EQ(stages.size(), 1u) << "not twice within a tenth of a second";
  pass_time();
  parallel_for(4, 1, [](Index, Index) {});
  EXPECT_EQ(stages, (std::vector<std::string>{"rain", "rain"}));
}

TEST(Watch, ThrowsWhereTheObserverStops) {
  const Observer never = [](const Progress&) { return false; };
  EXPECT_THROW(Watch(never, "rain"), Interrupted);
  go_on_or_throw();  // the watch that threw is gone
  int asked = 0;
  const Observer once = [&](const Progress&) { return ++asked < 2; };
  const Watch watch(once, "rain");
  pass_time();
  Index done = 0;
  EXPECT_THROW(parallel_for(1 << 20, 1 << 10, [&](Index, Index) { ++done; }), Interrupted);
  EXPECT_LT(done, 1 << 10) << "the rest of the loop is left out";
}

TEST(Watch, RepeatsTheShareThatWasTold) {
  std::vector<double> shares;
  const Observer observer = [&](const Progress& progress) {
    shares.push_back(progress.fraction);
    return true;
  };
  Watch watch(observer, "rain");
  watch.tell(0.25);
  pass_time();
  go_on_or_throw();
  ASSERT_EQ(shares.size(), 3u);
  EXPECT_TRUE(std::isnan(shares[0]));
  EXPECT_EQ(shares[1], 0.25);
  EXPECT_EQ(shares[2], 0.25);
}

TEST(Watch, OfAnInnerFunctionSpeaksUntilItEnds) {
  std::vector<std::string> stages;
  const Observer observer = [&](const Progress& progress) {
    stages.emplace_back(progress.stage);
    return true;
  };
  const Watch outer(observer, "treatment");
  {
    const Watch inner(observer, "fill holes");
    pass_time();
    go_on_or_throw();
  }
  pass_time();
  go_on_or_throw();
  EXPECT_EQ(stages,
            (std::vector<std::string>{"treatment", "fill holes", "fill holes", "treatment"}));
}

TEST(Watch, IsOfItsThreadAlone) {
  std::atomic<int> asked = 0;
  const Observer observer = [&](const Progress&) { return ++asked > 0; };
  const Watch watch(observer, "rain");
  pass_time();
  std::thread([] { go_on_or_throw(); }).join();
  EXPECT_EQ(asked, 1);
}

TEST(Unwatched, LetsWorkEndWhoeverSaidStop) {
  bool goes_on = true;
  const Observer observer = [&](const Progress&) { return goes_on; };
  const Watch watch(observer, "slide");
  goes_on = false;
  pass_time();
  {
    const Unwatched saving;
    EXPECT_NO_THROW(go_on_or_throw());
    EXPECT_THROW(Watch(observer, "within"), Interrupted);
  }
  EXPECT_THROW(go_on_or_throw(), Interrupted);
}

TEST(Watch, OfNobodyLeavesTheWordToTheOneAround) {
  int asked = 0;
  const Observer observer = [&](const Progress&) { return ++asked > 0; };
  const Watch outer(observer, "rain");
  const Observer nobody;
  const Watch inner(nobody, "pools");
  pass_time();
  go_on_or_throw();
  EXPECT_EQ(asked, 2);
}

}  // namespace
}  // namespace tabor
