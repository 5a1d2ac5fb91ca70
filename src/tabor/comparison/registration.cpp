#include "tabor/comparison/registration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tabor/comparison/coarse_match.hpp"
#include "tabor/comparison/robust_fit.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/units.hpp"
#include "tabor/core/watch.hpp"
#include "tabor/topography/filters.hpp"
#include "tabor/topography/geometry.hpp"
#include "tabor/topography/levelling.hpp"

namespace tabor::comparison {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kCoarsePixels = 384;  ///< along the longest side in the coarse search
constexpr int kMostSteps = 40;         ///< of the refinement at one size
constexpr int kBlocks = 8;             ///< along each side, for the uncertainty

/// Cells of one size of both scans.
Grid coarse_grid(const Field& cells, double pitch) {
  return {cells.cols(), cells.rows(), pitch * static_cast<double>(cells.cols()),
          pitch * static_cast<double>(cells.rows())};
}

Field coarsen(const topography::Topography& scan, double pitch) {
  return topography::cell_means(scan.height, std::max(1.0, pitch / scan.grid.dx()),
                                std::max(1.0, pitch / scan.grid.dy()));
}

/// B's heights at points of another grid.
class MovedScan {
 public:
  MovedScan(const Field& height, const Grid& b, const Grid& a)
      : a_(a),
        width_x_(cell_width(a.dx() / b.dx())),
        width_y_(cell_width(a.dy() / b.dy())),
        dx_(width_x_ * b.dx()),
        dy_(width_y_ * b.dy()),
        heights_(width_x_ > 1 || width_y_ > 1 ? topography::cell_means(height, width_x_, width_y_)
                                              : height) {}

  Field at(double shift_x, double shift_y) const {
    return heights_.at({.x0 = (0.5 * a_.dx() + shift_x) / dx_ - 0.5,
                        .y0 = (0.5 * a_.dy() + shift_y) / dy_ - 0.5,
                        .step_x = a_.dx() / dx_,
                        .step_y = a_.dy() / dy_,
                        .nx = a_.nx,
                        .ny = a_.ny});
  }

 private:
  static double cell_width(double ratio) { return ratio >= 2 ? ratio : 1; }

  Grid a_;
  double width_x_, width_y_;
  double dx_, dy_;
  topography::Interpolant heights_;
};

/// Central difference along both axes [1]; NaN at the edges and beside holes.
struct Gradient {
  explicit Gradient(const Field& z, const Grid& grid)
      : x(Field::Constant(z.rows(), z.cols(), kNaN)), y(x) {
    const Index nx = z.cols(), ny = z.rows();
    x.middleCols(1, nx - 2) = (z.rightCols(nx - 2) - z.leftCols(nx - 2)) / (2 * grid.dx());
    y.middleRows(1, ny - 2) = (z.bottomRows(ny - 2) - z.topRows(ny - 2)) / (2 * grid.dy());
  }
  Field x, y;
};

/// Least squares of b(r + shift) - a(r) = (change of the shift) . grad a + plane.
class Refinement {
 public:
  Refinement(const Field& a, const Grid& grid, const MovedScan& b)
      : a_(a), grid_(grid), gradient_(a, grid), b_(b) {}

  /// Moves the shift until steps are below `tolerance` pixels; returns how many were made.
  int run(double& shift_x, double& shift_y, double tolerance) {
    for (int step = 1; step <= kMostSteps; ++step) {
      linearise(shift_x, shift_y);
      const auto solution = equations_.solution();
      shift_x -= solution[0];
      shift_y -= solution[1];
      if (std::hypot(solution[0] / grid_.dx(), solution[1] / grid_.dy()) < tolerance) return step;
    }
    return kMostSteps;
  }

  /// Variances of the shift in x and y from the scatter between blocks of the map, which are taken
  /// as independent: D^-1 * (sum of g g^T over blocks) * D^-T, g = weighted gradient sums, D =
  /// their derivative by the shift and the plane. D is made of both scans' gradients: in one alone
  /// noise would look like slopes that hold the shift.
  Eigen::Array2d variances() const {
    Matrix scatter = Matrix::Zero();
    for (Index v = 0; v < kBlocks; ++v) {
      for (Index u = 0; u < kBlocks; ++u) {
        const Eigen::Matrix<double, 5, 1> sums = block_sums(u, v);
        scatter += sums * sums.transpose();
      }
    }
    constexpr double n = kBlocks * kBlocks;
    const Matrix inverse = numerics::pseudo_inverse(derivative());
    const Matrix covariance = inverse * scatter * inverse.transpose() * (n / (n - 5));
    return covariance.diagonal().head<2>().array();
  }

