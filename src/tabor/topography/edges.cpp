#include "tabor/topography/edges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/numerics/field_statistics.hpp"
#include "tabor/topography/geometry.hpp"

namespace tabor::topography {
namespace {

/// Fewer lines have no typical step.
constexpr Index kFewestLines = 8;
/// The seam of a tile is one of its lines, so that it seldom exceeds the largest but one of the
/// others, and then by little. That one, as a single step must not hide a seam.
constexpr double kSlack = 1.2;
/// The seam of a mirrored cut-out is a fold along one of its edges, the one inside a fold along the
/// other edge: slopes of two lines, which differ by chance. (A row of domes has creases as well,
/// but far sharper ones than there are inside a dome.)
constexpr double kSlackOfFolds = 4;
/// A row is a bad one if it is so many times farther from both its neighbours than they are apart.
constexpr double kAlone = 2;
/// Longer profiles are not looked at: their lines would take several times the memory of the
/// heights.
constexpr Index kMostLines = Index{1} << 20;
/// Heights of a line that are looked at: more would not tell more.
constexpr Index kHeightsOfLine = 1024;
/// Steps of rounding, over the rms height.
constexpr double kRounding = 1e-6;

/// Size of the differences along one line: both must match, as a few spikes make the one large and
/// a flat ground the other small.
using Sizes = std::array<double, 2>;  // rms, median

/// NaN where fewer than half of the differences exist.
Sizes sizes_of(std::vector<double>& differences, Index n) {
  const double nan = std::nan("");
  if (2 * std::ssize(differences) < n || differences.empty()) return {nan, nan};
  double squares = 0;
  for (double& difference : differences) {
    squares += difference * difference;
    difference = std::abs(difference);
  }
  const auto middle = differences.begin() + std::ssize(differences) / 2;
  std::nth_element(differences.begin(), middle, differences.end());
  return {std::sqrt(squares / static_cast<double>(differences.size())), *middle};
}

/// Steps between each row and the next, and kinks at each, beyond the last row the first again.
struct Lines {
  std::vector<Sizes> steps;
  std::vector<Sizes> kinks;
  std::vector<double> across;  ///< medians of the differences between the rows beside each
};

Lines lines_of(const Field& height) {
  const Index ny = height.rows(), nx = height.cols();
  const Index stride = 1 + nx / kHeightsOfLine;
  Lines lines{std::vector<Sizes>(static_cast<std::size_t>(ny)),
              std::vector<Sizes>(static_cast<std::size_t>(ny)),
              std::vector<double>(static_cast<std::size_t>(ny))};
  parallel_for(ny, kRowsPerBlock, [&](Index begin, Index end) {
    std::vector<double> steps, kinks, across;
    for (Index y = begin; y < end; ++y) {
      const double* before = &height((y + ny - 1) % ny, 0);
      const double* here = &height(y, 0);
      const double* after = &height((y + 1) % ny, 0);
      steps.clear();
      kinks.clear();
      across.clear();
      for (Index x = 0; x < nx; x += stride) {
        const double step = after[x] - here[x];
        const double kink = step - (here[x] - before[x]);
        if (!std::isnan(step)) steps.push_back(step);
        if (!std::isnan(kink)) kinks.push_back(kink);
        if (!std::isnan(kink)) across.push_back(after[x] - before[x]);
      }
      lines.steps[static_cast<std::size_t>(y)] = sizes_of(steps, nx / stride);
      lines.kinks[static_cast<std::size_t>(y)] = sizes_of(kinks, nx / stride);
      lines.across[static_cast<std::size_t>(y)] = sizes_of(across, nx / stride)[1];
    }
  });
  return lines;
}

using Places = std::vector<std::size_t>;

/// Sizes that belong to the seam, and those that a bad row has made.
struct Parts {
  Places seam;
  Places bad;
};

/// True if no size at the seam exceeds the largest but one of those inside.
bool fits(const std::vector<Sizes>& lines, const Parts& parts, double slack, double rounding) {
  const auto is_in = [](const Places& places, std::size_t i) {
    return std::find(places.begin(), places.end(), i) != places.end();
  };
  for (std::size_t kind = 0; kind < std::tuple_size_v<Sizes>; ++kind) {
    double at_seam = 0;
    std::vector<double> inside;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const double size = lines[i][kind];
      if (is_in(parts.seam, i)) {
        if (std::isnan(size)) return false;
        at_seam = std::max(at_seam, size);
      } else if (!std::isnan(size) && !is_in(parts.bad, i)) {
        inside.push_back(size);
      }
    }
    if (std::ssize(inside) + 2 < kFewestLines) return false;
    std::nth_element(inside.begin(), inside.begin() + 1, inside.end(), std::greater<>());
    if (at_seam > slack * inside[1] + rounding) return false;
  }
  return true;
}

/// The row that is farthest from its neighbours while those are alike; 0 if none is.
std::size_t bad_row(const Lines& lines) {
  std::size_t row = 0;
  double farthest = 0;
  for (std::size_t y = 1; y + 1 < lines.steps.size(); ++y) {
    const double distance = std::min(lines.steps[y - 1][1], lines.steps[y][1]);
    if (distance > kAlone * lines.across[y] && distance > farthest) {
      row = y;
      farthest = distance;
    }
  }
  return row;
}

bool is_its_mirror_image(const Field& height, double rounding) {
  for (Index y = 0; y < height.rows() / 2; ++y) {
    const auto difference = height.row(y) - height.row(height.rows() - 1 - y);
    if (!(difference.abs() <= rounding || difference.isNaN()).all()) return false;
  }
  return true;
}

/// Upper and lower edge; of a single row there is none.
bool upper_and_lower_match(const Field& height, double rounding) {
  if (height.rows() == 1) return true;
  if (height.rows() < kFewestLines) return false;
  const Lines lines = lines_of(height);
  const std::size_t last = lines.steps.size() - 1;
  const std::size_t bad = bad_row(lines);
  Parts steps{.seam = {last}, .bad = {}};
  Parts kinks{.seam = {0, last}, .bad = {}};
  if (bad > 0) {
    steps.bad = {bad - 1, bad};
    kinks.bad = {bad - 1, bad, bad + 1};
  }
  const double slack_of_kinks = is_its_mirror_image(height, rounding) ? kSlackOfFolds : kSlack;
  return fits(lines.steps, steps, kSlack, rounding) &&
         fits(lines.kinks, kinks, slack_of_kinks, rounding);
}

}  // namespace

