#include "tabor/material/lubricant.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "tabor/core/error.hpp"
#include "tabor/core/parallel.hpp"

namespace tabor::material {
namespace {

std::span<double> resized(Eigen::ArrayXd& array, std::size_t n) {
  array.resize(static_cast<Eigen::Index>(n));
  return {array.data(), n};
}

std::string in_GPa(double pressure) { return fmt::format("{:.3g} GPa", pressure * 1e-9); }

void check(const char* what, const PressureRange& range, double pressure, const char* remedy) {
  if (!range.contains(pressure)) {
    throw InputError(what, in_GPa(pressure),
                     fmt::format("between {} and {}, the range in which the law can be evaluated",
                                 in_GPa(range.lowest), in_GPa(range.highest)),
                     remedy);
  }
}

}  // namespace

void evaluate(const Lubricant& lubricant, std::span<const double> pressure, NodeLaws& laws) {
  constexpr Index kBlockOfNodes = 4096;
  const std::size_t n = pressure.size();
  const std::span<double> viscosity = resized(laws.viscosity, n);
  const std::span<double> viscosity_by_pressure = resized(laws.viscosity_by_pressure, n);
  const std::span<double> density = resized(laws.density, n);
  const std::span<double> density_by_pressure = resized(laws.density_by_pressure, n);
  parallel_for(static_cast<Index>(n), kBlockOfNodes, [&](Index begin, Index end) {
    const auto part = [&](auto all) {
      return all.subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin));
    };
    evaluate(lubricant.viscosity, part(pressure), part(viscosity), part(viscosity_by_pressure));
    evaluate(lubricant.density, part(pressure), part(density), part(density_by_pressure));
  });
}

PressureRange computable_range(const Lubricant& lubricant) {
  const PressureRange viscosity = computable_range(lubricant.viscosity);
  const PressureRange density = computable_range(lubricant.density);
  return {std::max(viscosity.lowest, density.lowest), std::min(viscosity.highest, density.highest)};
}

void check_pressure(const Lubricant& lubricant, double pressure) {
  const auto law = name(law_of(lubricant.viscosity));
  check(fmt::format("pressure for the viscosity law '{}'", law).c_str(),
        computable_range(lubricant.viscosity), pressure,
        "use the law 'roelands', a smaller pressure-viscosity coefficient or a lighter load");
  check("pressure for the density law", computable_range(lubricant.density), pressure, "");
}

Warnings warnings(const Lubricant& lubricant, double highest_pressure) {
  Warnings warnings;
  const auto add = [&](const char* code, std::string_view law, const PressureRange& range) {
    if (highest_pressure > range.highest) {
      warnings.push_back(
          {code,
           fmt::format("The pressure reaches {}, but the {} law is trusted only up to {}",
                       in_GPa(highest_pressure), law, in_GPa(range.highest)),
           highest_pressure / range.highest});
    }
  };
  add("viscosity-law", fmt::format("{} viscosity", name(law_of(lubricant.viscosity))),
      trusted_range(lubricant.viscosity));
  add("density-law", "density", trusted_range(lubricant.density));
  return warnings;
}

}  // namespace tabor::material
