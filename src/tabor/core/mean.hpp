#pragma once

#include <cstddef>
#include <limits>
#include <vector>

// Computes the mean, standard deviation and standard error of repeated values.
namespace tabor {

/// Statistics of repeated values. NaN where they do not exist: mean for n = 0, the rest for n < 2.
struct Mean {
  std::size_t n = 0;
  double mean = std::numeric_limits<double>::quiet_NaN();
  double standard_deviation = std::numeric_limits<double>::quiet_NaN();  ///< with n - 1
  double standard_error =
      std::numeric_limits<double>::quiet_NaN();  ///< standard deviation / sqrt(n)
};

/// Computes the mean of any values; NaN where there are too few: fewer than two have no deviation.
Mean mean_of(const std::vector<double>& values);

}  // namespace tabor