 private:
  using Matrix = Eigen::Matrix<double, 5, 5>;

  void linearise(double shift_x, double shift_y) {
    moved_ = b_.at(shift_x, shift_y);
    const Field difference = moved_ - a_;
    const RobustPlane plane = fit_robust_plane(difference);
    residual_ = remove_plane(difference, plane);
    cutoff_ = kBiweightReach * plane.spread;
    equations_ =
        normal_equations<5>(residual_, cutoff_, [this](Index y, Index x) { return columns(y, x); });
  }

  Eigen::Matrix<double, 5, 1> columns(Index y, Index x) const {
    return {gradient_.x(y, x), gradient_.y(y, x), 1, across(x, grid_.nx), across(y, grid_.ny)};
  }

  Matrix derivative() const {
    const Gradient other(moved_, grid_);
    const auto sums = sum_over_rows<25>(grid_.ny, [&](Index y) {
      Eigen::Array<double, 25, 1> row = Eigen::Array<double, 25, 1>::Zero();
      for (Index x = 0; x < grid_.nx; ++x) {
        const double r = residual_(y, x);
        const Eigen::Matrix<double, 5, 1> j = columns(y, x);
        Eigen::Matrix<double, 5, 1> k = j;
        k.head<2>() << other.x(y, x), other.y(y, x);
        if (!std::isnan(r + j.sum() + k.sum())) {
          Eigen::Map<Matrix>(row.data()) += biweight(r, cutoff_) * j * k.transpose();
        }
      }
      return row;
    });
    return Eigen::Map<const Matrix>(sums.data());
  }

  Eigen::Matrix<double, 5, 1> block_sums(Index u, Index v) const {
    const Index top = v * grid_.ny / kBlocks, bottom = (v + 1) * grid_.ny / kBlocks;
    const Index left = u * grid_.nx / kBlocks, right = (u + 1) * grid_.nx / kBlocks;
    return sum_over_rows<5>(bottom - top,
                            [&](Index row) {
                              Eigen::Array<double, 5, 1> sums = Eigen::Array<double, 5, 1>::Zero();
                              for (Index x = left; x < right; ++x) {
                                const double r = residual_(top + row, x);
                                const Eigen::Array<double, 5, 1> j = columns(top + row, x).array();
                                if (!std::isnan(r + j.sum())) sums += biweight(r, cutoff_) * r * j;
                              }
                              return sums;
                            })
        .matrix();
  }

  const Field& a_;
  Grid grid_;
  Gradient gradient_;
  const MovedScan& b_;
  Field moved_;
  Field residual_;
  double cutoff_ = 0;
  NormalEquations<5> equations_;
};

[[noreturn]] void reject(const std::string& got, const std::string& expected) {
  throw InputError("registration of two scans", got, expected,
                   "check that both scans show the same place in the same orientation and are "
                   "levelled, or give the shift (<shift>) or none (<no_register>)");
}

/// Heights without waves longer than an eighth of the smaller scan's shorter side, which nearly
/// any two scans share at some shift.
Field short_waves(const Field& cells, double pitch, double longest) {
  const topography::Filter filter{.kind = topography::FilterKind::gauss,
                                  .wavelength = std::max(longest, 4 * pitch)};
  const Grid grid = coarse_grid(cells, pitch);
  return cells - topography::low_pass(cells, grid, filter, topography::scan_side(grid), false);
}

struct Coarse {
  CoarseMatch match;
  double pitch = 0;  ///< [m]
};

Coarse search(const topography::Topography& a, const topography::Topography& b,
              const RegistrationOptions& options) {
  const Grid &ga = a.grid, &gb = b.grid;
  Coarse coarse;
  coarse.pitch = std::max(
      {ga.dx(), ga.dy(), gb.dx(), gb.dy(), std::max({ga.lx, ga.ly, gb.lx, gb.ly}) / kCoarsePixels});
  const double side = std::min({ga.lx, ga.ly, gb.lx, gb.ly});
  if (side < 16 * coarse.pitch) {
    reject(fmt::format("a smaller side of {} and pixels of {}", format_si(side, "m"),
                       format_si(coarse.pitch, "m")),
           "at least 16 common pixels along each side");
  }
  coarse.match =
      match_coarsely(short_waves(coarsen(a, coarse.pitch), coarse.pitch, side / 8),
                     short_waves(coarsen(b, coarse.pitch), coarse.pitch, side / 8),
                     options.smallest_overlap, static_cast<Index>(side / 8 / coarse.pitch));
  if (coarse.match.n_shifts == 0) {
    reject("no shift with enough common points", "overlapping scans with few holes");
  }
  if (!(coarse.match.distinction >= options.smallest_distinction)) {
    reject(fmt::format("no shift that stands out (best correlation {:.2f}, {:.1f} times its "
                       "scatter at other shifts)",
                       coarse.match.correlation, coarse.match.distinction),
           fmt::format("one that stands out {} times", options.smallest_distinction));
  }
  return coarse;
}

/// Correlation coefficient and number of common points; planes over these removed.
struct Agreement {
  double correlation = 0;
  double n_common = 0;
};

Agreement agreement(const Field& a, const Field& b) {
  const Field only_a = b.isNaN().select(kNaN, a), only_b = a.isNaN().select(kNaN, b);
  const auto n = static_cast<double>((!only_a.isNaN()).count());
  if (n < 9) return {kNaN, n};
  const Field za = topography::remove_form(only_a, topography::fit_form(only_a, 1));
  const Field zb = topography::remove_form(only_b, topography::fit_form(only_b, 1));
  const auto sums = sum_over_rows<3>(za.rows(), [&](Index y) {
    const auto valid = !za.row(y).isNaN();
    return Eigen::Array3d(valid.select(za.row(y).square(), 0).sum(),
                          valid.select(zb.row(y).square(), 0).sum(),
                          valid.select(za.row(y) * zb.row(y), 0).sum());
  });
  return {sums[2] / std::sqrt(sums[0] * sums[1]), n};
}

/// Sizes of pixels from coarse to A's own; 0 stands for A's own, which need not be square.
std::vector<double> pitches(double coarse, const Grid& a) {
  std::vector<double> sizes;
  while (coarse > 1.5 * std::max(a.dx(), a.dy())) {
    sizes.push_back(coarse);
    coarse /= 2;
  }
  sizes.push_back(0);
  return sizes;
}

}  // namespace

