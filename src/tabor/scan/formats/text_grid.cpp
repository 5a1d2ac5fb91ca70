// Evenly spaced coordinates among the numbers of a text.
#include "tabor/scan/formats/text_grid.hpp"

#include <algorithm>
#include <cmath>

namespace tabor::scan::format {
namespace {

/// Largest distance of a coordinate from its grid line, as a share of the spacing: a margin for
/// the rounding of printed coordinates.
constexpr double kGridTolerance = 0.05;

/// Nodes of a line at most for each coordinate that lies on it: finer steps say nothing.
constexpr std::size_t kMostNodes = 3;

/// Share of a range within which coordinates count as the same.
constexpr double kSameShare = 1e-9;

bool holds_all(const GridLine& line, const TextColumn& column) {
  for (std::size_t i = 0; i < column.size(); ++i) {
    if (!line.holds(column[i])) return false;
  }
  return true;
}

/// The smallest step between consecutive points taken as the spacing: right for scans whose
/// coordinates were printed with all their digits.
std::optional<GridLine> line_of_smallest_step(const TextColumn& column, double low, double high) {
  double step = high - low;
  for (std::size_t i = 1; i < column.size(); ++i) {
    const double difference = std::abs(column[i] - column[i - 1]);
    if (difference > kSameShare * (high - low)) step = std::min(step, difference);
  }
  if ((high - low) / step > static_cast<double>(kMostNodes * column.size())) return std::nullopt;
  const double n_steps = std::round((high - low) / step);
  const GridLine line{low, (high - low) / n_steps, static_cast<Index>(n_steps) + 1};
  return holds_all(line, column) ? std::optional(line) : std::nullopt;
}

/// The same for coordinates that rounding or the stage moved: gaps between sorted coordinates are
/// either within a node or from node to node, and each of these is some whole spacings.
std::optional<GridLine> line_of_median_gap(const TextColumn& column, double low, double high) {
  constexpr double clear_jump = 4;  // from the largest gap within a node to the next one
  std::vector<double> places;
  for (std::size_t i = 0; i < column.size(); ++i) places.push_back(column[i]);
  std::sort(places.begin(), places.end());
  std::vector<double> gaps;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double gap = places[i] - places[i - 1];
    if (gap > kSameShare * (high - low)) gaps.push_back(gap);
  }
  std::sort(gaps.begin(), gaps.end());
  // The last jump above which the gaps still make up most of the line: those beside missing
  // columns do not.
  std::size_t first = gaps.size() - 1;
  double above = gaps[first];
  while (first > 0 && (2 * above <= high - low || gaps[first] <= clear_jump * gaps[first - 1])) {
    above += gaps[--first];
  }
  const double smallest = gaps[first];
  const double median_gap = gaps[first + (gaps.size() - first) / 2];
  // Places over the numbers of their nodes, as a straight line.
  double node = 0, sum_node = 0, sum_place = 0, sum_square = 0, sum_product = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double gap = i > 0 ? places[i] - places[i - 1] : 0;
    if (gap >= smallest) node += std::round(gap / median_gap);
    const double place = places[i] - low;
    sum_node += node;
    sum_place += place;
    sum_square += node * node;
    sum_product += node * place;
  }
  if (!(node >= 1) || node > static_cast<double>(column.size())) return std::nullopt;
  const auto n = static_cast<double>(places.size());
  const double step =
      (n * sum_product - sum_node * sum_place) / (n * sum_square - sum_node * sum_node);
  const GridLine line{low + (sum_place - step * sum_node) / n, step, static_cast<Index>(node) + 1};
  return holds_all(line, column) ? std::optional(line) : std::nullopt;
}

}  // namespace

Index GridLine::index_of(double coordinate) const {
  return std::lround((coordinate - first) / step);
}

bool GridLine::holds(double coordinate) const {
  const double position = (coordinate - first) / step;
  return std::abs(position - std::round(position)) <= kGridTolerance;
}

std::optional<GridLine> find_grid_line(const TextColumn& column) {
  double low = column[0];
  double high = low;
  for (std::size_t i = 0; i < column.size(); ++i) {
    if (std::isnan(column[i])) return std::nullopt;
    low = std::min(low, column[i]);
    high = std::max(high, column[i]);
  }
  if (high == low) return GridLine{low, 1, 1};
  if (!std::isfinite(high - low)) return std::nullopt;
  const auto line = line_of_smallest_step(column, low, high);
  return line ? line : line_of_median_gap(column, low, high);
}

bool is_strictly_monotone(const TextColumn& column) {
  bool rises = true, falls = true;
  for (std::size_t i = 1; i < column.size() && (rises || falls); ++i) {
    rises &= column[i] > column[i - 1];
    falls &= column[i] < column[i - 1];
  }
  return column.size() > 1 && (rises || falls);
}

std::optional<GridLine> find_coordinates(const TextColumn& column) {
  constexpr std::size_t least = 4;
  constexpr Index most_gaps = 2;  // nodes for each number
  if (column.size() < least || !is_strictly_monotone(column)) return std::nullopt;
  const auto line = find_grid_line(column);
  const bool is_filled = line && line->n <= most_gaps * static_cast<Index>(column.size());
  return is_filled ? line : std::nullopt;
}

bool is_count_up(const GridLine& line) {
  constexpr double rounding = 1e-9;
  return std::abs(line.step - 1) < rounding && line.first == std::round(line.first);
}

}  // namespace tabor::scan::format
