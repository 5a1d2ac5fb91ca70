#pragma once

#include <vector>

#include "tabor/metrology/spectra/psd.hpp"

// Averages spectral densities in logarithmic bins and fits a line through them.
namespace tabor::metrology {

inline constexpr double kBinsPerDecade = 12;

/// Densities of one logarithmic bin, or a single density.
struct Bin {
  double log_q = 0;
  double log_density = 0;
  double variance = 0;  ///< of log_density; 0 if it is not known
};

/// Returns log densities, each an unbiased estimate of the log of its expectation: the mean of m
/// independent exponential numbers is gamma distributed. Densities that are not positive are left
/// out.
std::vector<Bin> log_points(const Spectrum& spectrum);

/// Collects the points from q_min to q_max in bins, weighted by their variances.
std::vector<Bin> log_bins(const std::vector<Bin>& points, double q_min, double q_max);

/// Weighted least-squares line through bins; NaN with fewer than three.
struct Line {
  double slope = 0;
  double centre = 0;  ///< log q about which slope and level are independent
  double level = 0;   ///< log density there
  double slope_variance = 0;
  double level_variance = 0;

  double operator()(double log_q) const { return level + slope * (log_q - centre); }
  double variance_at(double log_q) const {
    return level_variance + slope_variance * (log_q - centre) * (log_q - centre);
  }
};
Line fit_line(const std::vector<Bin>& bins);

}  // namespace tabor::metrology
