#include <cmath>
#include <limits>
#include <numbers>

#include "tabor/comparison/combine.hpp"
#include "tabor/comparison/robust_fit.hpp"
#include "tabor/core/error.hpp"
#include "tabor/metrology/correlation.hpp"
#include "tabor/topography/filters.hpp"

namespace tabor::comparison {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kSmoothingPixels = 5;

/// Pixels that vary together: sum of the autocorrelation up to the ring where it first falls to 0,
/// at most a quarter of the shorter side; 1 at least.
double correlated_pixels(const metrology::Autocorrelation& acf) {
  const Grid& grid = acf.grid();
  const double width = std::max(grid.dx(), grid.dy());
  const double reach = std::min(grid.lx, grid.ly) / 4;
  const auto n_rings = static_cast<std::size_t>(reach / width) + 1;
  std::vector<double> sums(n_rings), lags(n_rings);
  for (Index ly = 0; static_cast<double>(ly) * grid.dy() < reach; ++ly) {
    const auto columns = static_cast<Index>(reach / grid.dx());
    for (Index lx = ly == 0 ? 1 : -columns; lx <= columns; ++lx) {
      const double distance =
          std::hypot(static_cast<double>(lx) * grid.dx(), static_cast<double>(ly) * grid.dy());
      const auto ring = static_cast<std::size_t>(std::lround(distance / width));
      const double value = acf(ly, lx);
      if (ring < n_rings && !std::isnan(value)) {
        sums[ring] += 2 * value;  // and its mirror image
        lags[ring] += 2;
      }
    }
  }
  double total = 1 + sums[0];
  for (std::size_t ring = 1; ring < n_rings && sums[ring] > 0; ++ring) total += sums[ring];
  return std::max(1.0, total);
}

/// Where the smoothed loss stands beyond the threshold on one side.
struct Region {
  double volume = 0;  ///< [m^3], sum of the loss itself
  double n = 0;       ///< pixels
  double u = 0;       ///< centroid, -1 to 1 across the map
  double v = 0;
};

Region region_of(const Field& loss, const Field& smooth, double pixel_area, double lowest) {
  const auto sums = sum_over_rows<4>(loss.rows(), [&](Index y) {
    Eigen::Array4d row = Eigen::Array4d::Zero();
    for (Index x = 0; x < loss.cols(); ++x) {
      if (smooth(y, x) > lowest) {
        row += Eigen::Array4d(loss(y, x), 1, across(x, loss.cols()), across(y, loss.rows()));
      }
    }
    return row;
  });
  const double n = std::max(1.0, sums[1]);
  return {sums[0] * pixel_area, sums[1], sums[2] / n, sums[3] / n};
}

/// Noise of unchanged places.
struct Noise {
  double deviation = 0;   ///< [m]
  double correlated = 1;  ///< pixels
  double n_quiet = 1;
};

/// Variance of a sum over a region: of its own noise, and of the plane under it, which rests on the
/// quiet pixels (variance of a fitted plane at (u, v): 1 + 3 u^2 + 3 v^2 over their number).
Volume volume_of(const Region& region, const Noise& noise, double pixel_area) {
  const double leverage = 1 + 3 * region.u * region.u + 3 * region.v * region.v;
  const double pixels = region.n + region.n * region.n * leverage / noise.n_quiet;
  return {region.volume, noise.deviation * pixel_area * std::sqrt(pixels * noise.correlated),
          region.n * pixel_area};
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

WearVolumes wear_volumes(const Field& loss, const Grid& grid, double threshold) {
  if (!(threshold > 0) || !std::isfinite(threshold)) {
    throw InputError("threshold of a change", std::to_string(threshold),
                     "a positive number of standard deviations", "e.g. --threshold 4");
  }
  const double pixel_area = grid.pixel_area();
  const topography::Filter filter{.kind = topography::FilterKind::gauss,
                                  .wavelength = kSmoothingPixels * std::max(grid.dx(), grid.dy())};
  const Field smooth = topography::low_pass(loss, grid, filter, topography::scan_side(grid), false);
  const double deviation = robust_spread(smooth);
  WearVolumes result;
  result.threshold = threshold * deviation;
  const Region worn = region_of(loss, smooth, pixel_area, result.threshold);
  const Region piled = region_of(-loss, -smooth, pixel_area, result.threshold);
  const Region all = region_of(loss, Field((!loss.isNaN()).cast<double>()), pixel_area, 0.5);
  const Field quiet = (smooth.abs() > result.threshold).select(kNaN, loss);
  Noise noise;
  noise.deviation = result.noise = robust_spread(loss);
  noise.n_quiet = std::max(1.0, static_cast<double>((!quiet.isNaN()).count()));
  if (!quiet.isNaN().all()) {
    noise.correlated = correlated_pixels(metrology::autocorrelation(quiet, grid));
  }
  result.noise_area = noise.correlated * pixel_area;
  result.worn = volume_of(worn, noise, pixel_area);
  result.piled_up = volume_of(piled, noise, pixel_area);
  result.net = volume_of(all, noise, pixel_area);
  result.noise_floor = noise_floor(quiet, smooth, deviation, threshold) * pixel_area;
  return result;
}

}  // namespace tabor::comparison
