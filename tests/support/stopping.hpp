#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <ostream>
#include <vector>

#include "tabor/core/convergence.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/core/watch.hpp"

namespace tabor {

/// For messages of tests.
inline void PrintTo(Status status, std::ostream* out) { *out << name_of(status); }

}  // namespace tabor

namespace tabor::test {

using StoppableSolve = std::function<Convergence(const Observer&)>;

/// Every loop that is watched asks at every opportunity, on one thread: then the number of
/// questions is the same each time.
class EveryQuestion {
 public:
  EveryQuestion() {
    set_watch_period(0);
    set_thread_count(1);
  }
  ~EveryQuestion() {
    set_watch_period(kWatchPeriod);
    set_thread_count(0);
  }
  EveryQuestion(const EveryQuestion&) = delete;
  EveryQuestion& operator=(const EveryQuestion&) = delete;
};

/// How often an observer that never stops it is asked.
inline int count_questions(const StoppableSolve& solve) {
  int asked = 0;
  EXPECT_FALSE(solve([&](const Progress&) { return ++asked > 0; }).stopped());
  return asked;
}

/// A solve that is told to stop at any one question, the first and the last among them, says that
/// it was stopped and asks nothing more: no other way is tried, as each begins with a question.
inline void expect_to_stop_at_once(const StoppableSolve& solve) {
  const EveryQuestion every;
  const int all = count_questions(solve);
  for (const int last : {1, 2, 3, all / 4, all / 2, 3 * all / 4, all - 1, all}) {
    if (last < 1) continue;
    int asked = 0;
    const Convergence ended = solve([&](const Progress&) { return ++asked != last; });
    EXPECT_EQ(ended.status, Status::stopped) << last << " of " << all;
    EXPECT_EQ(asked, last) << "of " << all << ": nothing is asked after a stop";
  }
}

}  // namespace tabor::test
