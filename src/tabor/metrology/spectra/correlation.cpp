#include "tabor/metrology/spectra/correlation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "tabor/core/parallel.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/metrology/spectra/lag_sums.hpp"
#include "tabor/spectral/strips.hpp"

namespace tabor::metrology {
namespace {

using spectral::ColumnRange;
using std::numbers::pi;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

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
    if (n_valid == static_cast<double>(grid.size())) return;
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
  const spectral::StripTransform<float> transform(grid.ny, grid.nx, padded_for_lags(grid.ny),
                                                  padded_for_lags(grid.nx));
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
  if (ly >= grid_.ny || std::abs(lx) >= grid_.nx) return kNaN;
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
  constexpr double kRounding = 1e-9;  // a ray along y must not step aside, out of a single column
  const double cosine = std::cos(angle);
  const double c = std::abs(cosine) < kRounding ? 0 : cosine;
  const double s = std::sin(angle);
  const double step = 0.5 / std::hypot(c / grid.dx(), s / grid.dy());  // half a pixel
  double before = 1;
  for (Index i = 1;; ++i) {
    const double radius = static_cast<double>(i) * step;
    const double value = acf.at(radius * s, radius * c);
    if (!std::isfinite(value)) return {radius - step, false};
    if (value <= threshold) return {radius - step * (threshold - value) / (before - value), true};
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
  if (finished) lengths.longest = longest;
  return lengths;
}

}  // namespace tabor::metrology
