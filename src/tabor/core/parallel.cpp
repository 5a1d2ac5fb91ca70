// The only file that knows OpenMP.
#include "tabor/core/parallel.hpp"

#include <omp.h>
#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <future>
#include <limits>
#include <mutex>
#include <vector>

#include "tabor/core/watch.hpp"

namespace tabor {
namespace {

constexpr std::chrono::milliseconds kPatience{20};  // between two looks at other work

std::atomic<int> requested_threads = 0;
thread_local const std::atomic<int>* own_limit = nullptr;
std::atomic<bool> has_team = false;   // loops of this process have run on several threads
std::atomic<bool> lost_team = false;  // so they had in the process that this one is a copy of

/// In a copy that fork() made of the process there is one thread. OpenMP would wait for ever for
/// those that it had in the original, tabor's or another library's.
void begin_copy() {
  if (has_team) lost_team = true;
  requested_threads = 1;
}
[[maybe_unused]] const int begins_copies = ::pthread_atfork(nullptr, nullptr, &begin_copy);

/// Runs body(0..n_blocks-1) on all threads; the first exception is rethrown after the loop, since
/// OpenMP lets none escape from a parallel region.
void for_each_block(Index n_blocks, const std::function<void(Index)>& body) {
  go_on_or_throw();
  if (n_blocks <= 1 || thread_count() == 1 || omp_in_parallel() != 0) {
    for (Index block = 0; block < n_blocks; ++block) {
      go_on_or_throw();
      body(block);
    }
    return;
  }
  has_team = true;
  std::exception_ptr first_error;
  std::atomic<bool> failed = false;
  std::mutex error_mutex;
#pragma omp parallel for schedule(dynamic, 1) num_threads(thread_count())
  for (Index block = 0; block < n_blocks; ++block) {
    if (failed) continue;
    try {
      go_on_or_throw();  // only one of the threads is watched
      body(block);
    } catch (...) {
      failed = true;
      const std::lock_guard lock(error_mutex);
      if (!first_error) first_error = std::current_exception();
    }
  }
  if (first_error) std::rethrow_exception(first_error);
}

Index count_blocks(Index n, Index block) { return (n + block - 1) / block; }

/// partial(begin, end) of every kBlock-sized block of [0, n), in block order.
std::vector<double> block_values(Index n, const std::function<double(Index, Index)>& partial) {
  std::vector<double> values(static_cast<std::size_t>(count_blocks(n, kBlock)));
  for_each_block(static_cast<Index>(values.size()), [&](Index block) {
    const Index begin = block * kBlock;
    values[static_cast<std::size_t>(block)] = partial(begin, std::min(n, begin + kBlock));
  });
  return values;
}

}  // namespace

void set_thread_count(int n) { requested_threads = std::max(0, n); }

int thread_count() {
  if (lost_team) return 1;
  if (own_limit != nullptr) return std::max<int>(1, *own_limit);
  const int requested = requested_threads;
  return requested > 0 ? requested : omp_get_max_threads();
}

ThreadLimit::ThreadLimit(const std::atomic<int>& limit) : outer_(own_limit) { own_limit = &limit; }

ThreadLimit::~ThreadLimit() { own_limit = outer_; }

OneThreadIfSmall::OneThreadIfSmall(Index n_items) {
  static const std::atomic<int> one = 1;
  if (n_items < kSmallestForThreads) limit_.emplace(one);
}

void parallel_for(Index n, Index block, const std::function<void(Index, Index)>& body) {
  for_each_block(count_blocks(n, block), [&](Index k) {
    const Index begin = k * block;
    body(begin, std::min(n, begin + block));
  });
}

void run_both(const std::function<void()>& first, const std::function<void()>& second,
              const Observer& observer, std::string_view stage) {
  const int n_threads = omp_in_parallel() != 0 ? 1 : thread_count();
  if (n_threads == 1) {
    first();
    second();
    return;
  }
  const std::atomic<int> half = n_threads / 2;
  std::atomic<bool> ends = false;
  std::future<void> other = std::async(std::launch::async, [&] {
    const ThreadLimit limit(half);
    const Observer until_the_end = [&](const Progress&) { return !ends; };
    const Watch watch(until_the_end, "");
    second();
  });
  try {
    {
      const ThreadLimit limit(half);
      first();
    }
    Watch watch(observer, stage);
    while (other.wait_for(kPatience) != std::future_status::ready) go_on_or_throw();
  } catch (...) {
    ends = true;
    other.wait();
    throw;
  }
  other.get();
}

double deterministic_sum(Index n, const std::function<double(Index, Index)>& partial) {
  double total = 0;
  for (const double value : block_values(n, partial)) total += value;
  return total;
}

double parallel_max(Index n, const std::function<double(Index, Index)>& partial) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const double value : block_values(n, partial)) largest = std::max(largest, value);
  return largest;
}

double sum(const Field& field) {
  const double* values = field.data();
  return deterministic_sum(field.size(), [values](Index begin, Index end) {
    return Eigen::Map<const Eigen::ArrayXd>(values + begin, end - begin).sum();
  });
}

}  // namespace tabor
