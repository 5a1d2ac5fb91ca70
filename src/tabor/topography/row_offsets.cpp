#include "tabor/topography/row_offsets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/core/units.hpp"

namespace tabor::topography {
namespace {

/// Jumps over the spread of the differences they are medians of. Of rough surfaces it is 0.1 to
/// 0.35, as the rows of a finite scan follow its longest waves; at 1/2 jumps add a tenth to steps.
constexpr double kLargeJump = 0.5;
constexpr double kFarFromChance = 2;
/// Offsets drawn row by row have -0.5, random walks and grooves of Hurst exponent 1/2 zero.
constexpr double kBackAndForth = -0.25;
/// Fewer jumps have no correlation to speak of.
constexpr std::size_t kFewestRows = 16;

/// Reorders the values.
double middle_of(std::vector<double>& values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

/// Median of the differences of a pair of rows and their rms about it.
struct Pair {
  double jump = 0;
  double spread = 0;
  bool exists = false;
};

/// The rows that have heights at all: each is compared with the one before it in this list.
std::vector<Index> rows_with_heights(const Field& height) {
  std::vector<Index> rows;
  for (Index y = 0; y < height.rows(); ++y) {
    if (!height.row(y).isNaN().all()) rows.push_back(y);
  }
  return rows;
}

Pair compare(const Field& height, Index before, Index here, Index stride) {
  std::vector<double> differences;
  for (Index x = 0; x < height.cols(); x += stride) {
    const double difference = height(here, x) - height(before, x);
    if (!std::isnan(difference)) differences.push_back(difference);
  }
  if (differences.empty()) return {};
  const double jump = middle_of(differences);
  double squares = 0;
  for (const double difference : differences) squares += (difference - jump) * (difference - jump);
  return {jump, std::sqrt(squares / static_cast<double>(differences.size())), true};
}

/// Size and correlation of the jumps about their median, which is a tilt.
void measure(std::vector<double> jumps, RowJumps& all) {
  std::vector<double> sorted = jumps;
  const double tilt = middle_of(sorted);
  double squares = 0, products = 0;
  for (std::size_t i = 0; i < jumps.size(); ++i) {
    jumps[i] -= tilt;
    squares += jumps[i] * jumps[i];
    if (i > 0) products += jumps[i] * jumps[i - 1];
  }
  all.size = std::sqrt(squares / static_cast<double>(jumps.size()) / 2);
  all.correlation = squares > 0 ? products / squares : 0;
}

std::string describe(const RowJumps& jumps) {
  return fmt::format("{} from row to row, {} within rows", format_si(jumps.size, "m"),
                     format_si(jumps.within_rows, "m"));
}

}  // namespace

bool RowJumps::are_large() const {
  return size > 0 && size > std::max(kLargeJump, kFarFromChance * chance) * within_rows;
}

bool RowJumps::are_offsets() const {
  return are_large() && jumps.size() >= kFewestRows && correlation < kBackAndForth;
}

RowJumps row_jumps(const Field& height, Index sample) {
  const Index stride = std::max<Index>(1, height.cols() / sample);
  const std::vector<Index> rows = rows_with_heights(height);
  std::vector<Pair> pairs(rows.size());
  for_each_row(std::ssize(rows), [&](Index i) {
    const auto here = static_cast<std::size_t>(i);
    if (i > 0) pairs[here] = compare(height, rows[here - 1], rows[here], stride);
  });
  RowJumps all;
  all.jumps.assign(static_cast<std::size_t>(height.rows()), 0);
  std::vector<double> jumps, spreads;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!pairs[i].exists) continue;
    all.jumps[static_cast<std::size_t>(rows[i])] = pairs[i].jump;
    jumps.push_back(pairs[i].jump);
    spreads.push_back(pairs[i].spread);
  }
  if (jumps.empty()) return all;
  all.within_rows = middle_of(spreads) / std::numbers::sqrt2;
  const Index n_heights = (height.cols() + stride - 1) / stride;
  // The standard error of the median of a normal sample: sqrt(pi / 2 / n).
  all.chance = 1.2533 / std::sqrt(static_cast<double>(n_heights));
  measure(std::move(jumps), all);
  return all;
}

Topography level_rows(Topography topography) {
  if (topography.grid.nx == 1 && topography.grid.ny > 1) {
    throw InputError("level", "'rows' for a profile of one column", "rows of several pixels",
                     "<level=plane> levels a profile");
  }
  const RowJumps found = row_jumps(topography.height, topography.height.cols());
  if (!found.are_large()) {
    topography.history.push_back("level=rows: rows do not jump (" + describe(found) +
                                 "), nothing taken");
    return topography;
  }
  std::vector<double> offsets = found.jumps;
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  const double mean =
      std::accumulate(offsets.begin(), offsets.end(), 0.0) / static_cast<double>(offsets.size());
  for (std::size_t y = 0; y < offsets.size(); ++y) {
    topography.height.row(static_cast<Index>(y)) -= offsets[y] - mean;
  }
  topography.periodic = false;  // the offsets of the first and last row differ
  topography.history.push_back("level=rows: offsets taken, " + describe(found));
  return topography;
}

}  // namespace tabor::topography
