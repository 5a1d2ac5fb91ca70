#pragma once

#include <vector>

#include "tabor/core/parallel.hpp"

// Loops and sums over the rows of a map on all threads.
namespace tabor {

/// Rows per block of a thread: enough work at 1000 columns, still balanced at 100 rows.
inline constexpr Index kRowsPerBlock = 16;

/// Calls body(y) for every row on all threads.
template <typename Body>
void for_each_row(Index n_rows, const Body& body) {
  parallel_for(n_rows, kRowsPerBlock, [&body](Index begin, Index end) {
    for (Index y = begin; y < end; ++y) body(y);
  });
}

/// Calls body(y, x) for every pixel, row by row, on all threads.
template <typename Body>
void for_each_pixel(Index n_rows, Index n_columns, const Body& body) {
  for_each_row(n_rows, [&](Index y) {
    for (Index x = 0; x < n_columns; ++x) body(y, x);
  });
}

/// Returns the sum of of_row(y), an array of N numbers, added in the order of the rows: the same
/// bits for any number of threads.
template <int N, typename OfRow>
Eigen::Array<double, N, 1> sum_over_rows(Index n_rows, const OfRow& of_row) {
  using Sums = Eigen::Array<double, N, 1>;
  std::vector<Sums> rows(static_cast<std::size_t>(n_rows));
  for_each_row(n_rows, [&](Index y) { rows[static_cast<std::size_t>(y)] = of_row(y); });
  Sums total = Sums::Zero();
  for (const Sums& row : rows) total += row;
  return total;
}

}  // namespace tabor
