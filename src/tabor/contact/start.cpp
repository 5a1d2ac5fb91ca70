#include "tabor/contact/start.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "tabor/contact/fast_solver.hpp"
#include "tabor/contact/listed_caps.hpp"
#include "tabor/contact/projection.hpp"
#include "tabor/core/large_pages.hpp"
#include "tabor/core/loops.hpp"
#include "tabor/core/rows.hpp"

namespace tabor::contact {
namespace {

constexpr Index kCoarsestSize = 64;        // smaller grids start from the bearing area
constexpr double kCoarseTolerance = 1e-3;  // tighter coarse solutions save nothing on the fine grid

/// Returns a pressure on the highest pixels: p_sat where that saturates, else proportional to the
/// height above the median.
Field bearing_pressure(const LoadProblem& problem) {
  const Field& height = problem.height;
  const bool saturates = problem.caps.bound();
  const double cap = problem.caps.mean(height.size());
  const double share = saturates ? problem.mean_pressure / cap : 0.5;
  std::vector<double> sorted(height.data(), height.data() + height.size());
  const auto rank = std::min<Index>(
      height.size() - 1, static_cast<Index>(std::ceil(share * static_cast<double>(height.size()))));
  std::nth_element(sorted.begin(), sorted.begin() + rank, sorted.end(), std::greater<>());
  const double level = sorted[static_cast<std::size_t>(rank)];
  if (saturates) {
    return (height >= level).select(Field::Constant(height.rows(), height.cols(), cap), 0.0);
  }
  return (height - level).max(0.0);
}

}  // namespace

bool has_coarser(const Grid& grid) { return std::min(grid.nx, grid.ny) >= 2 * kCoarsestSize; }

Grid coarser(const Grid& grid) { return {(grid.nx + 1) / 2, (grid.ny + 1) / 2, grid.lx, grid.ly}; }

Field halved(const Field& fine) {
  auto coarse = uninitialised_map<Field>((fine.rows() + 1) / 2, (fine.cols() + 1) / 2);
  for_each_pixel(coarse.rows(), coarse.cols(), [&](Index y, Index x) {
    const Index below = std::min(2 * y + 1, fine.rows() - 1);
    const Index right = std::min(2 * x + 1, fine.cols() - 1);
    coarse(y, x) =
        0.25 * (fine(2 * y, 2 * x) + fine(2 * y, right) + fine(below, 2 * x) + fine(below, right));
  });
  return coarse;
}

Field doubled(const Field& coarse, Index ny, Index nx) {
  auto fine = uninitialised_map<Field>(ny, nx);
  for_each_pixel(ny, nx, [&](Index y, Index x) { fine(y, x) = coarse(y / 2, x / 2); });
  return fine;
}

void fit_to_load(Field& pressure, double mean_pressure, const Caps& caps) {
  const double load = mean_pressure * static_cast<double>(pressure.size());
  double* p = pressure.data();
  PixelList support = list_where(pressure.size(), [p](Index i) { return touches(p[i]); });
  if (support.empty() || Caps(ListedCaps(caps, support)).sum(std::ssize(support)) <= load) {
    support = list_where(pressure.size(), [](Index) { return true; });
  }
  std::vector<double> values(support.size());
  for_each(values.size(), [&](std::size_t k) { values[k] = p[support[k]]; });
  const double carried = sum_over(values.size(), [&](std::size_t k) { return values[k]; });
  if (!caps.bound() && carried > 0) {
    for_each(values.size(), [&](std::size_t k) { values[k] *= load / carried; });
  }
  project_on_load(values, load, ListedCaps(caps, support));
  for_each(values.size(), [&](std::size_t k) { p[support[k]] = values[k]; });
}

Field starting_pressure(const elastic::ElasticOperator& elasticity, const LoadProblem& problem,
                        const Observer& observer, Convergence& convergence) {
  const Grid& grid = elasticity.grid();
  Field pressure;
  if (!problem.start.empty()) {
    pressure = problem.start.map();
  } else if (has_coarser(grid)) {
    const Field height = halved(problem.height);
    const LoadProblem coarse{height,
                             problem.mean_pressure,
                             problem.caps.mean(problem.height.size()),
                             problem.start,
                             std::max(kCoarseTolerance, problem.tolerance),
                             problem.max_iterations};
    const Grid coarse_grid = coarser(grid);
    const auto coarse_operator = elasticity.on_grid(coarse_grid);
    const Observer asked = [&](const Progress& progress) {
      return !asks_to_stop(observer, {progress.stage});
    };
    const State state = solve_fast(*coarse_operator, coarse, asked);
    convergence.fft_pairs += state.convergence.fft_pairs * static_cast<double>(coarse_grid.size()) /
                             static_cast<double>(grid.size());
    if (state.convergence.stopped()) convergence.status = Status::stopped;
    pressure = doubled(state.pressure, grid.ny, grid.nx);
  } else {
    pressure = bearing_pressure(problem);
  }
  fit_to_load(pressure, problem.mean_pressure, problem.caps);
  return pressure;
}

}  // namespace tabor::contact
