// Includes ducc0 and runs its transforms on several rows or columns in one vector, for this module
// alone. No other header includes it.
#pragma once

// A program may hold another ducc0. Threads are those of parallel_for().
#define DUCC0_NAMESPACE tabor_ducc0
#define DUCC0_NO_LOWLEVEL_THREADING
#include <ducc0/fft/fft.h>
#include <ducc0/infra/simd.h>

#include <algorithm>
#include <complex>
#include <cstddef>
#include <memory>
#include <new>

#include "tabor/core/large_pages.hpp"
#include "tabor/core/types.hpp"

namespace tabor::spectral {

namespace ducc = ::tabor_ducc0;

/// Rows or columns that one vector of the processor holds.
template <typename Real>
inline constexpr std::size_t kLanes =
    ducc::simd_exists<Real, static_cast<int>(ducc::native_simd<Real>::size())>
        ? ducc::native_simd<Real>::size()
        : 1;

/// One value of several rows, or a number where the processor has no vectors.
template <typename Real, std::size_t lanes = kLanes<Real>>
struct VectorOf {
  using Type = typename ducc::simd_select<Real, static_cast<int>(lanes)>::type;
  static void set(Type& vector, Index lane, Real value) { vector[lane] = value; }
  static Real get(const Type& vector, Index lane) { return vector[lane]; }
};
template <typename Real>
struct VectorOf<Real, 1> {
  using Type = Real;
  static void set(Real& vector, Index, Real value) { vector = value; }
  static Real get(const Real& vector, Index) { return vector; }
};

/// Memory aligned for vectors. The second parameter is there because FFTW has one allocator for
/// each type.
template <typename T, typename Real>
class Buffer {
 public:
  Buffer() = default;
  explicit Buffer(Index n)
      : data_(
            static_cast<T*>(::operator new(sizeof(T) * static_cast<std::size_t>(n), kAlignment))) {
    ask_for_large_pages(data_.get(), static_cast<std::size_t>(n));
  }
  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }

 private:
  static constexpr std::align_val_t kAlignment{64};
  struct Release {
    void operator()(T* data) const { ::operator delete(data, kAlignment); }
  };
  std::unique_ptr<T, Release> data_;
};

/// Plans of real transforms of rows.
template <typename Real>
class RowTransform {
 public:
  explicit RowTransform(Index n) : plan_(static_cast<std::size_t>(n)) {}
  Index n() const { return static_cast<Index>(plan_.length()); }
  Index n_frequencies() const { return n() / 2 + 1; }
  const ducc::detail_fft::pocketfft_r<Real>& plan() const { return plan_; }

 private:
  ducc::detail_fft::pocketfft_r<Real> plan_;
};

/// Plans of complex transforms of columns.
template <typename Real>
class ColumnTransform {
 public:
  explicit ColumnTransform(Index n) : plan_(static_cast<std::size_t>(n)) {}
  Index n() const { return static_cast<Index>(plan_.length()); }
  const ducc::detail_fft::pocketfft_c<Real>& plan() const { return plan_; }

 private:
  ducc::detail_fft::pocketfft_c<Real> plan_;
};

/// Holds some rows and their spectra while they are transformed. A row lies in the memory of its
/// spectrum: a transform leaves only one of them.
template <typename Real>
class RowBundle {
 public:
  using Complex = std::complex<Real>;
  static constexpr Index kTogether = kLanes<Real>;  ///< rows that are transformed together

  explicit RowBundle(const RowTransform<Real>& transform)
      : plan_(&transform.plan()),
        n_(transform.n()),
        stride_((transform.n_frequencies() + kStep - 1) / kStep * kStep),
        rows_(stride_ * kTogether),
        values_(n_ + kGap + static_cast<Index>(plan_->bufsize())) {}

  Real* row(Index i) { return reinterpret_cast<Real*>(spectrum(i)); }
  Complex* spectrum(Index i) { return rows_.data() + i * stride_; }

