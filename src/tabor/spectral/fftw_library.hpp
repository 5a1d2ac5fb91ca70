// Includes FFTW and wraps its plans and buffers, for this module alone. No other file includes it.
#pragma once

#include <fftw3.h>

#include <algorithm>
#include <complex>
#include <functional>
#include <memory>
#include <new>

#include "tabor/core/large_pages.hpp"
#include "tabor/core/types.hpp"

namespace tabor::spectral {

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
    ask_for_large_pages(data_.get(), static_cast<std::size_t>(n));
  }
  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }

 private:
  struct Release {
    void operator()(T* data) const { Fftw<Real>::release(data); }
  };
  std::unique_ptr<T, Release> data_;
};

template <typename Real>
auto* as_fftw(std::complex<Real>* values) {
  return reinterpret_cast<typename Fftw<Real>::Complex*>(values);  // same layout by FFTW's contract
}

/// One-dimensional plan, made with stored wisdom where there is some and estimated elsewhere.
template <typename Real>
class Plan {
 public:
  using Handle = typename Fftw<Real>::Plan;

  explicit Plan(const std::function<Handle(unsigned flags)>& make);
  ~Plan();
  Plan(const Plan&) = delete;
  Plan& operator=(const Plan&) = delete;
  Handle handle() const { return plan_; }

 private:
  Handle plan_ = nullptr;
};

/// Plans of real transforms of single rows, through aligned buffers.
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

/// Plans of in-place complex transforms of single columns.
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

/// Holds a row and its spectrum while they are transformed.
template <typename Real>
class RowBundle {
 public:
  using Complex = std::complex<Real>;
  static constexpr Index kTogether = 1;  ///< rows that are transformed together

  explicit RowBundle(const RowTransform<Real>& transform)
      : transform_(&transform), row_(transform.n()), spectrum_(transform.n_frequencies()) {}

  Real* row(Index) { return row_.data(); }
  Complex* spectrum(Index) { return spectrum_.data(); }
  void forward(Index) { transform_->forward(row_.data(), spectrum_.data()); }
  void inverse(Index) { transform_->inverse(spectrum_.data(), row_.data()); }

 private:
  const RowTransform<Real>* transform_;
  Buffer<Real, Real> row_;
  Buffer<Complex, Real> spectrum_;
};

/// Holds a block of columns while they are transformed: one after the other, each contiguous.
template <typename Real>
class ColumnBlock {
 public:
  using Complex = std::complex<Real>;
  static constexpr Index kTogether = 1;  ///< columns that are transformed together

  ColumnBlock(const ColumnTransform<Real>& transform, Index n_columns)
      : transform_(&transform),
        n_columns_(n_columns),
        stride_((transform.n() / kStep + 1) * kStep),
        values_(stride_ * n_columns) {}

  /// Takes the first values of all columns from n_rows rows, which lie `width` values apart.
  void load(const Complex* rows, Index width, Index n_rows) {
    n_loaded_ = n_rows;
    for (Index y = 0; y < n_rows; ++y) {
      for (Index x = 0; x < n_columns_; ++x) column(x)[y] = rows[y * width + x];
    }
  }
  /// Writes the first values of all columns to rows.
  void store(Complex* rows, Index width, Index n_rows) {
    for (Index y = 0; y < n_rows; ++y) {
      for (Index x = 0; x < n_columns_; ++x) rows[y * width + x] = column(x)[y];
    }
  }

  /// Begins columns whose values come from column() and pack() alone.
  void begin_whole() { n_loaded_ = transform_->n(); }

  /// Transforms a bundle; values that were not loaded are zero.
  void forward(Index bundle) {
    std::fill(column(bundle) + n_loaded_, column(bundle) + transform_->n(), Complex(0));
    transform_->forward(column(bundle));
  }
  void inverse(Index bundle) { transform_->inverse(column(bundle)); }

  /// Multiplies a bundle by factors of frequencies 0 .. n/2, kTogether times: once for each column.
  void multiply(Index bundle, const Real* factors) {
    const Index n = transform_->n();
    Complex* const values = column(bundle);
    values[0] *= factors[0];
    for (Index ky = 1; ky <= n / 2; ++ky) {
      values[ky] *= factors[ky];
      if (n - ky != ky) values[n - ky] *= factors[ky];
    }
  }

  /// Makes column() valid for the columns of a bundle, and pack() ends that.
  void unpack(Index) {}
  void pack(Index) {}
  Complex* column(Index x) { return values_.data() + x * stride_; }

 private:
  // Columns begin at cache lines, and never so far apart that they share the few places of one.
  static constexpr Index kStep = 64 / static_cast<Index>(sizeof(Complex));

  const ColumnTransform<Real>* transform_;
  Index n_columns_;
  Index n_loaded_ = 0;
  Index stride_;
  Buffer<Complex, Real> values_;
};

}  // namespace tabor::spectral
