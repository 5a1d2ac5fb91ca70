// Includes FFTW and wraps its plans and buffers, for this module alone. No other file includes it.
#pragma once

#include <fftw3.h>
#include <pthread.h>

#include <algorithm>
#include <complex>
#include <mutex>
#include <new>

#include "tabor/core/error.hpp"
#include "tabor/core/large_pages.hpp"
#include "tabor/core/parallel.hpp"

namespace tabor::spectral {

/// FFTW's planner is not thread-safe; its plans are.
inline std::mutex planner_mutex;
/// Makes fork() wait for the planner, so that a copy of the process finds it in a consistent state
/// and unlocked.
[[maybe_unused]] inline const int keeps_planner_free = ::pthread_atfork(
    [] { planner_mutex.lock(); }, [] { planner_mutex.unlock(); }, [] { planner_mutex.unlock(); });
inline bool wisdom_is_loaded = false;

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
    if (data_ == nullptr) throw std::bad_alloc();
    ask_for_large_pages(data_, static_cast<std::size_t>(n));
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

/// One-dimensional plan, made with stored wisdom where there is some and estimated elsewhere.
template <typename Real>
class Plan {
 public:
  template <typename Make>
  explicit Plan(const Make& make) {
    const std::lock_guard lock(planner_mutex);
    if (wisdom_is_loaded) plan_ = make(FFTW_MEASURE | FFTW_WISDOM_ONLY | FFTW_DESTROY_INPUT);
    if (plan_ == nullptr) plan_ = make(FFTW_ESTIMATE | FFTW_DESTROY_INPUT);
    if (plan_ == nullptr) throw Error("FFTW made no plan");
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

inline constexpr Index kRowsPerBlock = 16;
inline constexpr Index kColumnsPerBlock =
    16;  // whole cache lines of a row, and the block stays in L2

/// Stride of one column inside a block buffer, rounded up to a multiple of the vector length.
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

/// Inverse of rows_forward, times `scale`; only the first row_length values of each row are stored.
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

}  // namespace tabor::spectral
