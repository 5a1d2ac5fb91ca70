#include "tabor/cli/contact_request.hpp"

#include <fmt/format.h>

#include <utility>

#include "tabor/cli/exit_code.hpp"
#include "tabor/cli/interrupt.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/elastic/half_space.hpp"
#include "tabor/material/solid.hpp"

namespace tabor::cli {

namespace {

analysis::ContactSettings analysis_settings(const ContactRequest& request) {
  return {.periodic = request.is_periodic(),
          .effective_modulus = effective_modulus(request),
          .saturation_pressure = request.saturation_pressure.value_or(contact::kNoSaturation)};
}

}  // namespace

void declare_contact(OptionSet& set, ContactRequest& request) {
  set.group("Contact");
  set.quantities("--pressure", "P[,P2,...]", "mean pressure, load / nominal area, e.g. 2MPa,7MPa",
                 dimension::pressure, request.pressures)
      .required = true;
  set.quantity("--youngs-modulus", "E", "Young's modulus of the rough body, e.g. 70GPa",
               dimension::pressure, request.youngs_modulus)
      .required = true;
  set.number("--poisson-ratio", "NU", "Poisson's ratio of the rough body, e.g. 0.33",
             request.poissons_ratio)
      .required = true;
  set.quantity("--counter-youngs-modulus", "E2", "Young's modulus of the counter body [rigid]",
               dimension::pressure, request.counter_youngs_modulus);
  set.number("--counter-poisson-ratio", "NU2", "Poisson's ratio of the counter body",
             request.counter_poissons_ratio);
  set.quantity("--saturation-pressure", "PS", "cap on the contact pressure, e.g. 240MPa [elastic]",
               dimension::pressure, request.saturation_pressure);
  set.choice("--boundary", {"periodic", "free"},
             "periodic: the scan repeats; free: loaded on the scan only [periodic]",
             request.boundary);
  set.number("--tolerance", "T", "certificate to reach, 1e-12 to 1e-4 [1e-6]", request.tolerance);
  set.choice("--solver", {"fast", "polonsky-keer"}, "polonsky-keer is the textbook baseline [fast]",
             request.solver);
}

void check(const ContactRequest& request) {
  if (request.counter_youngs_modulus.has_value() != request.counter_poissons_ratio.has_value()) {
    throw UsageError(
        "--counter-youngs-modulus and --counter-poisson-ratio belong together; give both or none");
  }
  if (!(request.tolerance >= 1e-12 && request.tolerance <= 1e-4)) {
    throw UsageError(fmt::format("--tolerance: got {}; expected 1e-12 to 1e-4", request.tolerance));
  }
  effective_modulus(request);
  for (const double pressure : request.pressures) {
    if (pressure <= 0) {
      throw InputError("--pressure", si(pressure, "Pa"), "more than zero", "");
    }
    if (request.saturation_pressure && pressure >= *request.saturation_pressure) {
      throw InputError(
          "--pressure", si(pressure, "Pa"),
          "less than the saturation pressure " + si(*request.saturation_pressure, "Pa"),
          "no contact that saturates there can carry this load; lower --pressure or "
          "raise --saturation-pressure");
    }
  }
}

double effective_modulus(const ContactRequest& request) {
  const material::Solid solid{request.youngs_modulus, request.poissons_ratio};
  if (!request.counter_youngs_modulus) return material::effective_modulus(solid);
  return material::effective_modulus(
      solid, {*request.counter_youngs_modulus, request.counter_poissons_ratio.value_or(0)});
}

std::unique_ptr<elastic::ElasticOperator> make_operator(const ContactRequest& request,
                                                        const Grid& grid) {
  const double modulus = effective_modulus(request);
  return request.is_periodic() ? elastic::make_periodic(grid, modulus)
                               : elastic::make_free(grid, modulus);
}

friction::Contact for_friction(const ContactResult& result, const ContactRequest& request,
                               double lubricated_share) {
  return {.mean_pressure = result.summary.mean_pressure,
          .contact_area_fraction = result.summary.contact_area_fraction,
          .contact_area_fraction_pixels = result.summary.contact_area_fraction_pixels,
          .saturation_pressure = request.saturation_pressure.value_or(contact::kNoSaturation),
          .lubricated_share = lubricated_share};
}

ContactResult solve(elastic::ElasticOperator& elasticity, const Field& height, double pressure,
                    const ContactRequest& request, Context& context) {
  contact::Problem problem{.height = height, .mean_pressure = pressure};
  problem.saturation_pressure = request.saturation_pressure.value_or(contact::kNoSaturation);
  problem.tolerance = request.tolerance;
  const auto solver =
      request.solver == "fast" ? contact::Solver::fast : contact::Solver::polonsky_keer;
  const Stopwatch watch;
  const double fft_before = elasticity.fft_seconds();
  ContactResult result;
  result.state = contact::solve(elasticity, problem, solver, context.observer());
  // A solver that was stopped returns what it has; half a state is of no use to anybody.
  if (interrupted()) throw Interrupted();
  result.summary =
      contact::summarise(result.state, problem, elasticity.grid(), request.is_periodic());
  result.fft_seconds = elasticity.fft_seconds() - fft_before;
  result.seconds = watch.seconds();
  return result;
}

int solve_all(elastic::ElasticOperator& elasticity, const Scan& scan, const ContactRequest& request,
              Context& context, const std::function<void(const ContactResult&)>& receive) {
  int code = kDone;
  const analysis::ContactSettings settings = analysis_settings(request);
  const analysis::Warnings about_surface = analysis::of_surface(scan.surface);
  try {
    Field unloaded;  // of a load path: the surface as the states before left it
    for (const double pressure : request.pressures) {
      const Field& height = unloaded.size() > 0 ? unloaded : scan.surface.height;
      ContactResult result = solve(elasticity, height, pressure, request, context);
      result.warnings = about_surface;
      analysis::add(analysis::of_contact(scan.surface, settings, result.state, result.summary),
                    result.warnings);
      receive(result);
      if (request.load_path) unloaded = contact::unloaded_height(height, result.state);
      if (!result.state.convergence.converged) code = kNotConverged;
    }
  } catch (const Interrupted&) {
    context.warn("interrupted: only the states that were finished are shown");
    code = kInterrupted;
  }
  return code;
}

std::vector<std::string> methods_of(const ContactRequest& request) {
  std::vector<std::string> methods = {"polonsky1999", "yastrebov2017",
                                      request.is_periodic() ? "stanley1997" : "love1929"};
  if (request.solver == "fast") methods.insert(methods.begin(), "rey2017");
  if (request.saturation_pressure) methods.push_back("almqvist2007");
  return methods;
}

io::Json settings_json(const ContactRequest& request) {
  const auto optional = [](const std::optional<double>& value) {
    return value ? io::Json(*value) : io::Json(nullptr);
  };
  return {{"youngs_modulus_Pa", request.youngs_modulus},
          {"poissons_ratio", request.poissons_ratio},
          {"counter_youngs_modulus_Pa", optional(request.counter_youngs_modulus)},
          {"counter_poissons_ratio", optional(request.counter_poissons_ratio)},
          {"effective_modulus_Pa", effective_modulus(request)},
          {"saturation_pressure_Pa", optional(request.saturation_pressure)},
          {"boundary", request.boundary},
          {"solver", request.solver},
          {"tolerance", request.tolerance},
          {"load_path", request.load_path},
          {"threads", thread_count()}};
}

io::Json state_json(const ContactResult& result) {
  const contact::Summary& summary = result.summary;
  const Convergence& convergence = result.state.convergence;
  return {{"mean_pressure_Pa", summary.mean_pressure},
          {"contact_area_fraction", summary.contact_area_fraction},
          {"contact_area_fraction_pixels", summary.contact_area_fraction_pixels},
          {"area_correction_valid", summary.area_correction_valid},
          {"saturated_area_fraction", summary.saturated_area_fraction},
          {"mean_gap_m", summary.mean_gap},
          {"separation_m", summary.separation},
          {"max_pressure_Pa", summary.max_pressure},
          {"elastic_energy_J_per_m2", summary.elastic_energy},
          {"n_patches", summary.n_patches},
          {"perimeter_m", summary.perimeter},
          {"certificate", io::number(convergence.certificate)},
          {"contact_gap_error_m", summary.contact_gap_error},
          {"converged", convergence.converged},
          {"warning_codes", analysis::codes_of(result.warnings)},
          {"iterations", convergence.iterations},
          {"operator_applications", convergence.operator_applications},
          {"fft_seconds", result.fft_seconds},
          {"seconds", result.seconds},
          {"peak_memory_bytes", peak_memory_bytes()}};
}

void describe(const ContactRequest& request, Facts& facts) {
  if (request.load_path) {
    facts.fact("load path", "in the order given, plastic indentation is kept");
  }
  facts.fact("contact",
             fmt::format("E* {}, {}, {}, solver {}", si(effective_modulus(request), "Pa"),
                         request.saturation_pressure
                             ? "saturation " + si(*request.saturation_pressure, "Pa")
                             : std::string("elastic"),
                         request.boundary, request.solver));
}

}  // namespace tabor::cli
