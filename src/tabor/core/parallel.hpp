#pragma once

#include <functional>

#include "tabor/core/types.hpp"

namespace tabor {

/// Number of threads the parallel loops use; 0 asks for all cores. Results never depend on it.
void set_thread_count(int n);
int thread_count();

/// Calls body(begin, end) for consecutive blocks of [0, n), `block` items each, on all threads.
/// Blocks are the same whatever the thread count; loops of a single block run serially.
void parallel_for(Index n, Index block, const std::function<void(Index begin, Index end)>& body);

/// Sum of partial(begin, end) over fixed blocks, added in block order: same bits for any thread
/// count.
double deterministic_sum(Index n, const std::function<double(Index begin, Index end)>& partial);

/// Largest partial(begin, end) over blocks; -infinity for n = 0.
double parallel_max(Index n, const std::function<double(Index begin, Index end)>& partial);

/// Items per block used by deterministic_sum and a good default for parallel_for over pixels.
inline constexpr Index kBlock = 1 << 14;

/// Deterministic sum over a field's values.
double sum(const Field& field);

}  // namespace tabor
