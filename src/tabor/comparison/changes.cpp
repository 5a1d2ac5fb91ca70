#include "tabor/comparison/changes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

#include "tabor/comparison/robust_fit.hpp"
#include "tabor/metrology/spectra/correlation.hpp"
#include "tabor/topography/filters.hpp"

namespace tabor::comparison {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kSmoothingPixels = 5;
constexpr int kMostSteps = 5;  ///< until noise and changes agree

Field smoothed(const Field& loss, const Grid& grid) {
  const topography::Filter filter{.kind = topography::FilterKind::gauss,
                                  .wavelength = kSmoothingPixels * std::max(grid.dx(), grid.dy())};
  return topography::low_pass(loss, grid, filter, topography::scan_side(grid), false);
}

/// Sum of the autocorrelation up to the ring where it first falls to 0, at most a quarter of the
/// shorter side; 1 at least.
double sum_of_correlation(const metrology::Autocorrelation& acf) {
  const Grid& grid = acf.grid();
  const double width = std::max(grid.dx(), grid.dy());
  const double reach = std::min(grid.lx, grid.ly) / 4;
  const auto n_rings = static_cast<std::size_t>(reach / width) + 1;
  std::vector<double> sums(n_rings);
  for (Index ly = 0; static_cast<double>(ly) * grid.dy() < reach; ++ly) {
    const auto columns = static_cast<Index>(reach / grid.dx());
    for (Index lx = ly == 0 ? 1 : -columns; lx <= columns; ++lx) {
      const double distance =
          std::hypot(static_cast<double>(lx) * grid.dx(), static_cast<double>(ly) * grid.dy());
      const auto ring = static_cast<std::size_t>(std::lround(distance / width));
      const double value = acf(ly, lx);
      if (ring < n_rings && !std::isnan(value)) sums[ring] += 2 * value;  // and its mirror image
    }
  }
  double total = 1 + sums[0];
  for (std::size_t ring = 1; ring < n_rings && sums[ring] > 0; ++ring) total += sums[ring];
  return std::max(1.0, total);
}

/// Distance to the nearest change in rings of pixels (octagons), and on which side it is.
class Rings {
 public:
  Rings(const Mask& worn, const Mask& piled_up)
      : ny_(worn.rows()),
        nx_(worn.cols()),
        ring_(Rings32::Constant(ny_, nx_, -1)),
        side_(Mask::Constant(ny_, nx_, false)) {
    std::vector<Index> front;
    for (Index i = 0; i < worn.size(); ++i) {
      const bool is_worn = worn.data()[i];
      if (!is_worn && !piled_up.data()[i]) continue;
      ring_.data()[i] = 0;
      side_.data()[i] = is_worn;
      front.push_back(i);
    }
    for (int ring = 1; !front.empty(); ++ring) front = next(front, ring);
  }

  /// The change of one side with what lies within its reach.
  Mask within(bool worn, int reach) const { return ring_ >= 0 && ring_ <= reach && side_ == worn; }

  /// How many rings around a change have a loss, up or down by `sign`: none if the first show
  /// nothing beyond `lift` [m] per place that changed, at most nine tenths of the places that are
  /// nearest to it.
  int reach_of(bool worn, const Field& loss, double sign, double noise, double lift) const {
    constexpr std::size_t together = 4;
    constexpr double to_begin = 2, to_go_on = 0;  // standard errors
    constexpr double largest_share = 0.9;
    const auto [sums, counts] = sums_over(worn, loss);
    const double all = std::accumulate(counts.begin(), counts.end(), 0.0);
    double taken = counts.front();
    for (std::size_t ring = 1; ring < sums.size(); ++ring) {
      double sum = 0, n = 0;
      for (std::size_t k = ring; k < std::min(ring + together, sums.size()); ++k) {
        sum += sign * sums[k];
        n += counts[k];
      }
      taken += counts[ring];
      if (ring == 1) sum -= lift * n_places(worn);
      const double least = ring == 1 ? to_begin : to_go_on;
      if (sum <= least * noise * std::sqrt(n) || taken > largest_share * all) {
        return static_cast<int>(ring) - 1;
      }
    }
    return static_cast<int>(sums.size());
  }

 private:
  using Rings32 = Eigen::Array<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  std::vector<Index> next(const std::vector<Index>& front, int ring) {
    std::vector<Index> found;
    for (const Index i : front) {
      const Index y = i / nx_, x = i % nx_;
      for (Index v = std::max<Index>(0, y - 1); v <= std::min(ny_ - 1, y + 1); ++v) {
        for (Index u = std::max<Index>(0, x - 1); u <= std::min(nx_ - 1, x + 1); ++u) {
          const bool is_diagonal = v != y && u != x;
          if (ring_(v, u) >= 0 || (is_diagonal && ring % 2 == 1)) continue;
          ring_(v, u) = ring;
          side_(v, u) = side_(y, x);
          found.push_back(v * nx_ + u);
        }
      }
    }
    return found;
  }

