#include "tabor/metrology/areal/texture.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "tabor/core/rows.hpp"
#include "tabor/metrology/spectra/half_spectrum.hpp"
#include "tabor/numerics/field_statistics.hpp"
#include "tabor/spectral/fft.hpp"

namespace tabor::metrology {
namespace {

using std::numbers::pi;
using Spectrum = Eigen::Array<std::complex<float>, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr Index kRays = 360;  ///< over half a turn
constexpr double kStep = pi / kRays;

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

/// The power of a mode of the half spectrum, where it points, and the angle to the next modes.
struct Direction {
  double power = 0;
  double angle = 0;   ///< [rad] in [0, pi)
  double spread = 0;  ///< [rad] to the next modes across, at most a quarter turn
  double apart = 0;   ///< [rad] to the furthest of the next modes along both axes, or spread uncut
  bool is_inside = false;  ///< the smaller Nyquist wavevector
};

/// Angle between two directions that have no sign. [rad]
double angle_between(double a, double b) {
  const double turn = std::fmod(std::abs(a - b), pi);
  return std::min(turn, pi - turn);
}

/// The modes of a spectrum.
class Directions {
 public:
  Directions(const Spectrum& spectrum, const Grid& grid)
      : spectrum_(spectrum), grid_(grid), last_(pi / std::max(grid.dx(), grid.dy())) {}

  /// Sums of add(mode, sums) over all modes, rows in parallel.
  template <typename Add>
  Eigen::ArrayXd sum(Index n, const Add& add) const {
    std::vector<Eigen::ArrayXd> rows(static_cast<std::size_t>(spectrum_.rows()));
    parallel_for(spectrum_.rows(), 1, [&](Index ky, Index) {
      Eigen::ArrayXd& sums = rows[static_cast<std::size_t>(ky)];
      sums = Eigen::ArrayXd::Zero(n);
      for (Index kx = ky == 0 ? 1 : 0; kx < spectrum_.cols(); ++kx) {
        const Direction mode = at(ky, kx);
        if (mode.power > 0) add(mode, sums);
      }
    });
    Eigen::ArrayXd total = Eigen::ArrayXd::Zero(n);
    for (const Eigen::ArrayXd& row : rows) total += row;
    return total;
  }

 private:
  Direction at(Index ky, Index kx) const {
    const double qx = spectral::wavevector(kx, grid_.nx, grid_.lx);
    const double qy = -spectral::wavevector(ky, grid_.ny, grid_.ly);  // rows count downwards
    const double q = std::hypot(qx, qy);
    const double across = std::hypot(qx / grid_.ly, qy / grid_.lx) * 2 * pi / q;
    double angle = std::atan2(qy, qx);
    if (angle < 0) angle += pi;
    return {.power = multiplicity(kx, grid_.nx) * std::norm(spectrum_(ky, kx)),
            .angle = angle >= pi ? 0 : angle,
            .spread = std::clamp(across / q, kStep, pi / 2),
            .apart = std::max(across / q, angle_to_next(qx, qy)),
            .is_inside = q <= last_ * (1 + 1e-12)};
  }

  double angle_to_next(double qx, double qy) const {
    const double dqx = 2 * pi / grid_.lx, dqy = 2 * pi / grid_.ly;
    const double angle = std::atan2(qy, qx);
    double largest = kStep;
    for (const auto& [x, y] :
         {std::pair{qx + dqx, qy}, {qx - dqx, qy}, {qx, qy + dqy}, {qx, qy - dqy}}) {
      if (std::abs(x) < dqx / 2 && std::abs(y) < dqy / 2) continue;  // the mean has no direction
      largest = std::max(largest, angle_between(std::atan2(y, x), angle));
    }
    return largest;
  }

  const Spectrum& spectrum_;
  Grid grid_;
  double last_;
};

/// Power per angle at every ray.
Eigen::ArrayXd angular_power(const Directions& modes) {
  return modes.sum(kRays, [](const Direction& mode, Eigen::ArrayXd& power) {
    if (!mode.is_inside) return;
    const auto first = static_cast<Index>(std::ceil((mode.angle - mode.spread) / kStep));
    const auto last = static_cast<Index>(std::floor((mode.angle + mode.spread) / kStep));
    for (Index ray = first; ray <= last; ++ray) {
      const double share =
          1 - std::abs(static_cast<double>(ray) * kStep - mode.angle) / mode.spread;
      power[(ray + kRays) % kRays] += mode.power / mode.spread * std::max(0.0, share);
    }
  });
}

/// [rad] How far the modes that make the direction lie apart, their mean.
double distance_at(const Directions& modes, double direction) {
  const Eigen::ArrayXd sums = modes.sum(2, [&](const Direction& mode, Eigen::ArrayXd& total) {
    const double off = angle_between(mode.angle, direction);
    if (!mode.is_inside || off >= mode.spread) return;
    const double weight = mode.power / mode.spread * (1 - off / mode.spread);
    total += Eigen::Array2d(weight, weight * mode.apart);
  });
  return sums[1] / sums[0];
}

/// [rad] Half of that distance; less where little power is beside the direction: of a wave that
/// lies d of the distance beside a mode, the others have a share of about pi^2 d^2 / 3 (that mode
/// keeps sin^2(pi d) / (pi d)^2).
double uncertainty_at(const Directions& modes, double direction) {
  const double apart = distance_at(modes, direction);
  const Eigen::ArrayXd sums = modes.sum(2, [&](const Direction& mode, Eigen::ArrayXd& total) {
    const double off = angle_between(mode.angle, direction);
    if (off > apart * (1 + 1e-9)) return;
    total += Eigen::Array2d(mode.power, off > kStep ? mode.power : 0);
  });
  const double beside = std::sqrt(3 * sums[1] / sums[0]) / pi;
  return std::min(apart * std::min(0.5, beside), pi / 2);
}

/// How much further apart modes lie across `direction` than on a square field of the longer side.
double narrowness(const Grid& grid, double direction) {
  return std::hypot(std::cos(direction) / grid.ly, std::sin(direction) / grid.lx) *
         std::max(grid.lx, grid.ly);
}

void find_direction(const Spectrum& spectrum, const Grid& grid, Texture& texture) {
  constexpr double largest_uncertainty = 10 * pi / 180, widest = 2;
  if (grid.ny == 1 || grid.nx == 1) {
    texture.direction = grid.ny == 1 ? 0 : pi / 2;
    return;
  }
  const Directions modes(spectrum, grid);
  Index strongest = 0;
  angular_power(modes).maxCoeff(&strongest);
  texture.direction = kStep * static_cast<double>(strongest);
  texture.uncertainty = uncertainty_at(modes, texture.direction);
  texture.is_narrow =
      texture.uncertainty > largest_uncertainty && narrowness(grid, texture.direction) > widest;
  if (texture.is_narrow) texture.direction = kNan;
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
  if (!(moments.second > 0)) return {.direction = kNan, .wavelength = kNan};
  Spectrum spectrum(grid.ny, grid.nx / 2 + 1);
  {
    const FieldF unit = unit_heights(topography.height, moments);
    spectral::RealFft2d<float>(grid.ny, grid.nx).forward(unit.data(), spectrum.data());
  }
  Texture texture{.wavelength = strongest_wavelength(spectrum, grid),
                  .n_holes = grid.size() - moments.n};
  find_direction(spectrum, grid, texture);
  return texture;
}

}  // namespace tabor::metrology