  /// Transforms the first `count` rows.
  void forward(Index count) {
    if (count == 1) {
      forward_one();
      return;
    }
    for (Index i = count; i < kTogether; ++i) std::fill(row(i), row(i) + n_, Real(0));
    for (Index k = 0; k < n_; ++k) {
      Vector value;
      for (Index i = 0; i < kTogether; ++i) Lanes::set(value, i, row(i)[k]);
      values_.data()[k] = value;
    }
    const Vector* const found =
        plan_->exec(values_.data(), values_.data() + n_ + kGap, Real(1), true);
    for (Index i = 0; i < kTogether; ++i) spectrum(i)[0] = Lanes::get(found[0], i);
    for (Index k = 1; k < (n_ + 1) / 2; ++k) {
      const Vector real = found[2 * k - 1];
      const Vector imaginary = found[2 * k];
      for (Index i = 0; i < kTogether; ++i) {
        spectrum(i)[k] = {Lanes::get(real, i), Lanes::get(imaginary, i)};
      }
    }
    for (Index i = 0; n_ % 2 == 0 && i < kTogether; ++i) {
      spectrum(i)[n_ / 2] = Lanes::get(found[n_ - 1], i);
    }
  }

  /// Transforms the first `count` spectra back, times n.
  void inverse(Index count) {
    if (count == 1) {
      inverse_one();
      return;
    }
    for (Index i = count; i < kTogether; ++i) {
      std::fill(spectrum(i), spectrum(i) + n_ / 2 + 1, Complex(0));
    }
    Vector* const values = values_.data();
    for (Index i = 0; i < kTogether; ++i) Lanes::set(values[0], i, spectrum(i)[0].real());
    for (Index k = 1; k < (n_ + 1) / 2; ++k) {
      Vector real;
      Vector imaginary;
      for (Index i = 0; i < kTogether; ++i) {
        Lanes::set(real, i, spectrum(i)[k].real());
        Lanes::set(imaginary, i, spectrum(i)[k].imag());
      }
      values[2 * k - 1] = real;
      values[2 * k] = imaginary;
    }
    for (Index i = 0; n_ % 2 == 0 && i < kTogether; ++i) {
      Lanes::set(values[n_ - 1], i, spectrum(i)[n_ / 2].real());
    }
    const Vector* const found = plan_->exec(values, values + n_ + kGap, Real(1), false);
    for (Index k = 0; k < n_; ++k) {
      const Vector value = found[k];
      for (Index i = 0; i < kTogether; ++i) row(i)[k] = Lanes::get(value, i);
    }
  }

 private:
  using Lanes = VectorOf<Real>;
  using Vector = typename Lanes::Type;
  static constexpr Index kStep = 64 / static_cast<Index>(sizeof(Complex));  // whole cache lines
  static constexpr Index kGap = 16;  // input and output then lie apart in the cache

  // ducc0 stores the spectrum of a row as real(0), real(1), imaginary(1), ..., and of an even
  // number of values at last real(n/2).

  void forward_one() {
    Real* const values = row(0);
    const Real* const found =
        plan_->exec(values, reinterpret_cast<Real*>(values_.data()), Real(1), true);
    std::copy_backward(found + 1, found + n_, values + n_ + 1);
    values[0] = found[0];
    values[1] = 0;
    if (n_ % 2 == 0) values[n_ + 1] = 0;
  }

  void inverse_one() {
    Real* const values = row(0);
    std::copy(values + 2, values + n_ + 1, values + 1);
    const Real* const found =
        plan_->exec(values, reinterpret_cast<Real*>(values_.data()), Real(1), false);
    if (found != values) std::copy_n(found, n_, values);
  }

  const ducc::detail_fft::pocketfft_r<Real>* plan_;
  Index n_;
  Index stride_;
  Buffer<Complex, Real> rows_;
  Buffer<Vector, Real> values_;
};

/// Holds a block of columns while they are transformed: a bundle of them in one array of vectors.
template <typename Real>
class ColumnBlock {
 public:
  using Complex = std::complex<Real>;
  static constexpr Index kTogether = kLanes<Real>;  ///< columns that are transformed together

  ColumnBlock(const ColumnTransform<Real>& transform, Index n_columns)
      : plan_(&transform.plan()),
        n_(transform.n()),
        n_columns_(n_columns),
        stride_(n_ + kGap),
        values_(stride_ * n_bundles() + static_cast<Index>(plan_->bufsize())) {}