Field move_onto(const topography::Topography& b, const Grid& a, double shift_x, double shift_y) {
  return MovedScan(b.height, b.grid, a).at(shift_x, shift_y);
}

Registration register_scans(const topography::Topography& a, const topography::Topography& b,
                            const RegistrationOptions& options, const Observer& observer) {
  Watch watch(observer, "registration");
  const Coarse coarse = search(a, b, options);
  Registration result;
  result.distinction = coarse.match.distinction;
  result.runner_up = coarse.match.runner_up;
  const double start_x = static_cast<double>(coarse.match.shift_x) * coarse.pitch;
  const double start_y = static_cast<double>(coarse.match.shift_y) * coarse.pitch;
  result.shift_x = start_x;
  result.shift_y = start_y;
  const auto sizes = pitches(coarse.pitch, a.grid);
  for (std::size_t level = 0; level < sizes.size(); ++level) {
    watch.tell(static_cast<double>(level + 1) / static_cast<double>(sizes.size() + 1));
    const bool own = sizes[level] == 0;
    const Field cells = own ? a.height : coarsen(a, sizes[level]);
    const Grid grid = own ? a.grid : coarse_grid(cells, sizes[level]);
    const MovedScan moved(b.height, b.grid, grid);
    Refinement refinement(cells, grid, moved);
    result.iterations += refinement.run(result.shift_x, result.shift_y, own ? 1e-4 : 1e-2);
    if (own) {
      const Eigen::Array2d deviations = refinement.variances().sqrt();
      result.uncertainty_x = deviations[0];
      result.uncertainty_y = deviations[1];
      const Agreement common = agreement(a.height, moved.at(result.shift_x, result.shift_y));
      result.correlation = common.correlation;
      const double largest = static_cast<double>((!a.height.isNaN()).count());
      const double other = static_cast<double>((!b.height.isNaN()).count()) * b.grid.pixel_area() /
                           a.grid.pixel_area();
      result.overlap = common.n_common / std::min(largest, other);
    }
  }
  const double moved_by = std::hypot(result.shift_x - start_x, result.shift_y - start_y);
  if (!(moved_by <= 3 * coarse.pitch)) {
    reject(fmt::format("a shift that moved by {} while it was refined", format_si(moved_by, "m")),
           "at most " + format_si(3 * coarse.pitch, "m"));
  }
  if (!(result.correlation >= options.smallest_correlation)) {
    reject(fmt::format("a correlation of {:.2f} at the best shift ({}, {})", result.correlation,
                       format_si(result.shift_x, "m"), format_si(result.shift_y, "m")),
           fmt::format("at least {}", options.smallest_correlation));
  }
  watch.tell(1);
  return result;
}

}  // namespace tabor::comparison
