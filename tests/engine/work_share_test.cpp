#include "tabor/engine/work_share.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tabor::engine {
namespace {

/// A sweep on a clock that the test moves.
struct Simulated {
  explicit Simulated(const std::vector<std::string>& kinds, int n_workers = 1)
      : work(kinds, [this] { return now; }) {
    work.set_workers(n_workers);
  }
  void take(std::size_t job, double seconds) {
    work.begin(job);
    now += seconds;
    work.end(job);
  }

  double now = 0;
  WorkShare work;
};

TEST(WorkShare, KnowsNothingOfKindsThatHaveNotRun) {
  Simulated sweep({"film", "contact", "contact"});
  EXPECT_FALSE(sweep.work.seconds_left());
  EXPECT_TRUE(std::isnan(sweep.work.share()));
  sweep.take(0, 80);
  EXPECT_FALSE(sweep.work.seconds_left()) << "no contact has run";
}

TEST(WorkShare, CountsJobsByTheTimeTheirKindTook) {
  Simulated sweep({"film", "contact", "contact"});
  sweep.take(0, 80);
  sweep.take(1, 10);
  EXPECT_DOUBLE_EQ(sweep.work.seconds_left().value(), 10);
  EXPECT_DOUBLE_EQ(sweep.work.share(), 0.9);
  sweep.work.begin(2);
  sweep.work.inside(2, 0.5);
  EXPECT_DOUBLE_EQ(sweep.work.seconds_left().value(), 5);
  sweep.now += 10;
  sweep.work.end(2);
  EXPECT_EQ(sweep.work.share(), 1);
}

TEST(WorkShare, TakesAJobThatRunsForItsKindBeforeOneHasEnded) {
  Simulated sweep({"contact", "contact"});
  sweep.work.begin(0);
  sweep.now = 1;
  sweep.work.inside(0, 0.05);
  EXPECT_FALSE(sweep.work.seconds_left()) << "a twentieth tells nothing yet";
  sweep.now = 5;
  sweep.work.inside(0, 0.5);
  EXPECT_DOUBLE_EQ(sweep.work.seconds_left().value(), 5 + 10);
}

TEST(WorkShare, SharesTheRestBetweenWorkersButNoJob) {
  Simulated sweep({"contact", "contact", "contact", "contact", "contact"}, 2);
  sweep.take(0, 10);
  EXPECT_DOUBLE_EQ(sweep.work.seconds_left().value(), 20);
  sweep.take(1, 10);
  sweep.take(2, 10);
  sweep.take(3, 10);
  EXPECT_DOUBLE_EQ(sweep.work.seconds_left().value(), 10);
}

TEST(WorkShare, DoesNotWaitForJobsWhoseTimeDoesNotCount) {
  Simulated sweep({"contact", "", "contact"});
  sweep.take(0, 10);
  EXPECT_DOUBLE_EQ(sweep.work.seconds_left().value(), 10);
}

TEST(WorkShare, DoesNotCountTheTimeAJobWaited) {
  Simulated sweep({"fluid", "fluid"});
  sweep.work.begin(0);
  sweep.now = 100;  // for its contact
  sweep.take(0, 7);
  EXPECT_DOUBLE_EQ(sweep.work.seconds_left().value(), 7);
}

}  // namespace
}  // namespace tabor::engine
