#pragma once

#include <cmath>
#include <numbers>
#include <random>

#include "tabor/topography/topography.hpp"

namespace tabor::test {

/// NumPy's RandomState(seed).normal(): MT19937 and the polar method.
class NumpyNormal {
 public:
  explicit NumpyNormal(std::uint32_t seed) : bits_(seed) {}

  double operator()() {
    if (has_second_) {
      has_second_ = false;
      return second_;
    }
    double x = 0, y = 0, square = 0;
    do {
      x = 2 * uniform() - 1;
      y = 2 * uniform() - 1;
      square = x * x + y * y;
    } while (square >= 1 || square == 0);
    const double factor = std::sqrt(-2 * std::log(square) / square);
    second_ = factor * x;
    has_second_ = true;
    return factor * y;
  }

 private:
  double uniform() {
    const auto high = static_cast<double>(bits_() >> 5U);
    const auto low = static_cast<double>(bits_() >> 6U);
    return (high * 67108864.0 + low) / 9007199254740992.0;
  }

  std::mt19937 bits_;
  double second_ = 0;
  bool has_second_ = false;
};

/// The synthetic surface whose parameters the surfalize project publishes (also computed with
/// libgwyddion): a wave of 20 um with ripples of 1 um and noise, pixels of 0.1 um.
inline topography::Topography published_surface() {
  topography::Topography topography;
  topography.grid = {1000, 700, 100e-6, 70e-6};
  topography.height.resize(700, 1000);
  NumpyNormal normal(0);
  for (Index j = 0; j < 700; ++j) {
    for (Index i = 0; i < 1000; ++i) {
      using std::numbers::pi;
      const auto x = static_cast<double>(i), y = static_cast<double>(j);
      const double ripple = std::sin((std::sin(y / 10) + x) / 10 * 2 * pi);
      const double z = std::sin(x / 200 * 2 * pi) +
                       0.5 * (std::sin((x - 100) / 200 * 2 * pi) + 1) * 0.3 * ripple;
      topography.height(j, i) = 1e-6 * (z + normal() / 5);
    }
  }
  return topography;
}

/// The synthetic profile of the same project: a sine of 50 samples with noise, 0.1 um apart, um.
inline topography::Topography published_profile() {
  topography::Topography topography;
  topography.grid = {1000, 1, 100e-6, 0.1e-6};
  topography.height.resize(1, 1000);
  NumpyNormal normal(0);
  for (Index i = 0; i < 1000; ++i) {
    const double phase = 2 * std::numbers::pi * static_cast<double>(i) / 50;
    topography.height(0, i) = 1e-6 * (std::sin(phase) + 0.1 * normal());
  }
  return topography;
}

/// sin(2 pi x / L) [m] over one length L = 1 m with a crest on a sample. `n` samples, a multiple of
/// eight: then the difference that the open end leaves out is an average one.
inline topography::Topography analytic_sine(Index n) {
  topography::Topography topography;
  topography.grid = {n, 2, 1, 2 / static_cast<double>(n)};
  topography.height.resize(2, n);
  for (Index i = 0; i < n; ++i) {
    const double phase =
        2 * std::numbers::pi * static_cast<double>(i + n / 8) / static_cast<double>(n);
    topography.height.col(i).setConstant(std::sin(phase));
  }
  return topography;
}

}  // namespace tabor::test
