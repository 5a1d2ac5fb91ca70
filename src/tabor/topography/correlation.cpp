#include "tabor/topography/correlation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "tabor/core/error.hpp"
#include "tabor/spectral/fft.hpp"
#include "tabor/spectral/strips.hpp"
#include "tabor/topography/rows.hpp"

namespace tabor::topography {
namespace {

using spectral::ColumnRange;
using std::numbers::pi;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Number, mean and mean square about the mean of the valid heights.
struct Moments {
  double n = 0;
  double mean = 0;
  double mean_square = 0;
};

Moments moments_of(const Field& height) {
  const auto first = sum_over_rows<2>(height.rows(), [&](Index y) {
    const auto row = height.row(y);
    return Eigen::Array2d(static_cast<double>((!row.isNaN()).count()),
                          row.isNaN().select(0, row).sum());
  });
  if (first[0] == 0) {
    throw InputError("correlation of heights", "no valid height", "a surface with heights", "");
  }
  const double mean = first[1] / first[0];
  const double square = sum_over_rows<1>(height.rows(), [&](Index y) {
    const auto row = height.row(y);
    return Eigen::Array<double, 1, 1>(row.isNaN().select(0, (row - mean).square()).sum());
  })[0];
  return {first[0], mean, square / first[0]};
}

/// Large enough that shifts of up to n - 1 pixels do not wrap round.
Index padded(Index n) { return spectral::good_fft_size(2 * n - 1); }

spectral::RowSource<float> mask_rows(const Field& height) {
  return [&height](Index y, std::span<float> row) {
    for (std::size_t x = 0; x < row.size(); ++x) {
      row[x] = std::isnan(height(y, static_cast<Index>(x))) ? 0.0F : 1.0F;
    }
  };
}

/// Correlation sum_r f(r) f(r + l) of a map with itself, for ly = 0 .. ny-1: rows of floats in the
/// memory of its half spectrum, index lx, or padded_nx + lx for negative lags.
std::vector<std::complex<float>> self_correlation(const spectral::StripTransform<float>& transform,
                                                  const spectral::RowSource<float>& map) {
  const ColumnRange all{0, transform.n_frequencies()};
  std::vector<std::complex<float>> strip;
  transform.rows_forward(map, all, strip);
  const auto norm = 1.0F / (static_cast<float>(transform.padded_ny()) *
                            static_cast<float>(transform.padded_nx()));
  const std::array strips{&strip};
  transform.change_columns(strips, all, [&](Index, std::span<std::complex<float>* const> columns) {
    for (Index ky = 0; ky < transform.padded_ny(); ++ky) {
      columns[0][ky] = std::norm(columns[0][ky]) * norm;
    }
  });
  transform.rows_inverse(strip, all, [&](Index y, std::span<const float> row) {
    std::copy(row.begin(), row.end(), reinterpret_cast<float*>(strip.data() + y * all.size()));
  });
  return strip;
}

double pairs_without_holes(const Grid& grid, Index ly, Index lx) {
  return static_cast<double>(grid.ny - std::abs(ly)) * static_cast<double>(grid.nx - std::abs(lx));
}

/// How many pairs of each lag the holes spoil, in 16 bits: exact for up to 32767 holes, else to
/// 1/65535 of their number.
class LostPairs {
 public:
  LostPairs(const Field& height, const Grid& grid, double n_valid,
            const spectral::StripTransform<float>& transform)
      : width_(2 * transform.n_frequencies()),
        unit_(std::max(1.0, 2 * (static_cast<double>(grid.size()) - n_valid) / 65535)) {
    if (n_valid == static_cast<double>(grid.size())) {
      return;
    }
    const auto valid = self_correlation(transform, mask_rows(height));
    codes_.resize(valid.size() * 2);
    for_each_row(grid.ny, [&](Index ly) {
      const auto* pairs = reinterpret_cast<const float*>(valid.data() + ly * width_ / 2);
      for (Index i = 0; i < transform.padded_nx(); ++i) {
        const Index lx = i < grid.nx ? i : i - transform.padded_nx();
        if (std::abs(lx) < grid.nx) {
          const double lost = pairs_without_holes(grid, ly, lx) - std::nearbyint(pairs[i]);
          codes_[static_cast<std::size_t>(ly * width_ + i)] =
              static_cast<std::uint16_t>(std::clamp(std::nearbyint(lost / unit_), 0.0, 65535.0));
        }
      }
    });
  }

  double operator()(Index ly, Index i) const {
    return codes_.empty() ? 0 : unit_ * codes_[static_cast<std::size_t>(ly * width_ + i)];
  }

