#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "tabor/core/types.hpp"

namespace tabor::test {

/// The contact problem of a few pixels in extended precision: an explicit matrix, and sets of open,
/// free and saturated pixels that are changed until the contact conditions hold. Shares no code
/// with the library. E* = 1.
struct Exact {
  Field pressure;
  Field gap;
  double separation = 0;
  bool finished = false;
};

namespace exact {

using Real = long double;
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

/// Displacement at pixel (y, x) by unit pressure on pixel (0, 0) of a periodic cell: the sum over
/// its waves.
inline Real periodic_influence(const Grid& grid, Index y, Index x) {
  constexpr Real two_pi = 2 * std::numbers::pi_v<Real>;
  Real sum = 0;
  for (Index ky = 0; ky < grid.ny; ++ky) {
    for (Index kx = 0; kx < grid.nx; ++kx) {
      const auto wave = [](Index k, Index n) { return static_cast<Real>(2 * k <= n ? k : k - n); };
      const Real q = two_pi * std::hypot(wave(kx, grid.nx) / static_cast<Real>(grid.lx),
                                         wave(ky, grid.ny) / static_cast<Real>(grid.ly));
      const Real phase = two_pi * (static_cast<Real>(kx * x) / static_cast<Real>(grid.nx) +
                                   static_cast<Real>(ky * y) / static_cast<Real>(grid.ny));
      sum += kx + ky == 0 ? 0 : 2 / q * std::cos(phase);
    }
  }
  return sum / static_cast<Real>(grid.size());
}

/// The same by unit pressure on a rectangle of a half-space (Love 1929).
inline Real free_influence(const Grid& grid, Index y, Index x) {
  const Real dx = grid.dx();
  const Real dy = grid.dy();
  const auto corner = [](Real a, Real b) {
    return (a == 0 ? 0 : a * std::asinh(b / std::abs(a))) +
           (b == 0 ? 0 : b * std::asinh(a / std::abs(b)));
  };
  const Real left = static_cast<Real>(x) * dx - dx / 2;
  const Real low = static_cast<Real>(y) * dy - dy / 2;
  return (corner(left + dx, low + dy) - corner(left, low + dy) - corner(left + dx, low) +
          corner(left, low)) /
         std::numbers::pi_v<Real>;
}

inline Matrix influence(const Grid& grid, bool periodic) {
  Matrix first(2 * grid.ny - 1, 2 * grid.nx - 1);
  for (Index y = 1 - grid.ny; y < grid.ny; ++y) {
    for (Index x = 1 - grid.nx; x < grid.nx; ++x) {
      first(y + grid.ny - 1, x + grid.nx - 1) =
          periodic ? periodic_influence(grid, y, x) : free_influence(grid, y, x);
    }
  }
  Matrix matrix(grid.size(), grid.size());
  for (Index i = 0; i < grid.size(); ++i) {
    for (Index j = 0; j < grid.size(); ++j) {
      matrix(i, j) =
          first(i / grid.nx - j / grid.nx + grid.ny - 1, i % grid.nx - j % grid.nx + grid.nx - 1);
    }
  }
  return matrix;
}

enum class Set { open, free, saturated };

/// Free pressures and separation that close the free gaps and carry the load.
inline std::pair<Vector, Real> solve_sets(const Matrix& matrix, const Vector& height,
                                          const std::vector<Set>& sets, Real load, Real cap) {
  const Index n = height.size();
  Matrix system = Matrix::Zero(n + 1, n + 1);
  Vector right = Vector::Zero(n + 1);
  for (Index i = 0; i < n; ++i) {
    const Set set = sets[static_cast<std::size_t>(i)];
    if (set == Set::free) {
      system.row(i).head(n) = matrix.row(i);
      system(i, n) = 1;
      right(i) = height(i);
    } else {
      system(i, i) = 1;
      right(i) = set == Set::saturated ? cap : 0;
    }
    system(n, i) = 1;
  }
  right(n) = load;
  const Vector solution = system.partialPivLu().solve(right);
  return {solution.head(n), solution(n)};
}

/// Changes the sets of the pixels whose pressure or gap is wrong: all of them, or the worst alone,
/// which cannot go round in circles. False if all are right.
inline bool improve(std::vector<Set>& sets, const Vector& wanted, Real cap, bool all) {
  std::vector<Set> next(sets.size());
  std::size_t worst = 0;
  Real largest = 0;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const Real w = wanted(static_cast<Index>(i));
    next[i] = w <= 0 ? Set::open : (w >= cap ? Set::saturated : Set::free);
    const Real error = next[i] == sets[i]     ? 0
                       : sets[i] == Set::free ? std::max(-w, w - cap)
                       : sets[i] == Set::open ? w
                                              : cap - w;
    if (next[i] != sets[i] && error >= largest) {
      largest = error;
      worst = i;
    }
  }
  if (next == sets) return false;
  sets[worst] = next[worst];
  if (all) sets = next;
  if (std::count(sets.begin(), sets.end(), Set::free) == 0) {  // none left to carry the rest
    Index nearest = 0;
    wanted.array().min(cap - wanted.array()).maxCoeff(&nearest);
    sets[static_cast<std::size_t>(nearest)] = Set::free;
  }
  return true;
}

/// A first guess: all pixels free; with a cap the bearing area, free at its lowest height.
inline std::vector<Set> first_sets(const Field& heights, double mean_pressure, double cap) {
  const auto n = static_cast<std::size_t>(heights.size());
  std::vector<Set> sets(n, Set::free);
  if (!std::isfinite(cap)) return sets;
  std::vector<double> sorted(heights.data(), heights.data() + n);
  std::sort(sorted.begin(), sorted.end(), std::greater<>());
  const auto rank = static_cast<std::size_t>(mean_pressure / cap * static_cast<double>(n));
  const double level = sorted[std::min(rank, n - 1)];
  for (std::size_t i = 0; i < n; ++i) {
    const double above = heights(static_cast<Index>(i)) - level;
    sets[i] = above > 1e-12 ? Set::saturated : (above < -1e-12 ? Set::open : Set::free);
  }
  return sets;
}

}  // namespace exact

inline Exact solve_exactly(const Field& heights, const Grid& grid, double mean_pressure, double cap,
                           bool periodic) {
  using namespace exact;
  const Index n = heights.size();
  const Matrix matrix = influence(grid, periodic);
  const Real compliance = matrix(0, 0);
  Vector height(n);
  for (Index i = 0; i < n; ++i) height(i) = heights(i);
  std::vector<Set> sets = first_sets(heights, mean_pressure, cap);
  Exact exact;
  Vector pressure;
  Vector gap;
  for (int round = 0; round < 300 && !exact.finished; ++round) {
    Real separation = 0;
    std::tie(pressure, separation) =
        solve_sets(matrix, height, sets, static_cast<Real>(mean_pressure) * n, cap);
    gap = matrix * pressure - height + Vector::Constant(n, separation);
    exact.separation = static_cast<double>(separation);
    exact.finished = !improve(sets, pressure - gap / compliance, cap, round < 20);
  }
  exact.pressure = pressure.cast<double>().reshaped<Eigen::RowMajor>(grid.ny, grid.nx).array();
  exact.gap = gap.cast<double>().reshaped<Eigen::RowMajor>(grid.ny, grid.nx).array();
  return exact;
}

}  // namespace tabor::test
