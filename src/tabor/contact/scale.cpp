#include "tabor/contact/scale.hpp"

#include <algorithm>
#include <cmath>

#include "tabor/core/parallel.hpp"

namespace tabor::contact {

Extent extent_of(const Field& map) {
  const auto block = [&](Index begin, Index end) {
    return Eigen::Map<const Eigen::ArrayXd>(map.data() + begin, end - begin);
  };
  const double depth = parallel_max(
      map.size(), [&](Index begin, Index end) { return -block(begin, end).minCoeff(); });
  const double highest = parallel_max(
      map.size(), [&](Index begin, Index end) { return block(begin, end).maxCoeff(); });
  return {-depth, highest};
}

double length_scale(const elastic::ElasticOperator& elasticity, const Problem& problem) {
  const double* height = problem.height.data();
  const auto n = static_cast<double>(problem.height.size());
  const double mean = sum(problem.height) / n;
  const double squares = deterministic_sum(problem.height.size(), [&](Index begin, Index end) {
    double partial = 0;
    for (Index i = begin; i < end; ++i) partial += (height[i] - mean) * (height[i] - mean);
    return partial;
  });
  const double rms_height = std::sqrt(squares / n);
  const double displacement =
      problem.mean_pressure * std::sqrt(elasticity.grid().area()) / elasticity.effective_modulus();
  // Below, what doubles cannot tell from a constant height under that displacement.
  const double flat =
      std::max(1e-12 * std::abs(mean), elasticity.drops_mean() ? 0.0 : 1e-10 * displacement);
  return rms_height > flat ? rms_height : displacement;
}

}  // namespace tabor::contact
