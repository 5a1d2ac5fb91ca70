#include "tabor/metrology/spectra/height_differences.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <functional>

#include "tabor/core/watch.hpp"
#include "tabor/metrology/spectra/lag_sums.hpp"
#include "tabor/spectral/strips.hpp"
#include "tabor/topography/topography.hpp"

namespace tabor::metrology {
namespace {

using spectral::ColumnRange;
using Complex = std::complex<double>;
using Strip = std::vector<Complex>;

/// Rings of lags by their distance, (k - 1/2) w <= r < (k + 1/2) w; ring 0 is not used.
struct Rings {
  explicit Rings(const Grid& g)
      : grid(g),
        width(std::max(g.dx(), g.dy())),
        n(static_cast<Index>(std::min(g.lx, g.ly) / width) + 1) {}

  double distance(Index ly, Index lx) const {
    const double x = static_cast<double>(lx) * grid.dx(), y = static_cast<double>(ly) * grid.dy();
    return std::sqrt(x * x + y * y);
  }
  Index ring_of(double distance) const { return std::lround(distance / width); }

  Grid grid;
  double width;
  Index n;
};

/// Values of a lag map along both axes, and their sums over rings, plain and times the distance.
struct LagSums {
  explicit LagSums(const Rings& rings)
      : along_x(Eigen::ArrayXd::Zero(rings.grid.nx)),
        along_y(Eigen::ArrayXd::Zero(rings.grid.ny)),
        over_rings(Eigen::ArrayXd::Zero(rings.n)),
        distances(Eigen::ArrayXd::Zero(rings.n)) {}
  Eigen::ArrayXd along_x, along_y, over_rings, distances;
};

/// Adds one row of a lag map to ring sums. Of row 0 only one of lx and -lx is a lag of its own.
void add_to_rings(const Rings& rings, Index ly, std::span<const double> row, Eigen::ArrayXd& sums,
                  Eigen::ArrayXd& distances) {
  const Index length = std::ssize(row);
  for (Index lx = 0; lx < rings.grid.nx; ++lx) {
    const double distance = rings.distance(ly, lx);
    const Index ring = rings.ring_of(distance);
    if (ring >= rings.n) {
      break;  // so are all further ones
    }
    const bool both = lx > 0 && ly > 0;
    const double value = row[static_cast<std::size_t>(lx)] +
                         (both ? row[static_cast<std::size_t>(length - lx)] : 0.0);
    sums[ring] += value;
    distances[ring] += value * distance;
  }
}

/// Adds what one strip contributes to a lag map.
void add_strip(const spectral::StripTransform<double>& transform, const Strip& strip,
               ColumnRange range, const Rings& rings, LagSums& total) {
  constexpr Index block_rows = spectral::kRowsPerStripBlock;
  const Index n_blocks = (rings.grid.ny + block_rows - 1) / block_rows;
  std::vector<Eigen::ArrayXd> sums(static_cast<std::size_t>(n_blocks)), distances(sums);
  transform.rows_inverse(strip, range, [&](Index y, std::span<const double> row) {
    const auto block = static_cast<std::size_t>(y / block_rows);
    if (y % block_rows == 0) sums[block] = distances[block] = Eigen::ArrayXd::Zero(rings.n);
    add_to_rings(rings, y, row, sums[block], distances[block]);
    total.along_y[y] += row[0];
    if (y == 0) total.along_x += Eigen::Map<const Eigen::ArrayXd>(row.data(), rings.grid.nx);
  });
  for (std::size_t block = 0; block < sums.size(); ++block) {
    total.over_rings += sums[block];
    total.distances += distances[block];
  }
}

/// The mean square of every lag (but zero) that has pairs.
HeightDifference mean_differences(const Eigen::ArrayXd& squares, const Eigen::ArrayXd& pairs,
                                  const std::function<double(Index)>& lag_of) {
  HeightDifference result;
  for (Index k = 1; k < squares.size(); ++k) {
    const double n = std::nearbyint(pairs[k]);
    if (n >= 1) {
      result.lag.push_back(lag_of(k));
      result.mean_square.push_back(std::max(0.0, squares[k] / n));
      result.pairs.push_back(n);
    }
  }
  return result;
}

/// Rows of z, of the mask and of z^2 (heights about their mean in units of their rms, 0 in holes).
std::array<spectral::RowSource<double>, 3> difference_rows(const Field& height,
                                                           const Moments& moments) {
  const double rms = moments.mean_square > 0 ? std::sqrt(moments.mean_square) : 1;
  const auto rows = [&height](auto value) {
    return [&height, value](Index y, std::span<double> row) {
      for (std::size_t x = 0; x < row.size(); ++x) {
        const double z = height(y, static_cast<Index>(x));
        row[x] = std::isnan(z) ? 0 : value(z);
      }
    };
  };
  const auto scaled = [mean = moments.mean, rms](double z) { return (z - mean) / rms; };
  return {rows(scaled), rows([](double) { return 1.0; }),
          rows([scaled](double z) { return scaled(z) * scaled(z); })};
}

/// Spectra of z, mask m and z^2 become those of the sums of squared differences, m*z^2 + z^2*m -
/// 2 z*z, and of the numbers of pairs, m*m (* = correlation).
void combine(std::span<Complex* const> columns, Index n, double norm) {
  for (Index k = 0; k < n; ++k) {
    const Complex z = columns[0][k], m = columns[1][k], square = columns[2][k];
    columns[0][k] = 2 * norm * ((std::conj(m) * square).real() - std::norm(z));
    columns[1][k] = norm * std::norm(m);
  }
}

/// Strips of about a twelfth of the spectrum: three of them take 4 bytes per pixel.
std::vector<ColumnRange> strips_of(Index n_columns) {
  const Index width = std::max<Index>(64, n_columns / 12);
  std::vector<ColumnRange> ranges;
  for (Index begin = 0; begin < n_columns; begin += width) {
    ranges.push_back({begin, std::min(n_columns, begin + width)});
  }
  return ranges;
}

}  // namespace

HeightDifferences height_differences(const Field& height, const Grid& grid,
                                     const Observer& observer) {
  Watch watch(observer, "height differences");
  const Moments moments = moments_of(height);
  const spectral::StripTransform<double> transform(grid.ny, grid.nx, padded_for_lags(grid.ny),
                                                   padded_for_lags(grid.nx));
  const double norm =
      1 / (static_cast<double>(transform.padded_ny()) * static_cast<double>(transform.padded_nx()));
  const auto sources = difference_rows(height, moments);
  const Rings rings(grid);
  LagSums squares(rings), pairs(rings);
  std::array<Strip, 3> strips;
  for (const ColumnRange& range : strips_of(transform.n_frequencies())) {
    watch.tell(static_cast<double>(range.begin) / static_cast<double>(transform.n_frequencies()));
    for (std::size_t i = 0; i < strips.size(); ++i) {
      transform.rows_forward(sources[i], range, strips[i]);
    }
    const std::array pointers{&strips[0], &strips[1], &strips[2]};
    transform.change_columns(pointers, range, [&](Index, std::span<Complex* const> columns) {
      combine(columns, transform.padded_ny(), norm);
    });
    add_strip(transform, strips[0], range, rings, squares);
    add_strip(transform, strips[1], range, rings, pairs);
  }
  watch.tell(1);
  const double unit = moments.mean_square > 0 ? moments.mean_square : 1;
  const auto part = [&](auto member, const std::function<double(Index)>& lag_of) {
    return mean_differences(squares.*member * unit, pairs.*member, lag_of);
  };
  HeightDifferences result;
  result.x = part(&LagSums::along_x, [&](Index k) { return static_cast<double>(k) * grid.dx(); });
  result.y = part(&LagSums::along_y, [&](Index k) { return static_cast<double>(k) * grid.dy(); });
  if (!topography::is_profile(grid)) {
    result.radial = part(&LagSums::over_rings,
                         [&](Index k) { return pairs.distances[k] / pairs.over_rings[k]; });
  }
  return result;
}

}  // namespace tabor::metrology
