#include "tabor/comparison/coarse_match.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "tabor/spectral/fft.hpp"

namespace tabor::comparison {
namespace {

using Complex = std::complex<double>;
using Spectrum = std::vector<Complex>;

/// Correlations of zero-padded maps.
class Correlator {
 public:
  Correlator(const Field& a, const Field& b)
      : ny_(spectral::good_fft_size(a.rows() + b.rows() - 1)),
        nx_(spectral::good_fft_size(a.cols() + b.cols() - 1)),
        transform_(ny_, nx_) {}

  Index ny() const { return ny_; }
  Index nx() const { return nx_; }

  Spectrum spectrum(const Field& map) const {
    Field padded = Field::Zero(ny_, nx_);
    padded.topLeftCorner(map.rows(), map.cols()) = map;
    Spectrum result(static_cast<std::size_t>(ny_ * transform_.spectrum_columns()));
    transform_.forward(padded.data(), result.data());
    return result;
  }

  /// sum_r a(r) b(r + l) at row, column = l, or ny + l, nx + l for negative ones.
  Field correlate(const Spectrum& a, const Spectrum& b) const {
    Spectrum product(a.size());
    std::transform(a.begin(), a.end(), b.begin(), product.begin(),
                   [](Complex x, Complex y) { return std::conj(x) * y; });
    Field result(ny_, nx_);
    transform_.inverse(product.data(), result.data());
    return result;
  }

 private:
  Index ny_, nx_;
  spectral::RealFft2d<double> transform_;
};

/// Spectra of a map's mask, of its heights about their mean, and of their squares.
struct MapSpectra {
  MapSpectra(const Field& map, const Correlator& correlator) {
    const auto missing = map.isNaN();
    const Field mask = 1 - missing.cast<double>();
    n_valid = mask.sum();
    const double mean = missing.select(0, map).sum() / std::max(1.0, n_valid);
    const Field z = missing.select(0, map - mean);
    valid = correlator.spectrum(mask);
    heights = correlator.spectrum(z);
    squares = correlator.spectrum(z.square());
    mean_square = z.square().sum() / std::max(1.0, n_valid);
  }
  double n_valid = 0;
  double mean_square = 0;
  Spectrum valid, heights, squares;
};

/// Correlation coefficient at every shift times the square root of the common pixels (unrelated
/// maps give it about the same scatter everywhere); NaN where too few are common.
struct Scores {
  Field score;
  Field pixels;
};

Scores scores_of(const Correlator& correlator, const MapSpectra& a, const MapSpectra& b,
                 double fewest) {
  Scores result;
  result.pixels = correlator.correlate(a.valid, b.valid).round();
  const Field& n = result.pixels;
  const Field sum_a = correlator.correlate(a.heights, b.valid);
  const Field sum_b = correlator.correlate(a.valid, b.heights);
  const Field variance_a = correlator.correlate(a.squares, b.valid) - sum_a.square() / n;
  const Field variance_b = correlator.correlate(a.valid, b.squares) - sum_b.square() / n;
  const Field covariance = correlator.correlate(a.heights, b.heights) - sum_a * sum_b / n;
  const auto known =
      n >= fewest && variance_a > 1e-9 * n * a.mean_square && variance_b > 1e-9 * n * b.mean_square;
  result.score = known.select(covariance / (variance_a * variance_b).sqrt() * n.sqrt(),
                              std::numeric_limits<double>::quiet_NaN());
  return result;
}

Index signed_lag(Index index, Index n, Index n_positive) {
  return index < n_positive ? index : index - n;
}

}  // namespace

CoarseMatch match_coarsely(const Field& a, const Field& b, double smallest_overlap, Index lobe) {
  const Correlator correlator(a, b);
  const MapSpectra spectra_a(a, correlator), spectra_b(b, correlator);
  const double fewest =
      std::max(9.0, smallest_overlap * std::min(spectra_a.n_valid, spectra_b.n_valid));
  const auto [score, pixels] = scores_of(correlator, spectra_a, spectra_b, fewest);
  CoarseMatch match;
  double best = -std::numeric_limits<double>::infinity();
  std::vector<double> sizes;
  for (Index y = 0; y < score.rows(); ++y) {
    for (Index x = 0; x < score.cols(); ++x) {
      if (std::isnan(score(y, x))) continue;
      sizes.push_back(std::abs(score(y, x)));
      if (score(y, x) > best) {
        best = score(y, x);
        match.shift_x = signed_lag(x, score.cols(), b.cols());
        match.shift_y = signed_lag(y, score.rows(), b.rows());
        match.correlation = best / std::sqrt(pixels(y, x));
      }
    }
  }
  match.n_shifts = std::ssize(sizes);
  if (sizes.empty()) return match;
  const auto middle = sizes.begin() + std::ssize(sizes) / 2;
  std::nth_element(sizes.begin(), middle, sizes.end());
  match.distinction = best / (1.482602218505602 * *middle);
  for (Index y = 0; y < score.rows(); ++y) {
    for (Index x = 0; x < score.cols(); ++x) {
      const Index away_x = signed_lag(x, score.cols(), b.cols()) - match.shift_x;
      const Index away_y = signed_lag(y, score.rows(), b.rows()) - match.shift_y;
      if (away_x * away_x + away_y * away_y > lobe * lobe && score(y, x) > 0) {
        match.runner_up = std::max(match.runner_up, score(y, x) / best);
      }
    }
  }
  return match;
}

}  // namespace tabor::comparison
