#include "tabor/spectral/fft.hpp"

#include <algorithm>
#include <numbers>
#include <vector>

#include "tabor/core/parallel.hpp"
#include "tabor/spectral/mirrored.hpp"
#include "tabor/spectral/transform_library.hpp"

namespace tabor::spectral {

Index good_fft_size(Index n) {
  for (Index size = std::max<Index>(n, 1);; ++size) {
    if (largest_prime_factor(size) <= 7) return size;
  }
}

Index largest_prime_factor(Index n) {
  Index largest = 1;
  for (Index factor = 2; factor * factor <= n; ++factor) {
    while (n % factor == 0) {
      largest = factor;
      n /= factor;
    }
  }
  return std::max(largest, n);
}

double wavevector(Index k, Index n, double length) {
  const Index signed_index = k <= n / 2 ? k : k - n;
  return 2 * std::numbers::pi * static_cast<double>(signed_index) / length;
}

template <typename Real>
struct RealFft2d<Real>::Plans {
  Plans(Index ny, Index nx) : rows(nx), columns(ny) {}
  RowTransform<Real> rows;
  ColumnTransform<Real> columns;
};

template <typename Real>
RealFft2d<Real>::RealFft2d(Index ny, Index nx) : plans_(std::make_unique<Plans>(ny, nx)) {}
template <typename Real>
RealFft2d<Real>::~RealFft2d() = default;
template <typename Real>
RealFft2d<Real>::RealFft2d(RealFft2d&&) noexcept = default;
template <typename Real>
RealFft2d<Real>& RealFft2d<Real>::operator=(RealFft2d&&) noexcept = default;
template <typename Real>
Index RealFft2d<Real>::ny() const {
  return plans_->columns.n();
}
template <typename Real>
Index RealFft2d<Real>::nx() const {
  return plans_->rows.n();
}

template <typename Real>
void RealFft2d<Real>::forward(const Real* map, Complex* spectrum) const {
  rows_forward(plans_->rows, map, ny(), nx(), spectrum);
  for_each_column_bundle(
      plans_->columns, spectrum, ny(), spectrum_columns(),
      [](ColumnBlock<Real>& block, Index bundle, Index, Index) { block.forward(bundle); });
}

template <typename Real>
void RealFft2d<Real>::inverse(Complex* spectrum, Real* map) const {
  for_each_column_bundle(
      plans_->columns, spectrum, ny(), spectrum_columns(),
      [](ColumnBlock<Real>& block, Index bundle, Index, Index) { block.inverse(bundle); });
  const Real scale = Real(1) / static_cast<Real>(nx() * ny());
  rows_inverse(plans_->rows, spectrum, ny(), nx(), scale, map);
}

template <typename Real>
class Convolution<Real>::State {
 public:
  virtual ~State() = default;
  virtual void apply(const Real* in, const Multiplier<Real>& multiplier, Real* out) = 0;
};

/// The map with itself or with zeros beyond its borders: `factor` times its size.
template <typename Real>
class Convolution<Real>::Padded final : public State {
 public:
  Padded(Index ny, Index nx, Index factor)
      : ny_(ny),
        nx_(nx),
        rows_(nx * factor),
        columns_(ny * factor),
        spectrum_(ny * rows_.n_frequencies()) {}

  void apply(const Real* in, const Multiplier<Real>& multiplier, Real* out) override {
    rows_forward(rows_, in, ny_, nx_, spectrum_.data());
    const Index n = columns_.n();
    const auto n_factors = static_cast<std::size_t>(n / 2 + 1);
    for_each_column_bundle(
        columns_, spectrum_.data(), ny_, rows_.n_frequencies(),
        [&](ColumnBlock<Real>& block, Index bundle, Index kx, Index count) {
          thread_local std::vector<Real> factors;
          factors.resize(n_factors * static_cast<std::size_t>(ColumnBlock<Real>::kTogether));
          for (Index i = 0; i < count; ++i) {
            multiplier(kx + i,
                       {factors.data() + static_cast<std::size_t>(i) * n_factors, n_factors});
          }
          block.forward(bundle);
          block.multiply(bundle, factors.data());
          block.inverse(bundle);
        });
    const Real scale = Real(1) / static_cast<Real>(n * rows_.n());
    rows_inverse(rows_, spectrum_.data(), ny_, nx_, scale, out);
  }

 private:
  Index ny_;
  Index nx_;
  RowTransform<Real> rows_;
  ColumnTransform<Real> columns_;
  Buffer<std::complex<Real>, Real> spectrum_;
};

template <typename Real>
class Convolution<Real>::Mirrored final : public State {
 public:
  Mirrored(Index ny, Index nx) : convolution_(ny, nx) {}
  void apply(const Real* in, const Multiplier<Real>& multiplier, Real* out) override {
    convolution_.apply(in, multiplier, out);
  }

 private:
  MirroredConvolution<Real> convolution_;
};

template <typename Real>
Convolution<Real>::Convolution(Index ny, Index nx, Padding padding) {
  if (padding == Padding::mirror) {
    state_ = std::make_unique<Mirrored>(ny, nx);
  } else {
    state_ = std::make_unique<Padded>(ny, nx, padding == Padding::zero ? 2 : 1);
  }
}
template <typename Real>
Convolution<Real>::~Convolution() = default;
template <typename Real>
Convolution<Real>::Convolution(Convolution&&) noexcept = default;
template <typename Real>
Convolution<Real>& Convolution<Real>::operator=(Convolution&&) noexcept = default;

template <typename Real>
void Convolution<Real>::apply(const Real* in, const Multiplier<Real>& multiplier, Real* out) {
  state_->apply(in, multiplier, out);
}

template class RealFft2d<float>;
template class RealFft2d<double>;
template class Convolution<float>;
template class Convolution<double>;

void forward_rows(
    const Field& map,
    Eigen::Array<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>& spectrum) {
  const RowTransform<double> transform(map.cols());
  spectrum.resize(map.rows(), transform.n_frequencies());
  rows_forward(transform, map.data(), map.rows(), map.cols(), spectrum.data());
}

namespace {

/// Replaces `count` even sequences of n by their (real) spectra: n/2 + 1 values each, `step` values
/// apart, and the sequences `stride` values apart.
void transform_even(const RowTransform<double>& transform, double* values, Index count, Index step,
                    Index stride) {
  const Index n = transform.n();
  for_each_row_bundle(transform, count, [&](RowBundle<double>& rows, Index first, Index together) {
    for (Index i = 0; i < together; ++i) {
      const double* const sequence = values + (first + i) * stride;
      for (Index k = 0; k < n; ++k) rows.row(i)[k] = sequence[std::min(k, n - k) * step];
    }
    rows.forward(together);
    for (Index i = 0; i < together; ++i) {
      double* const sequence = values + (first + i) * stride;
      for (Index k = 0; k <= n / 2; ++k) sequence[k * step] = rows.spectrum(i)[k].real();
    }
  });
}

}  // namespace

Field even_spectrum(Index ny, Index nx, const std::function<double(Index y, Index x)>& value) {
  const RowTransform<double> along_x(nx);
  const RowTransform<double> along_y(ny);
  Field spectrum(nx / 2 + 1, ny / 2 + 1);
  parallel_for(spectrum.rows(), 1, [&](Index x, Index) {
    for (Index y = 0; y <= ny / 2; ++y) spectrum(x, y) = value(y, x);
  });
  transform_even(along_y, spectrum.data(), spectrum.rows(), 1, spectrum.cols());
  transform_even(along_x, spectrum.data(), spectrum.cols(), spectrum.cols(), 1);
  return spectrum;
}

}  // namespace tabor::spectral
