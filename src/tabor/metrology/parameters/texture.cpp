#include "tabor/metrology/parameters/texture.hpp"

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "tabor/core/rows.hpp"
#include "tabor/numerics/field_statistics.hpp"
#include "tabor/spectral/fft.hpp"

namespace tabor::metrology {
namespace {

using std::numbers::pi;
using Spectrum = Eigen::Array<std::complex<float>, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr Index kRays = 360;  ///< over half a turn

/// Heights about their mean in units of their rms, holes at zero.
FieldF unit_heights(const Field& height, const numerics::FieldMoments& moments) {
  FieldF unit(height.rows(), height.cols());
  const double scale = 1 / std::sqrt(moments.second);
  for_each_row(height.rows(), [&](Index y) {
    for (Index x = 0; x < height.cols(); ++x) {
      const double z = (height(y, x) - moments.mean) * scale;
      unit(y, x) = std::isnan(z) ? 0.0F : static_cast<float>(z);
    }
  });
  return unit;
}

/// Power of the mode (ky, kx) of any sign, kx within the half spectrum or its mirror image.
double power_at(const Spectrum& spectrum, Index ky, Index kx) {
  if (kx < 0) {
    kx = -kx;
    ky = -ky;
  }
  if (kx >= spectrum.cols() || std::abs(ky) > spectrum.rows() / 2) return 0;
  if (kx == 0 && ky == 0) return 0;
  return std::norm(spectrum((ky + spectrum.rows()) % spectrum.rows(), kx));
}

double power_between(const Spectrum& spectrum, double ky, double kx) {
  const auto y = static_cast<Index>(std::floor(ky)), x = static_cast<Index>(std::floor(kx));
  const double v = ky - static_cast<double>(y), u = kx - static_cast<double>(x);
  return (1 - v) * ((1 - u) * power_at(spectrum, y, x) + u * power_at(spectrum, y, x + 1)) +
         v * ((1 - u) * power_at(spectrum, y + 1, x) + u * power_at(spectrum, y + 1, x + 1));
}

/// Integral of power times q along a ray in steps of half a mode, however much longer than wide the
/// field is.
double power_along(const Spectrum& spectrum, const Grid& grid, double angle) {
  const double qx = 2 * pi / grid.lx, qy = 2 * pi / grid.ly;
  const double step = 0.5 / std::hypot(std::cos(angle) / qx, std::sin(angle) / qy);
  const double end = pi / std::max(grid.dx(), grid.dy());
  double total = 0;
  // From two steps on: closer, the missing mode q = 0 is part of every value.
  for (Index i = 2; static_cast<double>(i) * step <= end; ++i) {
    const double q = static_cast<double>(i) * step;
    // Rows count downwards, angles turn upwards.
    total += q * power_between(spectrum, -q * std::sin(angle) / qy, q * std::cos(angle) / qx);
  }
  return total * step;
}

double strongest_direction(const Spectrum& spectrum, const Grid& grid) {
  Eigen::ArrayXd power(kRays);
  parallel_for(kRays, 1, [&](Index ray, Index) {
    power[ray] = power_along(spectrum, grid, pi * static_cast<double>(ray) / kRays);
  });
  Index strongest = 0;
  power.maxCoeff(&strongest);
  return pi * static_cast<double>(strongest) / kRays;
}

double strongest_wavelength(const Spectrum& spectrum, const Grid& grid) {
  struct Peak {
    double power = 0, q = 0;
  };
  std::vector<Peak> rows(static_cast<std::size_t>(spectrum.rows()));
  for_each_row(spectrum.rows(), [&](Index ky) {
    Peak& peak = rows[static_cast<std::size_t>(ky)];
    for (Index kx = ky == 0 ? 1 : 0; kx < spectrum.cols(); ++kx) {
      if (const double power = std::norm(spectrum(ky, kx)); power > peak.power) {
        peak = {power, std::hypot(spectral::wavevector(kx, grid.nx, grid.lx),
                                  spectral::wavevector(ky, grid.ny, grid.ly))};
      }
    }
  });
  Peak strongest;
  for (const Peak& peak : rows) {
    if (peak.power > strongest.power) strongest = peak;
  }
  return strongest.q > 0 ? 2 * pi / strongest.q : kNan;
}

}  // namespace

Texture texture_of(const topography::Topography& topography) {
  const Grid& grid = topography.grid;
  const numerics::FieldMoments moments = numerics::field_moments(topography.height);
  if (!(moments.second > 0)) return {kNan, kNan, 0};
  Spectrum spectrum(grid.ny, grid.nx / 2 + 1);
  {
    const FieldF unit = unit_heights(topography.height, moments);
    spectral::RealFft2d<float>(grid.ny, grid.nx).forward(unit.data(), spectrum.data());
  }
  const double direction = grid.ny == 1   ? 0
                           : grid.nx == 1 ? pi / 2
                                          : strongest_direction(spectrum, grid);
  return {direction, strongest_wavelength(spectrum, grid), grid.size() - moments.n};
}

}  // namespace tabor::metrology
