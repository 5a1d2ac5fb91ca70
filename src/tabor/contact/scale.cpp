#include "tabor/contact/scale.hpp"

#include <cmath>

#include "tabor/core/parallel.hpp"

namespace tabor::contact {

double length_scale(const elastic::ElasticOperator& elasticity, const Problem& problem) {
  const double* height = problem.height.data();
  const auto n = static_cast<double>(problem.height.size());
  const double mean = sum(problem.height) / n;
  const double squares = deterministic_sum(problem.height.size(), [&](Index begin, Index end) {
    double partial = 0;
    for (Index i = begin; i < end; ++i) {
      partial += (height[i] - mean) * (height[i] - mean);
    }
    return partial;
  });
  const double rms_height = std::sqrt(squares / n);
  if (rms_height > 1e-12 * std::abs(mean)) {  // above the rounding error of a constant height
    return rms_height;
  }
  return problem.mean_pressure * std::sqrt(elasticity.grid().area()) /
         elasticity.effective_modulus();
}

}  // namespace tabor::contact