bool edges_match(const Field& height) {
  if (height.size() < kFewestLines || height.isNaN().all()) return false;
  if (std::max(height.rows(), height.cols()) > kMostLines) return false;
  const double rounding = kRounding * numerics::rms_height(height);
  return upper_and_lower_match(height, rounding) &&
         upper_and_lower_match(height.transpose(), rounding);
}

bool repeats(const Topography& topography) {
  if (topography.edges) return *topography.edges != Edges::end;
  return topography.periodic || topography.edges_match;
}

void look_at_edges(Topography& topography) {
  if (repeats(topography) || topography.edges_joined) return;
  topography.edges_match = edges_match(topography.height);
}

bool tiles_as_it_is(const Topography& topography) {
  if (topography.periodic) return true;
  return topography.edges != Edges::end && !topography.edges_joined &&
         edges_match(topography.height);
}

Topography with_edges(Topography topography, Edges edges) {
  if (topography.edges == edges) return topography;
  if (topography.edges) {
    throw InputError(
        "edges", fmt::format("'{}'", kEdges.of(edges)),
        fmt::format("nothing more: the surface has '{}'", kEdges.of(*topography.edges)),
        "say once what lies beyond the edges");
  }
  if (edges == Edges::cut) return mirror(std::move(topography));
  topography.edges = edges;
  topography.periodic = edges == Edges::tile;
  topography.history.push_back(fmt::format("edges={}", kEdges.of(edges)));
  return topography;
}

}  // namespace tabor::topography
