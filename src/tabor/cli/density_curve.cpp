#include "tabor/cli/density_curve.hpp"

#include "tabor/core/units.hpp"
#include "tabor/io/columns.hpp"

namespace tabor::cli {

io::Json json_of(const analysis::DensityCurve& curve) {
  const auto in_grams = [](double density) { return io::number(in_g_per_m2(density)); };
  io::Json densities = io::Json::array();
  for (const double density : curve.lubricant_densities) densities.push_back(in_grams(density));
  const auto& plateau = curve.plateau;
  return {{"mean_pressure_Pa", curve.mean_pressure},
          {"lubricant_density_g_per_m2", densities},
          {"lubricated_share", curve.lubricated_shares},
          {"friction_lubricated", curve.friction_lubricated},
          {"plateau_from_g_per_m2", plateau ? in_grams(plateau->first) : io::Json()},
          {"plateau_to_g_per_m2", plateau ? in_grams(plateau->last) : io::Json()}};
}

void describe(const analysis::DensityCurve& curve, const std::vector<double>& asked,
              const std::string& group, Facts& facts) {
  const std::string name = group.empty() ? "density" : group;
  facts.fact(name + " at " + si(curve.mean_pressure, "Pa"), sentence_of(curve, asked));
}

}  // namespace tabor::cli