  /// Number of connected places of one side that the threshold shows.
  double n_places(bool worn) const {
    Mask left = ring_ == 0 && side_ == worn;
    double n = 0;
    std::vector<Index> open;
    for (Index i = 0; i < left.size(); ++i) {
      if (!left.data()[i]) continue;
      ++n;
      left.data()[i] = false;
      for (open.push_back(i); !open.empty();) {
        const Index y = open.back() / nx_, x = open.back() % nx_;
        open.pop_back();
        for (Index v = std::max<Index>(0, y - 1); v <= std::min(ny_ - 1, y + 1); ++v) {
          for (Index u = std::max<Index>(0, x - 1); u <= std::min(nx_ - 1, x + 1); ++u) {
            if (!left(v, u)) continue;
            left(v, u) = false;
            open.push_back(v * nx_ + u);
          }
        }
      }
    }
    return n;
  }

  struct Sums {
    std::vector<double> sums, counts;
  };
  Sums sums_over(bool worn, const Field& loss) const {
    const auto n = static_cast<std::size_t>(std::max(0, ring_.maxCoeff()) + 1);
    Sums result{std::vector<double>(n), std::vector<double>(n)};
    for (Index i = 0; i < loss.size(); ++i) {
      const double z = loss.data()[i];
      if (std::isnan(z) || ring_.data()[i] < 0 || side_.data()[i] != worn) continue;
      const auto ring = static_cast<std::size_t>(ring_.data()[i]);
      result.sums[ring] += z;
      result.counts[ring] += 1;
    }
    return result;
  }

  Index ny_, nx_;
  Rings32 ring_;
  Mask side_;
};

Field only(const Mask& mask, const Field& map) { return mask.select(map, kNaN); }

/// Spread over the quiet places; over all where there are too few.
double quiet_spread(const Field& map, const Mask& quiet) {
  return robust_spread(quiet.count() < 9 ? map : only(quiet, map));
}

/// What noise of a pixel adds up to [m] around a place that it alone has lifted to `threshold`
/// deviations of the smoothed map: its mean at a distance d from there is
/// threshold noise^2 / deviation w(d), with weights w whose sum is 1.
double lift_of(double threshold, double noise, double deviation) {
  return deviation > 0 ? threshold * noise * noise / deviation : 0;
}

/// What noise adds beyond the threshold t (in deviations of the smoothed map): the mean of the loss
/// where the smoothed loss exceeds t, for Gaussian noise cov/s phi(t).
double noise_floor(const Field& quiet, const Field& smooth, double deviation, double t) {
  const auto sums = sum_over_rows<2>(quiet.rows(), [&](Index y) {
    const auto product = quiet.row(y) * smooth.row(y);
    return Eigen::Array2d(product.isNaN().select(0, product).sum(),
                          static_cast<double>((!product.isNaN()).count()));
  });
  if (sums[1] == 0 || !(deviation > 0)) return 0;
  const double density = std::exp(-t * t / 2) / std::sqrt(2 * std::numbers::pi);
  return sums[0] / deviation * density;
}

}  // namespace

double correlated_pixels(const Field& loss, const Grid& grid, const Mask& quiet) {
  if (!quiet.any()) return 1;
  return sum_of_correlation(metrology::autocorrelation(only(quiet, loss), grid));
}

Changes find_changes(const Field& loss, const Grid& grid, double threshold, double resolution) {
  const Field smooth = smoothed(loss, grid);
  const Mask valid = !loss.isNaN();
  Changes changes;
  changes.quiet = valid;
  double deviation = 0;
  for (int step = 0; step < kMostSteps; ++step) {
    deviation = std::max(resolution, quiet_spread(smooth, changes.quiet));
    changes.noise = std::max(resolution, quiet_spread(loss, changes.quiet));
    changes.threshold = threshold * deviation;
    const Rings rings(smooth > changes.threshold, smooth < -changes.threshold);
    const double lift = lift_of(threshold, changes.noise, deviation);
    const auto side = [&](bool worn) -> Mask {
      const double sign = worn ? 1 : -1;
      return valid && rings.within(worn, rings.reach_of(worn, loss, sign, changes.noise, lift));
    };
    changes.worn = side(true);
    changes.piled_up = side(false);
    const Mask quiet = valid && !changes.worn && !changes.piled_up;
    const bool is_same = (quiet == changes.quiet).all();
    changes.quiet = quiet;
    if (is_same) break;
  }
  changes.floor = noise_floor(only(changes.quiet, loss), smooth, deviation, threshold);
  return changes;
}

}  // namespace tabor::comparison
