#include "tabor/cli/fluid_request.hpp"

#include <fmt/format.h>

#include "tabor/core/error.hpp"

namespace tabor::cli {

namespace {

friction::FlowingOil oil_of(const FluidRequest& request) {
  return {request.viscosity.value_or(0), request.pressure_viscosity, request.eyring_stress};
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
  friction::lubricant_of(oil_of(request));
  if (!contact.is_periodic()) {
    throw UsageError("--fluid reynolds is solved on a patch that repeats: use --boundary periodic");
  }
}

FluidResult solve_fluid(elastic::ElasticOperator& elasticity, const Field& height,
                        const ContactResult& dry, const Field& film, const ContactRequest& contact,
                        const FluidRequest& request, Context& context) {
  friction::FluidFilmProblem problem;
  problem.contact.height = height;
  problem.contact.mean_pressure = dry.summary.mean_pressure;
  problem.contact.saturation_pressure =
      contact.saturation_pressure.value_or(contact::kNoSaturation);
  problem.contact.tolerance = contact.tolerance;
  problem.film = film;
  problem.sliding_speed = *request.speed;
  problem.lubricant = friction::lubricant_of(oil_of(request));
  FluidResult result;
  result.state = friction::solve_fluid_film(elasticity, problem, dry.state, context.observer());
  result.summary = friction::summarise(result.state, problem, elasticity.grid());
  result.doubts = friction::doubts(result.state, problem);
  return result;
}

io::Json fluid_json(const friction::FluidSummary& fluid, const friction::MixedEstimate& mixed) {
  return {{"fluid_load_share", fluid.load_share},
          {"fluid_max_pressure_Pa", fluid.max_pressure},
          {"fluid_contact_area_fraction", mixed.area_fraction},
          {"fluid_mean_gap_m", fluid.mean_gap},
          {"fluid_full_fraction", fluid.full_fraction},
          {"fluid_outside_film_m", fluid.outside_film},
          {"friction_solid", mixed.friction_solid},
          {"friction_viscous", mixed.friction_viscous},
          {"friction_mixed", mixed.friction_mixed},
          {"fluid_load_error", fluid.load_error},
          {"fluid_gap_error", fluid.gap_error},
          {"fluid_pressure_error", fluid.pressure_error},
          {"fluid_evaluations", fluid.evaluations},
          {"fluid_iterations", fluid.iterations},
          {"fluid_converged", fluid.converged}};
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
