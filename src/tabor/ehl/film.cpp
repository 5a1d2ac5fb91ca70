#include "tabor/ehl/film.hpp"

#include "tabor/core/types.hpp"

namespace tabor::ehl {

double smallest_film(const Eigen::ArrayXd& film) {
  Index i = 0;
  const double least = film.minCoeff(&i);
  if (i == 0 || i + 1 == film.size()) return least;
  const double curvature = film[i - 1] - 2 * least + film[i + 1];
  const double slope = film[i + 1] - film[i - 1];
  return curvature > 0 ? least - slope * slope / (8 * curvature) : least;
}

}  // namespace tabor::ehl
