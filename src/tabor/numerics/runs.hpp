#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tabor/core/parallel.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/core/types.hpp"

// Finds the runs of pixels of a map, which are fewer than its pixels, to connect them to regions.
namespace tabor::numerics {

/// Pixels of one row that belong and follow one another: [begin, end) among all pixels, row by row.
struct Run {
  Index begin = 0;
  Index end = 0;
};

/// All runs of a map, in the order of their pixels.
class Runs {
 public:
  /// belongs(pixel): the pixel is in a run. Called once or twice for each pixel, on all threads.
  template <typename Belongs>
  Runs(Index n_rows, Index n_columns, const Belongs& belongs);

  std::size_t size() const { return runs_.size(); }
  const Run& operator[](std::size_t run) const { return runs_[run]; }
  Index n_rows() const { return n_rows_; }
  Index n_columns() const { return n_columns_; }
  /// Returns the first run of a row, and for the number of rows the end.
  std::size_t first_of(Index row) const { return first_[static_cast<std::size_t>(row)]; }

  /// Borders of the map, as bits.
  enum Side : std::uint8_t { kLeft = 1, kRight = 2, kTop = 4, kBottom = 8 };
  /// Returns the borders of the map that the run reaches.
  std::uint8_t sides(std::size_t run) const {
    const Index row = runs_[run].begin / n_columns_;
    const int found = (runs_[run].begin == row * n_columns_ ? kLeft : 0) |
                      (runs_[run].end == (row + 1) * n_columns_ ? kRight : 0) |
                      (row == 0 ? kTop : 0) | (row + 1 == n_rows_ ? kBottom : 0);
    return static_cast<std::uint8_t>(found);
  }

  /// Calls join(run, other, x, y) for each pair of runs that touch side by side: right and below.
  /// `x`, `y`: periodic cells from the first to the second, 0 or 1; opposite borders of the map
  /// touch if it is periodic.
  template <typename Join>
  void join_neighbours(bool periodic, const Join& join) const;

 private:
  template <typename Take>
  void join_rows(Index upper, Index lower, const Take& take) const;

  Index n_rows_;
  Index n_columns_;
  std::vector<Run> runs_;
  std::vector<std::size_t> first_;
};

template <typename Belongs>
Runs::Runs(Index n_rows, Index n_columns, const Belongs& belongs)
    : n_rows_(n_rows), n_columns_(n_columns), first_(static_cast<std::size_t>(n_rows) + 1, 0) {
  const auto visit = [&](Index row, const auto& begin, const auto& end) {
    bool is_in = false;
    for (Index i = row * n_columns; i < (row + 1) * n_columns; ++i) {
      const bool is_member = belongs(i);
      if (is_member && !is_in) begin(i);
      if (!is_member && is_in) end(i);
      is_in = is_member;
    }
    if (is_in) end((row + 1) * n_columns);
  };
  for_each_row(n_rows, [&](Index row) {
    std::size_t count = 0;
    visit(
        row, [&](Index) { ++count; }, [](Index) {});
    first_[static_cast<std::size_t>(row) + 1] = count;
  });
  for (std::size_t row = 1; row < first_.size(); ++row) first_[row] += first_[row - 1];
  runs_.resize(first_.back());
  for_each_row(n_rows, [&](Index row) {
    std::size_t place = first_of(row);
    visit(
        row, [&](Index i) { runs_[place].begin = i; }, [&](Index i) { runs_[place++].end = i; });
  });
}

/// Calls take(a, b) for the runs of two rows that stand above one another.
template <typename Take>
void Runs::join_rows(Index upper, Index lower, const Take& take) const {
  const Index down = (lower - upper) * n_columns_;
  std::size_t a = first_of(upper);
  std::size_t b = first_of(lower);
  while (a < first_of(upper + 1) && b < first_of(lower + 1)) {
    const Index begin = runs_[a].begin + down;
    const Index end = runs_[a].end + down;
    if (begin < runs_[b].end && runs_[b].begin < end) take(a, b);
    (end < runs_[b].end ? a : b)++;
  }
}

template <typename Join>
void Runs::join_neighbours(bool periodic, const Join& join) const {
  for (Index row = 0; row < n_rows_; ++row) {
    const bool is_last = row + 1 == n_rows_;
    if (periodic && first_of(row) < first_of(row + 1)) {
      const std::size_t left = first_of(row);
      const std::size_t right = first_of(row + 1) - 1;
      const bool touch =
          runs_[left].begin == row * n_columns_ && runs_[right].end == (row + 1) * n_columns_;
      if (touch) join(right, left, 1, 0);
    }
    if (is_last && !periodic) break;
    join_rows(row, is_last ? 0 : row + 1,
              [&](std::size_t a, std::size_t b) { join(a, b, 0, is_last ? 1 : 0); });
  }
}

}  // namespace tabor::numerics
