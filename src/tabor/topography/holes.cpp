#include "tabor/topography/holes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/core/names.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/core/watch.hpp"
#include "tabor/topography/harmonic.hpp"

namespace tabor::topography {
namespace {

constexpr auto kFills = names<Fill>("harmonic", "nearest", "mean");

constexpr Index kNoRow = -1;
using RowMap = Eigen::Array<Index, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// For every pixel the row of the nearest valid pixel in its column (the upper one of two).
RowMap nearest_rows(const Field& height) {
  RowMap rows = RowMap::Constant(height.rows(), height.cols(), kNoRow);
  for (Index y = 0; y < height.rows(); ++y) {
    for (Index x = 0; x < height.cols(); ++x) {
      rows(y, x) = !std::isnan(height(y, x)) ? y : (y > 0 ? rows(y - 1, x) : kNoRow);
    }
  }
  for (Index y = height.rows() - 2; y >= 0; --y) {
    for (Index x = 0; x < height.cols(); ++x) {
      const Index below = rows(y + 1, x);
      const bool closer = below > y && (rows(y, x) == kNoRow || below - y < y - rows(y, x));
      rows(y, x) = closer ? below : rows(y, x);
    }
  }
  return rows;
}

/// Parabolas distance^2(x) = (x - apex)^2 + offset whose lower envelope gives the nearest pixel
/// (Felzenszwalb & Huttenlocher 2012, doi:10.4086/toc.2012.v008a019).
struct Parabola {
  double apex, offset, from;
  Index column;
};

double crossing(const Parabola& left, const Parabola& right) {
  return ((right.offset + right.apex * right.apex) - (left.offset + left.apex * left.apex)) /
         (2 * (right.apex - left.apex));
}

std::vector<Parabola> lower_envelope(const RowMap& rows, Index y, const Grid& grid) {
  std::vector<Parabola> envelope;
  for (Index x = 0; x < rows.cols(); ++x) {
    if (rows(y, x) == kNoRow) continue;
    const double distance = static_cast<double>(rows(y, x) - y) * grid.dy();
    Parabola next{static_cast<double>(x) * grid.dx(), distance * distance,
                  -std::numeric_limits<double>::infinity(), x};
    while (!envelope.empty()) {
      next.from = crossing(envelope.back(), next);
      if (next.from > envelope.back().from) break;
      envelope.pop_back();
      next.from = -std::numeric_limits<double>::infinity();
    }
    envelope.push_back(next);
  }
  return envelope;
}

Field fill_nearest(const Field& height, const Grid& grid) {
  const RowMap rows = nearest_rows(height);
  Field filled = height;
  for_each_row(height.rows(), [&](Index y) {
    const auto envelope = lower_envelope(rows, y, grid);
    std::size_t k = 0;
    for (Index x = 0; x < height.cols(); ++x) {
      while (k + 1 < envelope.size() &&
             envelope[k + 1].from <= static_cast<double>(x) * grid.dx()) {
        ++k;
      }
      if (std::isnan(filled(y, x))) {
        filled(y, x) = height(rows(y, envelope[k].column), envelope[k].column);
      }
    }
  });
  return filled;
}

Field fill_mean(const Field& height, Index n_valid) {
  const double total = sum_over_rows<1>(height.rows(), [&](Index y) {
    return Eigen::Array<double, 1, 1>(height.row(y).isNaN().select(0, height.row(y)).sum());
  })[0];
  return height.isNaN().select(total / static_cast<double>(n_valid), height);
}

FillResult fill_by_laplace(const Field& height, const Grid& grid, const Observer& observer) {
  FillResult result;
  result.height = height;
  const auto report = fill_harmonic(result.height, grid, observer);
  result.n_holes = report.n_holes;
  result.largest = report.largest;
  result.convergence = report.convergence;
  return result;
}

std::string describe(const FillResult& result, Fill fill, Index n_pixels) {
  if (result.n_filled == 0) return fmt::format("fill={}: no holes", name_of(fill));
  std::string text =
      fmt::format("fill={}: {} pixels ({:.3g} %)", name_of(fill), result.n_filled,
                  100 * static_cast<double>(result.n_filled) / static_cast<double>(n_pixels));
  if (fill == Fill::harmonic) {
    text += fmt::format(" in {} holes, largest {} pixels, residual {:.1e} of the height range{}",
                        result.n_holes, result.largest, result.convergence.certificate,
                        result.convergence.converged() ? "" : " (NOT CONVERGED)");
  }
  return text;
}

/// Heights that nobody measured stay a warning about everything that is computed with them.
void warn_of_invented(Index n_filled, Fill fill, Topography& topography) {
  constexpr double kTell = 0.01;  // below it a contact hardly ever stands on one
  constexpr double kMost = 0.5;
  const double share = static_cast<double>(n_filled) / static_cast<double>(topography.grid.size());
  if (share < kTell) return;
  topography.warnings.push_back(
      {.code = "filled-holes",
       .text = fmt::format("{}{:.3g} % of the pixels were holes; fill={} made up their heights",
                           share > kMost ? "Most of the area is invented: " : "", 100 * share,
                           name_of(fill))});
}

}  // namespace

std::optional<Fill> fill_from(std::string_view name) { return kFills.find(name); }
std::string_view name_of(Fill fill) { return kFills.of(fill); }

FillResult fill_holes(const Field& height, const Grid& grid, Fill fill, const Observer& observer) {
  const Watch watch(observer, "fill holes");
  const Index n_missing = height.isNaN().count();
  if (n_missing == height.size()) {
    throw InputError("fill holes", "a surface of holes only", "at least one valid height",
                     "check the channel (<channel>) and the file");
  }
  FillResult result;
  if (n_missing == 0) {
    result.height = height;
    result.convergence = exact();
  } else if (fill == Fill::harmonic) {
    result = fill_by_laplace(height, grid, observer);
  } else {
    result.height = fill == Fill::nearest ? fill_nearest(height, grid)
                                          : fill_mean(height, height.size() - n_missing);
    result.convergence = exact();
  }
  result.n_filled = n_missing;
  return result;
}

Topography fill_holes(Topography topography, Fill fill, const Observer& observer) {
  auto result = fill_holes(topography.height, topography.grid, fill, observer);
  topography.history.push_back(describe(result, fill, topography.grid.size()));
  warn_of_invented(result.n_filled, fill, topography);
  topography.height = std::move(result.height);
  return topography;
}

}  // namespace tabor::topography
