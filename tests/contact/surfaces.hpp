#pragma once

#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <vector>

#include "tabor/contact/contact.hpp"
#include "tabor/core/random.hpp"
#include "tabor/elastic/half_space.hpp"
#include "tabor/spectral/fft.hpp"

namespace tabor::test {

inline Grid square(Index n, double side = 1.0) { return {n, n, side, side}; }

/// Periodic self-affine heights with rms slope 1 on a unit side: amplitudes ~ k^-(1+H), k in
/// [k_low, k_high], random phases. Independent of the library's own generator.
inline Field self_affine(Index n, double hurst, double k_low, double k_high, std::uint64_t seed) {
  const CounterRandom random(seed);
  std::vector<std::complex<double>> spectrum(static_cast<std::size_t>(n * (n / 2 + 1)));
  double square_slope = 0;
  for (Index ky = 0; ky < n; ++ky) {
    for (Index kx = 1; kx < n / 2; ++kx) {
      const auto y = static_cast<double>(ky <= n / 2 ? ky : ky - n);
      const double k = std::hypot(static_cast<double>(kx), y);
      if (k < k_low || k > k_high) continue;
      const double amplitude = std::pow(k, -1 - hurst);
      const auto pixel = static_cast<std::uint64_t>(ky * n + kx);
      spectrum[static_cast<std::size_t>(ky * (n / 2 + 1) + kx)] =
          std::polar(amplitude, 2 * std::numbers::pi * random.uniform(pixel));
      square_slope += 2 * std::pow(2 * std::numbers::pi * k * amplitude, 2);
    }
  }
  Field height(n, n);
  spectral::RealFft2d<double>(n, n).inverse(spectrum.data(), height.data());
  return height * (static_cast<double>(n) * static_cast<double>(n) / std::sqrt(square_slope));
}

/// Rms slope of heights on a unit side, by differences of neighbours.
inline double rms_slope(const Field& height) {
  const auto n = static_cast<double>(height.rows());
  const auto along_x = height.rightCols(height.cols() - 1) - height.leftCols(height.cols() - 1);
  const auto along_y = height.bottomRows(height.rows() - 1) - height.topRows(height.rows() - 1);
  return n * std::sqrt(along_x.square().mean() + along_y.square().mean());
}

/// z = amplitude cos(2 pi x) [cos(2 pi y)] on a unit side, sampled at pixel centres.
inline Field wave(Index n, double amplitude, bool two_dimensional) {
  Field height(n, n);
  for (Index y = 0; y < n; ++y) {
    for (Index x = 0; x < n; ++x) {
      const auto phase = [n](Index k) {
        return 2 * std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(n);
      };
      height(y, x) = amplitude * std::cos(phase(x)) * (two_dimensional ? std::cos(phase(y)) : 1.0);
    }
  }
  return height;
}

/// Solves with E* = 1 on a periodic unit square (or the same square loaded alone).
struct Solved {
  contact::State state;
  contact::Summary summary;
};

inline Solved solve_unit(const Field& height, double mean_pressure,
                         double saturation_pressure = contact::kNoSaturation,
                         double tolerance = 1e-6, contact::Solver solver = contact::Solver::fast,
                         bool periodic = true, double side = 1.0) {
  const Grid grid{height.cols(), height.rows(), side,
                  side * static_cast<double>(height.rows()) / static_cast<double>(height.cols())};
  const auto elasticity =
      periodic ? elastic::make_periodic(grid, 1.0) : elastic::make_free(grid, 1.0);
  contact::Problem problem;
  problem.height = height;
  problem.control = contact::MeanPressure{mean_pressure};
  problem.bounds.upper = saturation_pressure;
  problem.tolerance = tolerance;
  Solved solved;
  solved.state = contact::solve(*elasticity, problem, solver);
  solved.summary = contact::summarise(solved.state, problem, grid, periodic);
  return solved;
}

}  // namespace tabor::test
