#include "tabor/spectral/fft.hpp"

#include <algorithm>
#include <numbers>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/spectral/fftw_library.hpp"

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
  for_each_column(spectrum, ny(), spectrum_columns(), ny(),
                  [this](Index, Complex* column) { plans_->columns.forward(column); });
}

template <typename Real>
void RealFft2d<Real>::inverse(Complex* spectrum, Real* map) const {
  for_each_column(spectrum, ny(), spectrum_columns(), ny(),
                  [this](Index, Complex* column) { plans_->columns.inverse(column); });
  const Real scale = Real(1) / static_cast<Real>(nx() * ny());
  rows_inverse(plans_->rows, spectrum, ny(), nx(), scale, map);
}

template <typename Real>
struct Convolution<Real>::State {
  State(Index rows_count, Index columns_count, Index factor)
      : ny(rows_count),
        nx(columns_count),
        rows(columns_count * factor),
        columns(rows_count * factor),
        spectrum(rows_count * rows.n_frequencies()) {}
  Index ny;
  Index nx;
  RowTransform<Real> rows;
  ColumnTransform<Real> columns;
  Buffer<std::complex<Real>, Real> spectrum;
};

template <typename Real>
Convolution<Real>::Convolution(Index ny, Index nx, Padding padding)
    : state_(std::make_unique<State>(ny, nx, padding == Padding::zero ? 2 : 1)) {}
template <typename Real>
Convolution<Real>::~Convolution() = default;
template <typename Real>
Convolution<Real>::Convolution(Convolution&&) noexcept = default;
template <typename Real>
Convolution<Real>& Convolution<Real>::operator=(Convolution&&) noexcept = default;

template <typename Real>
void Convolution<Real>::apply(const Real* in, const Multiplier<Real>& multiplier, Real* out) {
  State& s = *state_;
  rows_forward(s.rows, in, s.ny, s.nx, s.spectrum.data());
  const Index n = s.columns.n();
  for_each_column(s.spectrum.data(), s.ny, s.rows.n_frequencies(), n,
                  [&](Index kx, std::complex<Real>* column) {
                    thread_local std::vector<Real> factors;
                    factors.resize(static_cast<std::size_t>(n / 2 + 1));
                    multiplier(kx, factors);
                    s.columns.forward(column);
                    column[0] *= factors[0];
                    for (Index ky = 1; ky <= n / 2; ++ky) {
                      const Real factor = factors[static_cast<std::size_t>(ky)];
                      column[ky] *= factor;
                      if (n - ky != ky) column[n - ky] *= factor;
                    }
                    s.columns.inverse(column);
                  });
  const Real scale = Real(1) / static_cast<Real>(n * s.rows.n());
  rows_inverse(s.rows, s.spectrum.data(), s.ny, s.nx, scale, out);
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

/// Replaces n/2 + 1 values of an even sequence of n by its (real) spectrum.
void transform_even(const RowTransform<double>& transform, double* values, Index stride) {
  const Index n = transform.n();
  Buffer<double, double> sequence(n);
  Buffer<std::complex<double>, double> spectrum(n / 2 + 1);
  for (Index k = 0; k < n; ++k) sequence.data()[k] = values[std::min(k, n - k) * stride];
  transform.forward(sequence.data(), spectrum.data());
  for (Index k = 0; k <= n / 2; ++k) values[k * stride] = spectrum.data()[k].real();
}

}  // namespace

Field even_spectrum(Index ny, Index nx, const std::function<double(Index y, Index x)>& value) {
  const RowTransform<double> along_x(nx);
  const RowTransform<double> along_y(ny);
  Field spectrum(nx / 2 + 1, ny / 2 + 1);
  parallel_for(spectrum.rows(), 1, [&](Index x, Index) {
    for (Index y = 0; y <= ny / 2; ++y) spectrum(x, y) = value(y, x);
    transform_even(along_y, &spectrum(x, 0), 1);
  });
  parallel_for(spectrum.cols(), 8, [&](Index begin, Index end) {
    for (Index y = begin; y < end; ++y) transform_even(along_x, &spectrum(0, y), spectrum.cols());
  });
  return spectrum;
}

namespace {

std::filesystem::path single_precision_file(const std::filesystem::path& file) {
  return std::filesystem::path(file).concat(".float");
}

template <typename Real>
void measure(Index n) {
  Buffer<std::complex<Real>, Real> values(n + 2);
  auto* complex = as_fftw(values.data());
  auto* real = reinterpret_cast<Real*>(values.data());
  Buffer<Real, Real> other(2 * (n + 2));
  auto* other_complex = as_fftw(reinterpret_cast<std::complex<Real>*>(other.data()));
  const unsigned flags = FFTW_MEASURE | FFTW_DESTROY_INPUT;
  const int size = static_cast<int>(n);
  for (auto plan : {Fftw<Real>::plan_c2c(size, complex, complex, FFTW_FORWARD, flags),
                    Fftw<Real>::plan_c2c(size, complex, complex, FFTW_BACKWARD, flags),
                    Fftw<Real>::plan_r2c(size, real, other_complex, flags),
                    Fftw<Real>::plan_c2r(size, complex, other.data(), flags)}) {
    Fftw<Real>::destroy(plan);
  }
}

}  // namespace

void load_wisdom(const std::filesystem::path& file) {
  const std::lock_guard lock(planner_mutex);
  const bool loaded = fftw_import_wisdom_from_filename(file.c_str()) != 0 &&
                      fftwf_import_wisdom_from_filename(single_precision_file(file).c_str()) != 0;
  if (!loaded) {
    throw InputError("FFT wisdom " + file.string(), "no readable pair of FFTW wisdom files",
                     "files written by this version of FFTW", "measure them again");
  }
  wisdom_is_loaded = true;
}

void measure_wisdom(Index ny, Index nx, const std::filesystem::path& file) {
  const std::lock_guard lock(planner_mutex);
  for (const Index n : {nx, ny, 2 * nx, 2 * ny}) {
    measure<double>(n);
    measure<float>(n);
  }
  if (fftw_export_wisdom_to_filename(file.c_str()) == 0 ||
      fftwf_export_wisdom_to_filename(single_precision_file(file).c_str()) == 0) {
    throw OutputError("cannot write FFT wisdom to " + file.string());
  }
}

}  // namespace tabor::spectral
