#include "tabor/synthesis/random_field.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "tabor/core/random.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/spectral/fft.hpp"

namespace tabor::synthesis {
namespace {

using std::numbers::pi;
using Complex = std::complex<double>;
using HalfSpectrum = Eigen::Array<Complex, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Index signed_frequency(Index k, Index n) { return 2 * k > n ? k - n : k; }

/// A number of unit mean square that belongs to the wavevector (kx, ky).
class ModeSource {
 public:
  explicit ModeSource(const RandomFieldRecipe& recipe)
      : random_(recipe.seed, recipe.stream), random_amplitudes_(recipe.random_amplitudes) {}

  Complex operator()(Index kx, Index ky) const {
    if (kx == 0 && ky < 0) {
      return std::conj((*this)(0, -ky));  // a real field's spectrum is Hermitian
    }
    const auto key = (static_cast<std::uint64_t>(kx) << 32) | static_cast<std::uint32_t>(ky);
    if (random_amplitudes_) {
      return Complex(random_.normal(2 * key), random_.normal(2 * key + 1)) / std::numbers::sqrt2;
    }
    return std::polar(1.0, 2 * pi * random_.uniform(key));
  }

 private:
  CounterRandom random_;
  bool random_amplitudes_;
};

bool is_free(Index kx, Index ky, const Grid& grid) {
  return (kx != 0 || ky != 0) && 2 * kx != grid.nx && 2 * ky != grid.ny;
}

/// Mean log wavevector and log power of the modes in logarithmic rings, eight per octave.
class RingSpectrum {
 public:
  RingSpectrum(const HalfSpectrum& modes, const Grid& grid, double stretch)
      : lowest_(2 * pi / std::max(grid.lx, grid.ly) / std::sqrt(std::max(stretch, 1 / stretch))) {
    std::vector<double> count, log_q, power;
    for (Index row = 0; row < modes.rows(); ++row) {
      const double qy = spectral::wavevector(row, grid.ny, grid.ly);
      for (Index kx = 0; kx < modes.cols(); ++kx) {
        const double q =
            elliptic_wavevector(spectral::wavevector(kx, grid.nx, grid.lx), qy, stretch);
        if (q > 0) add(count, log_q, power, q, std::norm(modes(row, kx)));
      }
    }
    for (std::size_t i = 0; i < count.size(); ++i) {
      if (count[i] > 0 && power[i] > 0) {
        log_q_.push_back(log_q[i] / count[i]);
        log_power_.push_back(std::log(power[i] / count[i]));
      }
    }
  }

  bool empty() const { return log_q_.empty(); }

  /// Log power at log q, interpolated between rings, constant beyond the ends.
  double at(double log_q) const {
    const auto above = std::upper_bound(log_q_.begin(), log_q_.end(), log_q);
    if (above == log_q_.begin()) return log_power_.front();
    if (above == log_q_.end()) return log_power_.back();
    const auto i = static_cast<std::size_t>(above - log_q_.begin());
    const double t = (log_q - log_q_[i - 1]) / (log_q_[i] - log_q_[i - 1]);
    return log_power_[i - 1] + t * (log_power_[i] - log_power_[i - 1]);
  }

 private:
  void add(std::vector<double>& count, std::vector<double>& log_q, std::vector<double>& power,
           double q, double value) const {
    const auto ring = static_cast<std::size_t>(8 * std::max(0.0, std::log2(q / lowest_)));
    if (ring >= count.size()) {
      count.resize(ring + 1, 0);
      log_q.resize(ring + 1, 0);
      power.resize(ring + 1, 0);
    }
    count[ring] += 1;
    log_q[ring] += std::log(q);
    power[ring] += value;
  }

  double lowest_;
  std::vector<double> log_q_, log_power_;
};

}  // namespace

double elliptic_wavevector(double qx, double qy, double stretch) {
  const double root = std::sqrt(stretch);
  return std::hypot(qx * root, qy / root);
}

RandomField random_field(const RandomFieldRecipe& recipe) {
  const Grid& grid = recipe.grid;
  const ModeSource source(recipe);
  HalfSpectrum modes(grid.ny, grid.nx / 2 + 1);
  const auto sums = sum_over_rows<2>(grid.ny, [&](Index row) {
    Eigen::Array2d total = Eigen::Array2d::Zero();
    const Index ky = signed_frequency(row, grid.ny);
    const double qy = 2 * pi * static_cast<double>(ky) / grid.ly;
    for (Index kx = 0; kx < modes.cols(); ++kx) {
      const double qx = 2 * pi * static_cast<double>(kx) / grid.lx;
      const double power =
          is_free(kx, ky, grid) ? recipe.power(elliptic_wavevector(qx, qy, recipe.stretch)) : 0;
      const Complex mode = power > 0 ? std::sqrt(power) * source(kx, ky) : 0;
      modes(row, kx) = mode * static_cast<double>(grid.size());  // the inverse divides by it
      const double share = (kx == 0 ? 1 : 2) * std::norm(mode);
      total += Eigen::Array2d(share, share * (qx * qx + qy * qy));
    }
    return total;
  });
  RandomField field{Field(grid.ny, grid.nx), sums[0], sums[1]};
  spectral::RealFft2d<double>(grid.ny, grid.nx).inverse(modes.data(), field.height.data());
  return field;
}

void impose_power_law(Field& height, const Grid& grid, double hurst, double q_roll_off,
                      double stretch) {
  const spectral::RealFft2d<double> fft(grid.ny, grid.nx);
  HalfSpectrum modes(grid.ny, grid.nx / 2 + 1);
  fft.forward(height.data(), modes.data());
  const RingSpectrum rings(modes, grid, stretch);
  if (rings.empty()) return;
  const double log_roll_off = std::log(q_roll_off);
  for_each_row(grid.ny, [&](Index row) {
    const double qy = spectral::wavevector(row, grid.ny, grid.ly);
    for (Index kx = 0; kx < modes.cols(); ++kx) {
      const double q = elliptic_wavevector(spectral::wavevector(kx, grid.nx, grid.lx), qy, stretch);
      if (q > q_roll_off) {
        const double log_q = std::log(q);
        const double target = rings.at(log_roll_off) - 2 * (1 + hurst) * (log_q - log_roll_off);
        modes(row, kx) *= std::exp((target - rings.at(log_q)) / 2);
      }
    }
  });
  fft.inverse(modes.data(), height.data());
}

}  // namespace tabor::synthesis
