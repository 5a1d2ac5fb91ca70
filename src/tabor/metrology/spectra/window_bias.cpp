#include "tabor/metrology/spectra/window_bias.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace tabor::metrology {
namespace {

using std::numbers::pi;

constexpr Index kReach = 6;   ///< modes on either side from which the radial window takes power
constexpr Index kRings = 24;  ///< where there is something to correct

double power_at(double q, double roll_off, double exponent) {
  return q > 0 ? std::pow(std::max(q, roll_off), -exponent) : 0;
}

/// Share of the power of a mode that the radial Hann window moves by (ky, kx) modes: the squared
/// Fourier transform of the window of unit mean square.
Field radial_hann_shares() {
  constexpr Index n = 64;
  Field shares(2 * kReach + 1, 2 * kReach + 1);
  Field window(n, n);
  const auto place = [](Index i) { return (static_cast<double>(i) + 0.5) / n - 0.5; };
  for (Index y = 0; y < n; ++y) {
    for (Index x = 0; x < n; ++x) {
      const double r = std::hypot(place(x), place(y));
      window(y, x) = r < 0.5 ? 1 + std::cos(2 * pi * r) : 0;
    }
  }
  window /= std::sqrt(window.square().mean());
  for (Index ky = 0; ky <= kReach; ++ky) {
    for (Index kx = 0; kx <= kReach; ++kx) {
      double sum = 0;
      for (Index y = 0; y < n; ++y) {
        for (Index x = 0; x < n; ++x) {
          sum += window(y, x) * std::cos(2 * pi * static_cast<double>(kx) * place(x)) *
                 std::cos(2 * pi * static_cast<double>(ky) * place(y));
        }
      }
      const double share = std::pow(sum / (n * n), 2);
      for (const Index v : {kReach - ky, kReach + ky}) {
        for (const Index u : {kReach - kx, kReach + kx}) shares(v, u) = share;
      }
    }
  }
  return shares;
}

const Field& shares_of(PsdWindow window) {
  static const Field hann = radial_hann_shares();
  static const Field none = [] {
    Field alone = Field::Zero(2 * kReach + 1, 2 * kReach + 1);
    alone(kReach, kReach) = 1;
    return alone;
  }();
  return window == PsdWindow::hann ? hann : none;
}

/// Expected mean power over the modes of each ring up to kRings.
class ExpectedRings {
 public:
  ExpectedRings(const Grid& grid, PsdWindow window, double roll_off, double exponent)
      : qx_(2 * pi / grid.lx), qy_(2 * pi / grid.ly), shares_(shares_of(window)) {
    const double dq = std::min(qx_, qy_), reach = (kRings + 0.5) * dq;
    nx_ = std::min(static_cast<Index>(reach / qx_), grid.nx / 2);
    ny_ = std::min(static_cast<Index>(reach / qy_), grid.ny / 2);
    power_.resize(2 * (ny_ + kReach) + 1, 2 * (nx_ + kReach) + 1);
    for (Index y = 0; y < power_.rows(); ++y) {
      for (Index x = 0; x < power_.cols(); ++x) {
        power_(y, x) = power_at(wavevector(y - ny_ - kReach, x - nx_ - kReach), roll_off, exponent);
      }
    }
    for (Index ky = -ny_; ky <= ny_; ++ky) {
      for (Index kx = -nx_; kx <= nx_; ++kx) add(ky, kx, dq);
    }
  }

  double operator()(std::size_t ring) const { return sums_[ring] / modes_[ring]; }

 private:
  double wavevector(Index ky, Index kx) const {
    return std::hypot(static_cast<double>(kx) * qx_, static_cast<double>(ky) * qy_);
  }

  void add(Index ky, Index kx, double dq) {
    const auto ring = static_cast<std::size_t>(std::llround(wavevector(ky, kx) / dq));
    if (ring == 0 || ring > kRings) return;
    const Index n = 2 * kReach + 1;
    sums_[ring] += (shares_ * power_.block(ky + ny_, kx + nx_, n, n)).sum();
    modes_[ring] += 1;
  }

  double qx_, qy_;
  const Field& shares_;
  Index nx_ = 0, ny_ = 0;
  Field power_;
  std::array<double, kRings + 1> sums_{}, modes_{};
};

}  // namespace

std::vector<double> line_bias(const std::vector<double>& q, double length, double roll_off,
                              double exponent) {
  const double dq = 2 * pi / length;
  std::vector<double> bias;
  for (const double at : q) {
    const double here = power_at(at, roll_off, exponent);
    const double below = at > 1.5 * dq ? power_at(at - dq, roll_off, exponent) : 0;
    const double expected = (here + (below + power_at(at + dq, roll_off, exponent)) / 4) / 1.5;
    bias.push_back(std::log(expected) + exponent * std::log(at));
  }
  return bias;
}

std::vector<double> ring_bias(const std::vector<double>& q, const Grid& grid, PsdWindow window,
                              double roll_off, double exponent) {
  const ExpectedRings expected(grid, window, roll_off, exponent);
  const double dq = 2 * pi / std::max(grid.lx, grid.ly);
  std::vector<double> bias;
  for (const double at : q) {
    const auto ring = static_cast<std::size_t>(std::llround(at / dq));
    bias.push_back(ring <= kRings ? std::log(expected(ring)) + exponent * std::log(at) : 0);
  }
  return bias;
}

}  // namespace tabor::metrology
