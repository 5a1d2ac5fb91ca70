// The only file that knows FFTW.
#include "tabor/spectral/fft.hpp"

#include <fftw3.h>

#include <algorithm>
#include <mutex>
#include <numbers>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/core/parallel.hpp"

namespace tabor::spectral {
namespace {

/// FFTW's planner is not thread-safe; its plans are.
std::mutex planner_mutex;
bool wisdom_is_loaded = false;

template <typename Real>
struct Fftw;

template <>
struct Fftw<double> {
  using Plan = fftw_plan;
  using Complex = fftw_complex;
  static constexpr auto allocate = fftw_malloc;
  static constexpr auto release = fftw_free;
  static constexpr auto destroy = fftw_destroy_plan;
  static constexpr auto plan_r2c = fftw_plan_dft_r2c_1d;
  static constexpr auto plan_c2r = fftw_plan_dft_c2r_1d;
  static constexpr auto plan_c2c = fftw_plan_dft_1d;
  static constexpr auto run_r2c = fftw_execute_dft_r2c;
  static constexpr auto run_c2r = fftw_execute_dft_c2r;
  static constexpr auto run_c2c = fftw_execute_dft;
};

template <>
struct Fftw<float> {
  using Plan = fftwf_plan;
  using Complex = fftwf_complex;
  static constexpr auto allocate = fftwf_malloc;
  static constexpr auto release = fftwf_free;
  static constexpr auto destroy = fftwf_destroy_plan;
  static constexpr auto plan_r2c = fftwf_plan_dft_r2c_1d;
  static constexpr auto plan_c2r = fftwf_plan_dft_c2r_1d;
  static constexpr auto plan_c2c = fftwf_plan_dft_1d;
  static constexpr auto run_r2c = fftwf_execute_dft_r2c;
  static constexpr auto run_c2r = fftwf_execute_dft_c2r;
  static constexpr auto run_c2c = fftwf_execute_dft;
};

/// Memory aligned for FFTW's vector code.
template <typename T, typename Real>
class Buffer {
 public:
  explicit Buffer(Index n)
      : data_(static_cast<T*>(Fftw<Real>::allocate(sizeof(T) * static_cast<std::size_t>(n)))) {
    if (data_ == nullptr) {
      throw std::bad_alloc();
    }
  }
  ~Buffer() { Fftw<Real>::release(data_); }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;
  T* data() { return data_; }
  const T* data() const { return data_; }

 private:
  T* data_;
};

template <typename Real>
auto* as_fftw(std::complex<Real>* values) {
  return reinterpret_cast<typename Fftw<Real>::Complex*>(values);  // same layout by FFTW's contract
}

/// A one-dimensional plan, made with stored wisdom where there is some and estimated elsewhere.
template <typename Real>
class Plan {
 public:
  template <typename Make>
  explicit Plan(const Make& make) {
    const std::lock_guard lock(planner_mutex);
    if (wisdom_is_loaded) {
      plan_ = make(FFTW_MEASURE | FFTW_WISDOM_ONLY | FFTW_DESTROY_INPUT);
    }
    if (plan_ == nullptr) {
      plan_ = make(FFTW_ESTIMATE | FFTW_DESTROY_INPUT);
    }
    if (plan_ == nullptr) {
      throw Error("FFTW made no plan");
    }
  }
  ~Plan() {
    const std::lock_guard lock(planner_mutex);
    Fftw<Real>::destroy(plan_);
  }
  Plan(const Plan&) = delete;
  Plan& operator=(const Plan&) = delete;
  typename Fftw<Real>::Plan handle() const { return plan_; }

 private:
  typename Fftw<Real>::Plan plan_ = nullptr;
};

/// Real transforms of single rows, through aligned buffers.
template <typename Real>
class RowTransform {
 public:
  using Complex = std::complex<Real>;

  explicit RowTransform(Index n)
      : n_(n),
        real_(n),
        complex_(n / 2 + 1),
        forward_([this](unsigned flags) {
          return Fftw<Real>::plan_r2c(static_cast<int>(n_), real_.data(), as_fftw(complex_.data()),
                                      flags);
        }),
        inverse_([this](unsigned flags) {
          return Fftw<Real>::plan_c2r(static_cast<int>(n_), as_fftw(complex_.data()), real_.data(),
                                      flags);
        }) {}

  Index n() const { return n_; }
  Index n_frequencies() const { return n_ / 2 + 1; }

  void forward(Real* row, Complex* spectrum) const {
    Fftw<Real>::run_r2c(forward_.handle(), row, as_fftw(spectrum));
  }
  void inverse(Complex* spectrum, Real* row) const {
    Fftw<Real>::run_c2r(inverse_.handle(), as_fftw(spectrum), row);
  }

 private:
  Index n_;
  Buffer<Real, Real> real_;  // what the plans were made with; never used afterwards
  Buffer<Complex, Real> complex_;
  Plan<Real> forward_;
  Plan<Real> inverse_;
};

/// In-place complex transforms of single columns.
template <typename Real>
class ColumnTransform {
 public:
  using Complex = std::complex<Real>;

  explicit ColumnTransform(Index n)
      : n_(n), buffer_(n), forward_(plan(FFTW_FORWARD)), inverse_(plan(FFTW_BACKWARD)) {}

