#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tabor/metrology/spectra/height_differences.hpp"
#include "tabor/topography/topography.hpp"

// Computes power spectral densities of surfaces in three conventions and fits the Hurst exponent.
namespace tabor::metrology {

/// Normalisation of a power spectral density; q = 2 pi / wavelength throughout.
/// jacobs (Jacobs, Junge & Pastewka 2017): <z^2> = (1/pi) int_0^inf C1D dq = (2 pi)^-2 int C2D d^2q
/// persson: <z^2> = int_-inf^inf C1D dq = int C2D d^2q, i.e. C1D / (2 pi), C2D / (4 pi^2)
/// gwyddion: C1D as persson (W1); radial W(q) = 2 pi q C2D(persson), <z^2> = int_0^inf W dq [m^3]
enum class PsdConvention { jacobs, persson, gwyddion };
enum class PsdWindow { none, hann };

/// Returns the convention of a name, "jacobs" and so on; nullopt if there is none.
std::optional<PsdConvention> psd_convention_from(std::string_view name);
/// Returns the window of a name, "hann" and so on; nullopt if there is none.
std::optional<PsdWindow> psd_window_from(std::string_view name);
/// Returns the name of a convention.
std::string_view name_of(PsdConvention convention);
/// Returns the name of a window.
std::string_view name_of(PsdWindow window);

/// Settings of power_spectra().
struct PsdOptions {
  PsdConvention convention = PsdConvention::jacobs;
  std::optional<PsdWindow> window = {};  ///< default: none for heights that tile, else hann
  std::optional<double> fit_q_min = {};  ///< [rad/m], default: see find_fit_range
  std::optional<double> fit_q_max = {};  ///< [rad/m], default: see find_fit_range
};

/// Least-squares slope of log density against log q, over logarithmically spaced bins, each with
/// the weight of its independent modes, limited to that of a relative error of a tenth. The leakage
/// of a window between neighbouring wavevectors of a power law is corrected.
struct HurstFit {
  /// H of C1D ~ q^-(1+2H), C2D ~ q^-(2+2H); NaN if fewer than 3 bins, or if there is no spectrum
  double hurst = std::numeric_limits<double>::quiet_NaN();
  /// Standard error of hurst: its scatter between surfaces of one random kind, from the number of
  /// independent modes (fewer with a window) of each bin; larger where the bins scatter about the
  /// line by more than chance.
  double standard_error = std::numeric_limits<double>::quiet_NaN();
  double q_min = 0;  ///< [rad/m], range used
  double q_max = 0;
  int n_bins = 0;
};

/// Density over q > 0; the q = 0 bin (the mean) is left out.
struct Spectrum {
  std::vector<double> q;           ///< [rad/m], rising
  std::vector<double> density;     ///< in `unit`, the convention's
  std::string unit;                ///< "m^3" or "m^4"
  std::vector<double> modes = {};  ///< independent ones that each density is the mean of
  double mode_spread = 1;  ///< by which a window raises the variance of sums over many modes
  HurstFit hurst;
  double rms_height = 0;  ///< [m], from the density alone
  double rms_slope = 0;   ///< 1D: of profiles along that axis, spectral derivative
};

/// Power spectra of a surface. A profile has only one of x and y; the other and the radial one are
/// empty.
struct PowerSpectra {
  PsdConvention convention = PsdConvention::jacobs;
  PsdWindow window = PsdWindow::none;
  Spectrum x;              ///< C1D of rows, averaged over rows
  Spectrum y;              ///< C1D of columns, averaged over columns
  Spectrum radial;         ///< C2D averaged over rings of width 2 pi / max(lx, ly)
  double rms_height = 0;   ///< [m], from the full two-dimensional sum (after windowing)
  double rms_slope = 0;    ///< areal, spectral derivative, from the two-dimensional sum
  double window_gain = 1;  ///< rms_height^2 over the mean square of the heights about their mean
};

/// Computes the spectra of the heights about their mean. Level before (the window does not replace
/// it). Throws InputError when there are holes, naming `--fill harmonic`, for a single height, and
/// for a range of the fit that ends before it begins.
PowerSpectra power_spectra(const topography::Topography& topography,
                           const PsdOptions& options = {});

/// Returns the logarithm of each windowed density of a power law q^-exponent over the law itself.
using WindowBias = std::function<std::vector<double>(double exponent)>;

/// Fits H to a density that falls as q^-(offset + 2 H); offset 1 for C1D, 2 for C2D.
HurstFit fit_hurst(const Spectrum& spectrum, double offset, double q_min, double q_max,
                   const WindowBias& bias = {});
/// Fits H where the expected scatter is not known: bins of equal weight, the error from their
/// scatter about the line.
HurstFit fit_hurst(const std::vector<double>& q, const std::vector<double>& density, double offset,
                   double q_min, double q_max);

/// Hurst exponent of <(z(r + lag) - z(r))^2> ~ lag^(2 H), fitted like that of a spectrum from two
/// pixels to the lag at which a fifth of the plateau 2 Sq^2 is reached: nearer to the plateau the
/// curve bends, so that H is found too small on surfaces without a long range of scales.
struct DifferenceHurst {
  double hurst = 0;           ///< NaN if fewer than 3 bins
  double standard_error = 0;  ///< from the scatter about the line; neighbouring lags share pairs,
                              ///< so that it is a lower bound
  double lag_min = 0;         ///< [m]
  double lag_max = 0;         ///< [m]
  int n_bins = 0;
};
DifferenceHurst fit_hurst(const HeightDifference& differences, double mean_square);

/// Range in which a power law can be expected: from twice the wavevector at which q^offset density
/// peaks (the roll-off) to half the largest wavevector, or to where the density begins to fall
/// faster than any H <= 1 allows, by more than chance (a low-pass filter, the instrument's
/// resolution): up to a sharp cut-off, and before a gradual one to where it takes a tenth.
struct FitRange {
  double q_min = 0;
  double q_max = 0;
  double roll_off = 0;
};
/// Finds the fit range; `offset` is that of fit_hurst().
FitRange find_fit_range(const Spectrum& spectrum, double offset);

}  // namespace tabor::metrology
