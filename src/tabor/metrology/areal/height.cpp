// Height parameters: moments and extremes of the valid heights.
#include <cmath>

#include "tabor/metrology/areal/sets.hpp"
#include "tabor/numerics/field_statistics.hpp"

namespace tabor::metrology {
double rms_height(const topography::Topography& topography) {
  return numerics::rms_height(topography.height);
}

std::vector<Parameter> height_parameters(const topography::Topography& topography) {
  const numerics::FieldMoments m = numerics::field_moments(topography.height);
  const double sq = std::sqrt(m.second);
  const bool rough = sq > 0;
  const std::string about = "; z about the mean of the valid points";
  const std::string no_shape = rough ? "" : "a flat surface has none";
  return {
      {"N", static_cast<double>(m.n), "1", "valid points (pixels that are not holes)"},
      {"Sa", m.mean_abs, "m", "arithmetic mean height <|z|>" + about},
      {"Sq", sq, "m", "root mean square height sqrt(<z^2>), divided by N" + about},
      {"Ssk", rough ? m.third / (m.second * sq) : kNoValue, "1", "skewness <z^3>/Sq^3" + about,
       no_shape},
      {"Sku", rough ? m.fourth / (m.second * m.second) : kNoValue, "1",
       "kurtosis <z^4>/Sq^4 (3 for a Gaussian surface)" + about, no_shape},
      {"Sp", m.highest, "m", "highest peak max z" + about},
      {"Sv", 0.0 - m.lowest, "m", "deepest pit -min z" + about},
      {"Sz", m.highest - m.lowest, "m", "maximum height Sp + Sv"},
  };
}

}  // namespace tabor::metrology
