#include "tabor/cli/fluid_request.hpp"

#include <fmt/format.h>

#include "tabor/core/error.hpp"

namespace tabor::cli {

namespace {

material::Lubricant lubricant_of(const FluidRequest& request) {
  material::Lubricant lubricant;
  const double viscosity = request.viscosity.value_or(0);
  lubricant.viscosity = request.pressure_viscosity
                            ? material::make_viscosity(material::ViscosityLaw::roelands, viscosity,
                                                       *request.pressure_viscosity)
                            : material::constant_viscosity(viscosity);
  if (request.eyring_stress) {
    lubricant.shear = material::ree_eyring_shear(*request.eyring_stress);
  }
  return lubricant;
}

io::Json optional_number(const std::optional<double>& value) {
  return value ? io::Json(*value) : io::Json(nullptr);
}

void refuse_idle_options(const FluidRequest& request) {
  const auto refuse = [](bool given, const char* flag) {
    if (given) {
      throw UsageError(std::string(flag) + " belongs to a film that flows; add --fluid reynolds");
    }
  };
  refuse(request.speed.has_value(), "--speed");
  refuse(request.viscosity.has_value(), "--viscosity");
  refuse(request.pressure_viscosity.has_value(), "--pressure-viscosity");
  refuse(request.eyring_stress.has_value(), "--eyring-stress");
}

}  // namespace

void declare_fluid(OptionSet& set, FluidRequest& request) {
  set.group("Fluid film");
  set.choice("--fluid", {"none", "reynolds"},
             "reynolds: the deposited oil flows and carries part of the load [none]",
             request.fluid);
  set.quantity("--speed", "U", "sliding speed along +x, e.g. 5mm/s", dimension::speed,
               request.speed);
  set.quantity("--viscosity", "ETA", "dynamic viscosity of the oil, e.g. 0.225Pa*s",
               dimension::viscosity, request.viscosity);
  set.quantity("--pressure-viscosity", "ALPHA",
               "its growth with pressure by Roelands' law, e.g. 2e-8/Pa [constant]",
               dimension::per_pressure, request.pressure_viscosity);
  set.quantity("--eyring-stress", "TAU", "Ree-Eyring stress of the oil, e.g. 5MPa [Newtonian]",
               dimension::pressure, request.eyring_stress);
}

void check(const FluidRequest& request, const ContactRequest& contact) {
  if (!request.asked()) {
    refuse_idle_options(request);
    return;
  }
  if (!request.speed || !request.viscosity) {
    throw UsageError(fmt::format(
        "--fluid reynolds needs {}",
        request.speed ? "--viscosity, e.g. --viscosity 0.225Pa*s" : "--speed, e.g. --speed 5mm/s"));
  }
  if (*request.speed < 0) {
    throw InputError("--speed", si(*request.speed, "m/s"), "zero or more",
                     "--mirror or --flip the scan to slide the other way");
  }
  lubricant_of(request);
  if (!contact.is_periodic()) {
    throw UsageError("--fluid reynolds is solved on a patch that repeats: use --boundary periodic");
  }
}

friction::FluidFilmState solve_fluid(elastic::ElasticOperator& elasticity, const Field& height,
                                     const ContactResult& dry, const Field& film,
                                     const ContactRequest& contact, const FluidRequest& request,
                                     Context& context) {
  friction::FluidFilmProblem problem;
  problem.contact.height = height;
  problem.contact.mean_pressure = dry.summary.mean_pressure;
  problem.contact.saturation_pressure =
      contact.saturation_pressure.value_or(contact::kNoSaturation);
  problem.contact.tolerance = contact.tolerance;
  problem.film = film;
  problem.sliding_speed = *request.speed;
  problem.lubricant = lubricant_of(request);
  friction::FluidFilmState state =
      friction::solve_fluid_film(elasticity, problem, dry.state, context.observer());
  const std::string at = si(dry.summary.mean_pressure, "Pa") + ": ";
  if (!state.converged) {
    context.warn(
        fmt::format("{}film NOT CONVERGED, load balance {:.1e}, gap {:.1e} instead of {:.0e}", at,
                    state.load_error, state.gap_error, problem.tolerance));
  }
  const double highest = state.film.pressure.maxCoeff();
  for (const std::string& doubt : material::doubts(problem.lubricant, highest)) {
    context.warn(at + doubt);
  }
  if (contact.saturation_pressure && highest > *contact.saturation_pressure) {
    context.warn(at + "the oil's pressure reaches " + si(highest, "Pa") +
                 ", more than the solids bear: the film is too thin for its pixels there");
  }
  return state;
}

io::Json fluid_json(const friction::FluidFilmState& state, const friction::Estimate& solids,
                    double mean_pressure) {
  const double solid_share = state.solid_pressure / mean_pressure;
  const double friction_solid = solids.friction_lubricated * solid_share;
  const double friction_viscous = state.viscous_stress / mean_pressure;
  const auto n = static_cast<double>(state.film.pressure.size());
  return {{"fluid_load_share", state.fluid_pressure / mean_pressure},
          {"fluid_max_pressure_Pa", state.film.pressure.maxCoeff()},
          {"fluid_contact_area_fraction", solids.area_fraction},
          {"fluid_mean_gap_m", state.mean_gap},
          {"fluid_full_fraction", static_cast<double>((state.film.fill >= 1).count()) / n},
          {"fluid_outside_film_m", state.film.oil.outside / n},
          {"friction_solid", friction_solid},
          {"friction_viscous", friction_viscous},
          {"friction_mixed", friction_solid + friction_viscous},
          {"fluid_load_error", state.load_error},
          {"fluid_gap_error", state.gap_error},
          {"fluid_evaluations", state.evaluations},
          {"fluid_iterations", state.film.iterations},
          {"fluid_converged", state.converged}};
}

std::vector<StateField> fields_of(const friction::FluidFilmState& state) {
  return {{"fluid_pressure", "Pa", "pressure of the oil", state.film.pressure},
          {"fluid_fill", "1", "share of the gap that oil fills while sliding", state.film.fill},
          {"fluid_gap", "m", "gap while sliding", state.contact.gap},
          {"fluid_solid_pressure", "Pa", "contact pressure while sliding", state.contact.pressure}};
}

io::Json settings_json(const FluidRequest& request) {
  if (!request.asked()) return io::Json::object();
  return {{"fluid", request.fluid},
          {"sliding_speed_m_per_s", optional_number(request.speed)},
          {"viscosity_Pa_s", optional_number(request.viscosity)},
          {"pressure_viscosity_per_Pa", optional_number(request.pressure_viscosity)},
          {"eyring_stress_Pa", optional_number(request.eyring_stress)}};
}

void describe(const FluidRequest& request, Facts& facts) {
  if (!request.asked()) return;
  std::string text =
      fmt::format("sliding at {}, {}", si(*request.speed, "m/s"), si(*request.viscosity, "Pa s"));
  if (request.pressure_viscosity) text += ", Roelands";
  if (request.eyring_stress) text += ", Eyring stress " + si(*request.eyring_stress, "Pa");
  facts.fact("fluid film", text);
}

std::vector<std::string> methods_of(const FluidRequest& request) {
  if (!request.asked()) return {};
  return {"elrod1981"};
}

}  // namespace tabor::cli
