#include "tabor/friction/mixed_friction.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tabor/core/units.hpp"
#include "tabor/friction/wet_contact.hpp"

namespace tabor::friction {

material::Lubricant lubricant_of(const FlowingOil& oil) {
  material::Lubricant lubricant;
  lubricant.viscosity = oil.pressure_viscosity
                            ? material::make_viscosity(material::ViscosityLaw::roelands,
                                                       oil.viscosity, *oil.pressure_viscosity)
                            : material::constant_viscosity(oil.viscosity);
  if (oil.eyring_stress) lubricant.shear = material::ree_eyring_shear(*oil.eyring_stress);
  return lubricant;
}

FluidSummary summarise(const FluidFilmState& state, const FluidFilmProblem& problem,
                       const Grid& grid) {
  const auto n = static_cast<double>(state.film.pressure.size());
  const double load = contact::prescribed_pressure(problem.contact, grid);
  FluidSummary fluid;
  fluid.load_share = state.fluid_pressure / load;
  fluid.solid_share = state.solid_pressure / load;
  fluid.max_pressure = state.film.pressure.maxCoeff();
  if (state.solid_pressure > 0) {
    const contact::Summary touching =
        contact::summarise(state.contact, problem.contact, grid, true);
    fluid.contact_area_fraction = touching.contact_area_fraction;
    fluid.contact_area_fraction_pixels = touching.contact_area_fraction_pixels;
    fluid.lubricated_share = lubricated_share(contact::contact_mask(state.contact), problem.film);
  }
  fluid.mean_gap = state.mean_gap;
  fluid.full_fraction = static_cast<double>((state.film.fill >= 1).count()) / n;
  fluid.outside_film = state.film.oil.outside / n;
  fluid.viscous_stress = state.viscous_stress;
  fluid.load_error = state.load_error;
  fluid.gap_error = state.gap_error;
  fluid.pressure_error = state.pressure_error;
  fluid.film_iterations = state.film.convergence.iterations;
  fluid.convergence = state.convergence;
  return fluid;
}

MixedEstimate estimate(const FluidSummary& fluid, double mean_pressure, double saturation_pressure,
                       double shear_strength, Area area, double boundary_shear_strength) {
  MixedEstimate mixed;
  if (fluid.solid_share > 0) {
    // As if the solids alone were there, under what they carry; then over the whole load.
    const Estimate solids =
        estimate({mean_pressure * fluid.solid_share, fluid.contact_area_fraction,
                  fluid.contact_area_fraction_pixels, saturation_pressure, fluid.lubricated_share},
                 shear_strength, area, boundary_shear_strength);
    mixed.area_fraction = solids.area_fraction;
    mixed.friction_solid = solids.friction_lubricated * fluid.solid_share;
  }
  mixed.friction_viscous = fluid.viscous_stress / mean_pressure;
  mixed.friction_mixed = mixed.friction_solid + mixed.friction_viscous;
  return mixed;
}

Warnings warnings(const FluidFilmState& state, const FluidFilmProblem& problem) {
  Warnings found;
  if (state.convergence.failed()) {
    found.push_back(
        {"fluid-film",
         fmt::format("The film is NOT CONVERGED ({}){}: load balance {:.1e}, gap {:.1e}, wanted "
                     "{:.0e}",
                     name_of(state.convergence.status),
                     state.film.convergence.converged() ? "" : ", oil is still moving",
                     state.load_error, state.gap_error, problem.tolerance),
         std::max(state.load_error, state.gap_error)});
  }
  const double highest = state.film.pressure.maxCoeff();
  for (Warning& warning : material::warnings(problem.lubricant, highest)) {
    found.push_back(std::move(warning));
  }
  if (highest > problem.contact.bounds.upper) {
    found.push_back({"fluid-pressure",
                     "The oil pressure reaches " + format_si(highest, "Pa") +
                         ", more than the solids bear, because pixels do not resolve the thin "
                         "film there",
                     highest / problem.contact.bounds.upper});
  }
  return found;
}

}  // namespace tabor::friction