  /// Takes the first values of all columns from n_rows rows, which lie `width` values apart.
  void load(const Complex* rows, Index width, Index n_rows) {
    n_loaded_ = n_rows;
    const Index n_full = n_columns_ / kTogether;
    for (Index y = 0; y < n_rows; ++y) {
      const Complex* row = rows + y * width;
      Value* value = values_.data() + y;
      for (Index b = 0; b < n_full; ++b, row += kTogether, value += stride_) {
        *value = joined(row, kTogether);
      }
      if (n_full < n_bundles()) *value = joined(row, n_columns_ % kTogether);
    }
  }
  /// Writes the first values of all columns to rows.
  void store(Complex* rows, Index width, Index n_rows) const {
    const Index n_full = n_columns_ / kTogether;
    for (Index y = 0; y < n_rows; ++y) {
      Complex* row = rows + y * width;
      const Value* value = values_.data() + y;
      for (Index b = 0; b < n_full; ++b, row += kTogether, value += stride_) {
        part(*value, kTogether, row);
      }
      if (n_full < n_bundles()) part(*value, n_columns_ % kTogether, row);
    }
  }

  /// Begins columns whose values come from column() and pack() alone.
  void begin_whole() {
    n_loaded_ = n_;
    make_columns();
  }

  /// Transforms a bundle; values that were not loaded are zero.
  void forward(Index bundle) {
    std::fill(values(bundle) + n_loaded_, values(bundle) + n_, Value(Vector(0), Vector(0)));
    plan_->exec_copyback(values(bundle), scratch(), Real(1), true);
  }
  void inverse(Index bundle) { plan_->exec_copyback(values(bundle), scratch(), Real(1), false); }

  /// Multiplies a bundle by factors of frequencies 0 .. n/2, kTogether times: once for each column.
  void multiply(Index bundle, const Real* factors) {
    Value* const value = values(bundle);
    const Index n_factors = n_ / 2 + 1;
    for (Index ky = 0; ky < n_factors; ++ky) {
      Vector factor;
      for (Index i = 0; i < kTogether; ++i) Lanes::set(factor, i, factors[i * n_factors + ky]);
      value[ky] *= factor;
      if (ky != 0 && n_ - ky != ky) value[n_ - ky] *= factor;
    }
  }

  /// Makes column() valid for the columns of a bundle, and pack() ends that.
  void unpack(Index bundle) {
    make_columns();
    const Value* const value = values(bundle);
    Complex* const columns = column(bundle * kTogether);
    for (Index y = 0; y < n_; ++y) {
      for (Index i = 0; i < kTogether; ++i) {
        columns[i * n_ + y] = {Lanes::get(value[y].r, i), Lanes::get(value[y].i, i)};
      }
    }
  }
  void pack(Index bundle) {
    Value* const value = values(bundle);
    const Complex* const columns = column(bundle * kTogether);
    for (Index y = 0; y < n_; ++y) {
      for (Index i = 0; i < kTogether; ++i) {
        Lanes::set(value[y].r, i, columns[i * n_ + y].real());
        Lanes::set(value[y].i, i, columns[i * n_ + y].imag());
      }
    }
  }
  Complex* column(Index x) { return columns_.data() + x * n_; }

 private:
  using Lanes = VectorOf<Real>;
  using Vector = typename Lanes::Type;
  using Value = ducc::Cmplx<Vector>;
  static constexpr Index kGap = 16;  // bundles and scratch then lie apart in the cache

  Index n_bundles() const { return (n_columns_ + kTogether - 1) / kTogether; }
  Value* values(Index bundle) { return values_.data() + bundle * stride_; }
  void make_columns() {
    if (columns_.data() != nullptr) return;
    const Index n = n_ * n_bundles() * kTogether;
    columns_ = Buffer<Complex, Real>(n);
    std::fill_n(columns_.data(), n, Complex(0));
  }
  Value* scratch() { return values_.data() + n_bundles() * stride_; }

  static Value joined(const Complex* row, Index count) {
    Value value(Vector(0), Vector(0));
    for (Index i = 0; i < count; ++i) {
      Lanes::set(value.r, i, row[i].real());
      Lanes::set(value.i, i, row[i].imag());
    }
    return value;
  }
  static void part(const Value& value, Index count, Complex* row) {
    for (Index i = 0; i < count; ++i) row[i] = {Lanes::get(value.r, i), Lanes::get(value.i, i)};
  }

  const ducc::detail_fft::pocketfft_c<Real>* plan_;
  Index n_;
  Index n_columns_;
  Index n_loaded_ = 0;
  Index stride_;
  Buffer<Value, Real> values_;
  Buffer<Complex, Real> columns_;  // one by one, made when column() is first needed
};

}  // namespace tabor::spectral
