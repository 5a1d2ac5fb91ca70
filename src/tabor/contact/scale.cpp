#include "tabor/contact/scale.hpp"

#include <algorithm>
#include <cmath>

#include "tabor/core/loops.hpp"

namespace tabor::contact {

double length_scale(const elastic::ElasticOperator& elasticity, const LoadProblem& problem) {
  const double* height = problem.height.data();
  const auto n = static_cast<double>(problem.height.size());
  const double mean = sum(problem.height) / n;
  const double squares = sum_over(problem.height.size(),
                                  [=](Index i) { return (height[i] - mean) * (height[i] - mean); });
  const double rms_height = std::sqrt(squares / n);
  const double displacement =
      problem.mean_pressure * std::sqrt(elasticity.grid().area()) / elasticity.effective_modulus();
  // Below, what doubles cannot tell from a constant height under that displacement.
  const double flat =
      std::max(1e-12 * std::abs(mean), elasticity.drops_mean() ? 0.0 : 1e-10 * displacement);
  return rms_height > flat ? rms_height : displacement;
}

}  // namespace tabor::contact
