#pragma once

#include <complex>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "tabor/core/types.hpp"

// Transforms real maps by fast Fourier transforms and convolves them with spectral multipliers.
namespace tabor::spectral {

/// Returns the smallest n' >= n whose prime factors are 2, 3, 5 and 7 only: such sizes transform
/// fastest.
Index good_fft_size(Index n);

/// Returns the largest prime factor of n (1 for n = 1).
Index largest_prime_factor(Index n);

/// Returns the angular wavevector [rad/m] of frequency index k of n samples over `length` [m]: 2 pi
/// k / length for k <= n/2, 2 pi (k - n) / length above.
double wavevector(Index k, Index n, double length);

/// Fills values[ky], ky = 0, 1, ... up to ny/2, with the factor of frequency (kx, ky); the factor
/// of (kx, -ky) is the same. Called from several threads.
template <typename Real>
using Multiplier = std::function<void(Index kx, std::span<Real> values)>;

/// Transforms real maps by a two-dimensional FFT: maps of shape (ny, nx) to half spectra of shape
/// (ny, nx/2 + 1).
///
/// Rows and columns are transformed with the same one-dimensional plans, each in a bundle that the
/// thread count does not change, so that the result has the same bits for any thread count. The
/// forward transform is not normalised; the inverse divides by nx * ny. Real is float or double.
/// Cheap to construct; safe to use from several threads once constructed.
template <typename Real>
class RealFft2d {
 public:
  using Complex = std::complex<Real>;

  RealFft2d(Index ny, Index nx);
  ~RealFft2d();
  RealFft2d(RealFft2d&&) noexcept;
  RealFft2d& operator=(RealFft2d&&) noexcept;

  Index ny() const;
  Index nx() const;
  Index spectrum_columns() const { return nx() / 2 + 1; }

  void forward(const Real* map, Complex* spectrum) const;
  void inverse(Complex* spectrum, Real* map) const;  ///< overwrites the spectrum

 private:
  struct Plans;
  std::unique_ptr<Plans> plans_;
};

/// What lies beyond a map that is convolved.
enum class Padding { none, zero, mirror };  // none: the map repeats

/// Convolves maps by a real, ky-symmetric spectral multiplier, in one sweep over the columns: out =
/// F^-1 [ multiplier F [in] ]. Padded with zeros, the map is the top left (ny, nx) corner of a zero
/// map of shape (2 ny, 2 nx), of which the same corner is returned: a non-periodic convolution.
/// Padded with mirror images, it is the corner of 2 x 2 of them instead, of whose spectrum the
/// multiplier is asked for 0 <= kx < nx, 0 <= ky < ny. Scratch memory is (nx/2 + 1) * ny complex
/// values (twice that with zeros).
template <typename Real>
class Convolution {
 public:
  Convolution(Index ny, Index nx, Padding padding = Padding::none);
  ~Convolution();
  Convolution(Convolution&&) noexcept;
  Convolution& operator=(Convolution&&) noexcept;

  /// Convolves `in` into `out`; both have shape (ny, nx) and may be the same. Not safe for
  /// concurrent calls.
  void apply(const Real* in, const Multiplier<Real>& multiplier, Real* out);

 private:
  class State;
  class Padded;
  class Mirrored;
  std::unique_ptr<State> state_;
};

/// Returns the real spectrum of a map of shape (ny, nx) that is even in x and y: value(y, x) is
/// asked for 0 <= y <= ny/2, 0 <= x <= nx/2 only. Shape (nx/2 + 1, ny/2 + 1), that is transposed:
/// row kx holds the values a Multiplier of column kx needs. Takes no more memory than the result.
Field even_spectrum(Index ny, Index nx, const std::function<double(Index y, Index x)>& value);

/// Transforms every row in one dimension: spectrum of shape (ny, nx/2 + 1), not normalised.
void forward_rows(
    const Field& map,
    Eigen::Array<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>& spectrum);

/// Returns name and version of the library of transforms that tabor is built with (TABOR_FFT), such
/// as "FFTW 3.3.10" or "ducc0 0.42.0".
std::string transform_library();
/// Returns the key of that library in the bibliography.
std::string transform_reference();

/// Loads measured plans of FFTW, which make transforms faster. Every later plan uses them; plans
/// without stored wisdom are estimated, so that two runs with the same file give the same bits.
/// Throws InputError if there are none, and with ducc0, which measures no plans.
void load_wisdom(const std::filesystem::path& file);
/// Measures plans for maps of this shape (seconds to minutes) and stores everything known. Throws
/// OutputError if they cannot be written, and InputError with ducc0.
void measure_wisdom(Index ny, Index nx, const std::filesystem::path& file);

}  // namespace tabor::spectral