 private:
  Index width_;
  double unit_;
  std::vector<std::uint16_t> codes_;
};

}  // namespace

Autocorrelation autocorrelation(const Field& height, const Grid& grid) {
  const Moments moments = moments_of(height);
  const spectral::StripTransform<float> transform(grid.ny, grid.nx, padded(grid.ny),
                                                  padded(grid.nx));
  const LostPairs lost(height, grid, moments.n, transform);
  Autocorrelation acf;
  acf.grid_ = grid;
  acf.mean_square_ = moments.mean_square;
  acf.row_length_ = 2 * transform.n_frequencies();
  acf.padded_nx_ = transform.padded_nx();
  const double rms = std::sqrt(moments.mean_square);
  acf.values_ = self_correlation(transform, [&](Index y, std::span<float> row) {
    for (std::size_t x = 0; x < row.size(); ++x) {
      const double z = (height(y, static_cast<Index>(x)) - moments.mean) / rms;
      row[x] = std::isnan(z) ? 0.0F : static_cast<float>(z);  // holes; a flat has no rms
    }
  });
  const double zero = reinterpret_cast<const float*>(acf.values_.data())[0] / moments.n;
  for_each_row(grid.ny, [&](Index ly) {
    auto* row = reinterpret_cast<float*>(acf.values_.data()) + ly * acf.row_length_;
    for (Index i = 0; i < acf.padded_nx_; ++i) {
      const Index lx = i < grid.nx ? i : i - acf.padded_nx_;
      const double pairs =
          std::abs(lx) < grid.nx ? pairs_without_holes(grid, ly, lx) - lost(ly, i) : 0;
      row[i] = static_cast<float>(pairs >= 1 ? row[i] / (pairs * zero) : kNaN);
    }
  });
  return acf;
}

double Autocorrelation::operator()(Index ly, Index lx) const {
  if (ly < 0) {
    ly = -ly;
    lx = -lx;
  }
  if (ly >= grid_.ny || std::abs(lx) >= grid_.nx) {
    return kNaN;
  }
  return reinterpret_cast<const float*>(
      values_.data())[ly * row_length_ + (lx < 0 ? padded_nx_ + lx : lx)];
}

double Autocorrelation::at(double y, double x) const {
  const double v = y / grid_.dy(), u = x / grid_.dx();
  const double row = std::floor(v), column = std::floor(u);
  const auto ly = static_cast<Index>(row), lx = static_cast<Index>(column);
  const double b = v - row, a = u - column;
  const auto weighted = [&](Index j, Index i, double weight) {
    return weight > 0 ? weight * (*this)(j, i) : 0;  // a neighbour beyond the field does not count
  };
  return weighted(ly, lx, (1 - b) * (1 - a)) + weighted(ly, lx + 1, (1 - b) * a) +
         weighted(ly + 1, lx, b * (1 - a)) + weighted(ly + 1, lx + 1, b * a);
}

namespace {

/// The first crossing along a ray, or how far it could be followed.
struct Ray {
  double radius = 0;
  bool crossed = false;
};

Ray follow(const Autocorrelation& acf, double angle, double threshold) {
  const Grid& grid = acf.grid();
  const double step = 0.5 * std::min(grid.dx(), grid.dy());
  const double c = std::cos(angle), s = std::sin(angle);
  double before = 1;
  for (Index i = 1;; ++i) {
    const double radius = static_cast<double>(i) * step;
    const double value = acf.at(radius * s, radius * c);
    if (!std::isfinite(value)) {
      return {radius - step, false};
    }
    if (value <= threshold) {
      return {radius - step * (threshold - value) / (before - value), true};
    }
    before = value;
  }
}

}  // namespace

std::optional<double> CorrelationLengths::texture_aspect() const {
  return longest ? std::optional(shortest / *longest) : std::nullopt;
}

CorrelationLengths correlation_lengths(const Autocorrelation& acf, double threshold) {
  constexpr Index n_rays = 720;  // the other half plane is the same
  std::vector<Ray> rays(n_rays);
  parallel_for(n_rays, 8, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      rays[static_cast<std::size_t>(i)] =
          follow(acf, pi * static_cast<double>(i) / static_cast<double>(n_rays), threshold);
    }
  });
  CorrelationLengths lengths;
  lengths.shortest = kNaN;
  double longest = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto [radius, crossed] = rays[i];
    const double angle = pi * static_cast<double>(i) / static_cast<double>(n_rays);
    lengths.n_unfinished_rays += crossed ? 0 : 1;
    if (crossed && !(radius >= lengths.shortest)) {
      lengths.shortest = radius;
      lengths.shortest_angle = angle;
    }
    longest = crossed ? std::max(longest, radius) : longest;
  }
  const bool finished = lengths.n_unfinished_rays == 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (rays[i].crossed == finished && rays[i].radius > lengths.reach) {
      lengths.reach = rays[i].radius;
      lengths.longest_angle = pi * static_cast<double>(i) / static_cast<double>(n_rays);
    }
  }
  if (finished) {
    lengths.longest = longest;
  }
  return lengths;
}

namespace {

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
  Index ring_of(double distance) const { return static_cast<Index>(distance / width + 0.5); }

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
    if (y % block_rows == 0) {
      sums[block] = distances[block] = Eigen::ArrayXd::Zero(rings.n);
    }
    add_to_rings(rings, y, row, sums[block], distances[block]);
    total.along_y[y] += row[0];
    if (y == 0) {
      total.along_x += Eigen::Map<const Eigen::ArrayXd>(row.data(), rings.grid.nx);
    }
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
  const Moments moments = moments_of(height);
  const spectral::StripTransform<double> transform(grid.ny, grid.nx, padded(grid.ny),
                                                   padded(grid.nx));
  const double norm =
      1 / (static_cast<double>(transform.padded_ny()) * static_cast<double>(transform.padded_nx()));
  const auto sources = difference_rows(height, moments);
  const Rings rings(grid);
  LagSums squares(rings), pairs(rings);
  std::array<Strip, 3> strips;
  for (const ColumnRange& range : strips_of(transform.n_frequencies())) {
    report_progress(
        observer, "height differences",
        static_cast<double>(range.begin) / static_cast<double>(transform.n_frequencies()));
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
  report_progress(observer, "height differences", 1);
  const double unit = moments.mean_square > 0 ? moments.mean_square : 1;
  const auto part = [&](auto member, const std::function<double(Index)>& lag_of) {
    return mean_differences(squares.*member * unit, pairs.*member, lag_of);
  };
  return {part(&LagSums::along_x, [&](Index k) { return static_cast<double>(k) * grid.dx(); }),
          part(&LagSums::along_y, [&](Index k) { return static_cast<double>(k) * grid.dy(); }),
          part(&LagSums::over_rings,
               [&](Index k) { return pairs.distances[k] / pairs.over_rings[k]; })};
}

}  // namespace tabor::topography
