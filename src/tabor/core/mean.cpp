#include "tabor/core/mean.hpp"

#include <cmath>
#include <limits>
#include <numeric>

namespace tabor {

Mean mean_of(const std::vector<double>& values) {
  Mean result;
  result.n = values.size();
  const double n = static_cast<double>(values.size());
  if (values.empty()) return result;
  result.mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  if (values.size() >= 2) {
    double squares = 0;
    for (const double value : values) squares += (value - result.mean) * (value - result.mean);
    const double rounding = 4 * std::numeric_limits<double>::epsilon() * std::abs(result.mean);
    const double deviation = std::sqrt(squares / (n - 1));
    result.standard_deviation = deviation > rounding ? deviation : 0;
    result.standard_error = result.standard_deviation / std::sqrt(n);
  }
  return result;
}

}  // namespace tabor