  Index n() const { return n_; }
  void forward(Complex* column) const {
    Fftw<Real>::run_c2c(forward_.handle(), as_fftw(column), as_fftw(column));
  }
  void inverse(Complex* column) const {
    Fftw<Real>::run_c2c(inverse_.handle(), as_fftw(column), as_fftw(column));
  }

 private:
  Plan<Real> plan(int sign) {
    return Plan<Real>([this, sign](unsigned flags) {
      auto* data = as_fftw(buffer_.data());
      return Fftw<Real>::plan_c2c(static_cast<int>(n_), data, data, sign, flags);
    });
  }

  Index n_;
  Buffer<Complex, Real> buffer_;
  Plan<Real> forward_;
  Plan<Real> inverse_;
};

constexpr Index kRowsPerBlock = 16;
constexpr Index kColumnsPerBlock = 16;  // whole cache lines of a row, and the block stays in L2

/// Stride of one column inside a block buffer, kept a multiple of the vector length.
template <typename Real>
Index column_stride(Index n) {
  constexpr Index step = 64 / static_cast<Index>(sizeof(std::complex<Real>));
  return (n + step - 1) / step * step;
}

/// Transforms the n_rows rows of `map` (length row_length, zero-padded to the plan's length).
template <typename Real>
void rows_forward(const RowTransform<Real>& transform, const Real* map, Index n_rows,
                  Index row_length, std::complex<Real>* spectrum) {
  const Index n_frequencies = transform.n_frequencies();
  parallel_for(n_rows, kRowsPerBlock, [&](Index begin, Index end) {
    Buffer<Real, Real> row(transform.n());
    Buffer<std::complex<Real>, Real> frequencies(n_frequencies);
    for (Index y = begin; y < end; ++y) {
      std::copy_n(map + y * row_length, row_length, row.data());
      std::fill(row.data() + row_length, row.data() + transform.n(), Real(0));
      transform.forward(row.data(), frequencies.data());
      std::copy_n(frequencies.data(), n_frequencies, spectrum + y * n_frequencies);
    }
  });
}

/// Inverse of rows_forward, times `scale`; only the first row_length values of each row are kept.
template <typename Real>
void rows_inverse(const RowTransform<Real>& transform, const std::complex<Real>* spectrum,
                  Index n_rows, Index row_length, Real scale, Real* map) {
  const Index n_frequencies = transform.n_frequencies();
  parallel_for(n_rows, kRowsPerBlock, [&](Index begin, Index end) {
    Buffer<Real, Real> row(transform.n());
    Buffer<std::complex<Real>, Real> frequencies(n_frequencies);
    for (Index y = begin; y < end; ++y) {
      std::copy_n(spectrum + y * n_frequencies, n_frequencies, frequencies.data());
      transform.inverse(frequencies.data(), row.data());
      std::transform(row.data(), row.data() + row_length, map + y * row_length,
                     [scale](Real value) { return value * scale; });
    }
  });
}

/// Calls work(kx, column) for every column of the spectrum: a contiguous buffer of n values of
/// which the first n_rows come from and go back to the spectrum; the rest starts as zero.
template <typename Real, typename Work>
void for_each_column(std::complex<Real>* spectrum, Index n_rows, Index n_columns, Index n,
                     const Work& work) {
  const Index stride = column_stride<Real>(n);
  parallel_for(n_columns, kColumnsPerBlock, [&](Index begin, Index end) {
    Buffer<std::complex<Real>, Real> columns(stride * (end - begin));
    for (Index y = 0; y < n_rows; ++y) {
      for (Index x = begin; x < end; ++x) {
        columns.data()[(x - begin) * stride + y] = spectrum[y * n_columns + x];
      }
    }
    for (Index x = begin; x < end; ++x) {
      std::complex<Real>* column = columns.data() + (x - begin) * stride;
      std::fill(column + n_rows, column + n, std::complex<Real>(0));
      work(x, column);
    }
    for (Index y = 0; y < n_rows; ++y) {
      for (Index x = begin; x < end; ++x) {
        spectrum[y * n_columns + x] = columns.data()[(x - begin) * stride + y];
      }
    }
  });
}

}  // namespace

Index good_fft_size(Index n) {
  for (Index size = std::max<Index>(n, 1);; ++size) {
    if (largest_prime_factor(size) <= 7) {
      return size;
    }
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
                      if (n - ky != ky) {
                        column[n - ky] *= factor;
                      }
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
  for (Index k = 0; k < n; ++k) {
    sequence.data()[k] = values[std::min(k, n - k) * stride];
  }
  transform.forward(sequence.data(), spectrum.data());
  for (Index k = 0; k <= n / 2; ++k) {
    values[k * stride] = spectrum.data()[k].real();
  }
}

}  // namespace

Field even_spectrum(Index ny, Index nx, const std::function<double(Index y, Index x)>& value) {
  const RowTransform<double> along_x(nx);
  const RowTransform<double> along_y(ny);
  Field spectrum(nx / 2 + 1, ny / 2 + 1);
  parallel_for(spectrum.rows(), 1, [&](Index x, Index) {
    for (Index y = 0; y <= ny / 2; ++y) {
      spectrum(x, y) = value(y, x);
    }
    transform_even(along_y, &spectrum(x, 0), 1);
  });
  parallel_for(spectrum.cols(), 8, [&](Index begin, Index end) {
    for (Index y = begin; y < end; ++y) {
      transform_even(along_x, &spectrum(0, y), spectrum.cols());
    }
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
