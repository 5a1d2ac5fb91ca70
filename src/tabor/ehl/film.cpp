#include "tabor/ehl/film.hpp"

#include <fmt/format.h>

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

material::Lubricant with_share_of_coefficient(material::Lubricant lubricant, double share) {
  const material::Viscosity viscosity = lubricant.viscosity;
  lubricant.viscosity =
      material::make_viscosity(material::law_of(viscosity), material::ambient_viscosity(viscosity),
                               share * material::pressure_coefficient(viscosity));
  return lubricant;
}

Warning short_inlet(double lengths) {
  return {"short-inlet",
          fmt::format("The inlet is only {:.2g} lengths sqrt(2 R h) long, so the film may starve. "
                      "Use 4 or more",
                      lengths),
          1 / lengths};
}

}  // namespace tabor::ehl
