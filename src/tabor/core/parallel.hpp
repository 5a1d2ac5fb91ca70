#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string_view>

#include "tabor/core/convergence.hpp"
#include "tabor/core/types.hpp"

// Runs loops, sums and maxima on all threads; results have the same bits for any number of them.
namespace tabor {

/// Sets the number of threads of the parallel loops; 0 asks for all cores. Results never depend on
/// it. In a copy of the process made by fork() it is 1, until more are asked for; it stays 1 where
/// the original has run loops on several threads, as OpenMP does not survive that.
void set_thread_count(int n);
int thread_count();

/// Limits the threads of the loops that the thread which made it runs, while it lives; other
/// threads keep theirs. Any thread may change the limit meanwhile. A limit within a limit replaces
/// it until it ends.
class ThreadLimit {
 public:
  explicit ThreadLimit(const std::atomic<int>& limit);  ///< must outlive this object
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  const std::atomic<int>* outer_;
};

/// Keeps the loops of its thread on one thread, while it lives, where all of them run over fewer
/// than kSmallestForThreads items: several threads lose more time by meeting than they win.
class OneThreadIfSmall {
 public:
  explicit OneThreadIfSmall(Index n_items);  ///< in the longest of its loops

 private:
  std::optional<ThreadLimit> limit_;
};

/// Pixels of a contact from which two threads solve it faster than one.
inline constexpr Index kSmallestForThreads = Index{128} * 128;

/// Calls body(begin, end) for consecutive blocks of [0, n), `block` items each, on all threads.
/// Blocks are the same whatever the thread count; loops of a single block run serially.
void parallel_for(Index n, Index block, const std::function<void(Index begin, Index end)>& body);

/// Runs two pieces of work at the same time, each with half of the threads; one after the other
/// where there is one thread. The second has no observer of its own: while the first runs, what
/// watches that one stops both, and then `observer`, under this stage. Rethrows what either throws;
/// where the first does, the second is stopped.
void run_both(const std::function<void()>& first, const std::function<void()>& second,
              const Observer& observer, std::string_view stage);

/// Returns the sum of partial(begin, end) over fixed blocks, added in block order: the same bits
/// for any thread count.
double deterministic_sum(Index n, const std::function<double(Index begin, Index end)>& partial);

/// Returns the largest partial(begin, end) over blocks; -infinity for n = 0.
double parallel_max(Index n, const std::function<double(Index begin, Index end)>& partial);

/// Items per block of deterministic_sum(); also a good default for parallel_for() over pixels.
inline constexpr Index kBlock = 1 << 14;

/// Returns the deterministic sum of a field's values.
double sum(const Field& field);

}  // namespace tabor
