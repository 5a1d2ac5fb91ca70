#include "tabor/material/lubricant_density.hpp"

#include <cassert>

namespace tabor::material {

DensityLaw parse_density_law(std::string_view text) {
  return kDensityLaws.parse(text, "density law");
}
std::string_view name(DensityLaw law) { return kDensityLaws.of(law); }

RelativeDensity relative_density(DensityLaw law) {
  switch (law) {
    case DensityLaw::constant:
      return {};
    case DensityLaw::dowson_higginson:
      return {.pressure_scale = 1 / 1.7e-9, .limit = 2.3 / 1.7};
    case DensityLaw::rounded_dowson_higginson:
      return {.pressure_scale = 5.9e8, .limit = 1.34};
  }
  return {};
}

void evaluate(const RelativeDensity& density, std::span<const double> pressure,
              std::span<double> value, std::span<double> by_pressure) {
  assert(value.size() == pressure.size() && by_pressure.size() == pressure.size());
  detail::evaluate_each(density, pressure, value, by_pressure);
}

PressureRange computable_range(const RelativeDensity& density) {
  return density.limit == 1 ? PressureRange{}
                            : PressureRange{.lowest = -density.pressure_scale / density.limit};
}

PressureRange trusted_range(const RelativeDensity& density) {
  PressureRange range = computable_range(density);
  if (density.limit != 1) range.highest = 0.4e9;
  return range;
}

}  // namespace tabor::material
