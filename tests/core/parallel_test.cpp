#include "tabor/core/parallel.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <thread>

#include "tabor/core/error.hpp"
#include "tabor/core/watch.hpp"

namespace tabor {
namespace {

class Parallel : public testing::Test {
 protected:
  ~Parallel() override { set_thread_count(0); }
};

TEST_F(Parallel, VisitsEveryItemOnce) {
  for (const int threads : {1, 2, 5}) {
    set_thread_count(threads);
    std::atomic<Index> visited = 0;
    parallel_for(100001, 64, [&](Index begin, Index end) { visited += end - begin; });
    EXPECT_EQ(visited, 100001);
  }
}

TEST_F(Parallel, SumsHaveTheSameBitsForAnyThreadCount) {
  const Field values = Field::Random(701, 333);
  set_thread_count(1);
  const double one = sum(values);
  for (const int threads : {2, 3, 8}) {
    set_thread_count(threads);
    EXPECT_EQ(sum(values), one) << threads;
  }
  EXPECT_NEAR(one, values.sum(), 1e-9);
}

TEST_F(Parallel, RethrowsWhatTheBodyThrows) {
  set_thread_count(2);
  EXPECT_THROW(parallel_for(100, 1,
                            [](Index begin, Index) {
                              if (begin == 57) throw std::runtime_error("57");
                            }),
               std::runtime_error);
}

/// Whether a copy of this process comes to its end within 20 s and finds what it should.
bool copy_finds(const std::function<bool()>& expected) {
  const pid_t copy = ::fork();
  if (copy == 0) {
    ::alarm(20);  // ends a copy that waits for threads it has not
    ::_exit(expected() ? 0 : 1);
  }
  int status = 0;
  return ::waitpid(copy, &status, 0) == copy && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST_F(Parallel, ACopyOfTheProcessWorksOnOneThread) {
  const Field values = Field::Random(701, 333);
  set_thread_count(4);
  const double expected = sum(values);
  EXPECT_TRUE(copy_finds([&] { return thread_count() == 1 && sum(values) == expected; }));
  EXPECT_EQ(thread_count(), 4);
}

TEST_F(Parallel, ACopyOfACopyDoesToo) {
  const Field values = Field::Random(701, 333);
  set_thread_count(4);
  const double expected = sum(values);
  EXPECT_TRUE(copy_finds([&] { return copy_finds([&] { return sum(values) == expected; }); }));
}

TEST_F(Parallel, ACopyThatAsksForMoreThreadsStillEnds) {
  const Field values = Field::Random(701, 333);
  set_thread_count(4);
  const double expected = sum(values);
  EXPECT_TRUE(copy_finds([&] {
    set_thread_count(3);
    return sum(values) == expected;
  }));
}

TEST_F(Parallel, TwoPiecesOfWorkShareTheThreads) {
  for (const int threads : {1, 2, 5}) {
    set_thread_count(threads);
    int of_first = 0, of_second = 0;
    run_both([&] { of_first = thread_count(); }, [&] { of_second = thread_count(); }, {}, "");
    EXPECT_EQ(of_first, std::max(1, threads / 2));
    EXPECT_EQ(of_second, of_first);
    EXPECT_EQ(thread_count(), threads);
  }
}

TEST_F(Parallel, WhatEitherPieceOfWorkThrowsIsRethrown) {
  const auto nothing = [] {};
  const auto fails = [] { throw std::runtime_error("no"); };
  for (const int threads : {1, 2}) {
    set_thread_count(threads);
    EXPECT_THROW(run_both(fails, nothing, {}, ""), std::runtime_error);
    EXPECT_THROW(run_both(nothing, fails, {}, ""), std::runtime_error);
  }
}

TEST_F(Parallel, AStopEndsBothPiecesOfWork) {
  set_thread_count(2);
  std::atomic<int> n_begun = 0, n_stopped = 0;
  const auto endless = [&] {
    ++n_begun;
    try {
      while (true) go_on_or_throw();
    } catch (const Interrupted&) {
      ++n_stopped;
      throw;
    }
  };
  const Observer until_both_run = [&](const Progress&) { return n_begun < 2; };
  const auto watched = [&] {
    const Watch inner(until_both_run, "first");
    endless();
  };
  EXPECT_THROW(run_both(watched, endless, until_both_run, "second"), Interrupted);
  EXPECT_EQ(n_stopped, 2);
  const Observer until_it_runs = [&](const Progress&) { return n_begun < 3; };
  EXPECT_THROW(run_both([] {}, endless, until_it_runs, "second"), Interrupted);
  EXPECT_EQ(n_stopped, 3);
}

TEST_F(Parallel, ALimitHoldsForItsOwnThread) {
  set_thread_count(4);
  std::atomic<int> limit = 2;
  {
    const ThreadLimit limited(limit);
    EXPECT_EQ(thread_count(), 2);
    int of_another = 0;
    std::thread([&] { of_another = thread_count(); }).join();
    EXPECT_EQ(of_another, 4);
    limit = 3;
    EXPECT_EQ(thread_count(), 3);
    const std::atomic<int> one = 1;
    const ThreadLimit inner(one);
    EXPECT_EQ(thread_count(), 1);
  }
  EXPECT_EQ(thread_count(), 4);
}

TEST_F(Parallel, SmallWorkHasOneThread) {
  set_thread_count(2);
  {
    const OneThreadIfSmall large(kSmallestForThreads);
    EXPECT_EQ(thread_count(), 2);
    const OneThreadIfSmall small(kSmallestForThreads - 1);
    EXPECT_EQ(thread_count(), 1);
  }
  EXPECT_EQ(thread_count(), 2);
}

TEST_F(Parallel, MaximumOfNothingIsMinusInfinity) {
  EXPECT_EQ(parallel_max(0, [](Index, Index) { return 1.0; }),
            -std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace tabor
