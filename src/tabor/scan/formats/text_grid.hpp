#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "tabor/core/types.hpp"

// Recognises evenly spaced coordinates among the numbers of a text file.
namespace tabor::scan::format {

/// Evenly spaced coordinates: their first value, spacing and count.
struct GridLine {
  double first = 0;
  double step = 0;
  Index n = 0;

  Index index_of(double coordinate) const;
  bool holds(double coordinate) const;
};

/// Every `stride`-th number of a table: a column, or a row.
struct TextColumn {
  const double* first = nullptr;
  std::size_t stride = 1;
  std::size_t n = 0;

  std::size_t size() const { return n; }
  double operator[](std::size_t i) const { return first[i * stride]; }
};

/// Returns the grid line of a column, if all its coordinates lie on one, in any order and repeated:
/// a single node if they are all the same. Coordinates may be rounded, or moved by up to a
/// twentieth of a step.
std::optional<GridLine> find_grid_line(const TextColumn& column);

/// True where the numbers rise, or fall, from each to the next.
bool is_strictly_monotone(const TextColumn& column);

/// Returns the grid line of numbers that look like coordinates: strictly monotone and evenly spaced
/// but for gaps, not more gaps than numbers. Fewer than four numbers never do.
std::optional<GridLine> find_coordinates(const TextColumn& column);

/// True where the nodes of a line are counted: 0 1 2 ..., 1 2 3 ...
bool is_count_up(const GridLine& line);

}  // namespace tabor::scan::format
