#include "tabor/study/case.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "tabor/analysis/density_curve.hpp"
#include "tabor/core/units.hpp"
#include "tabor/io/digest.hpp"

namespace tabor::study {
namespace {

Task task_of(std::string_view kind, std::string_view extension, const std::string& body) {
  return make_task(kind, extension, fmt::format("tabor {} {}\n{}", kind, kAlgorithms, body));
}

/// The contact under one pressure, and what is computed from it.
void add_pressure(const Study& study, const Scan& scan, double pressure, ScanTasks& tasks) {
  const Task contact = contact_task(study, tasks.surface, pressure);
  const std::vector<Condition> conditions = study.conditions();
  std::vector<Task> cases;
  std::vector<Task> fluids;
  cases.reserve(conditions.size());
  fluids.reserve(conditions.size());
  for (const Condition& condition : conditions) {
    if (study.flows()) fluids.push_back(fluid_task(study, contact, tasks.film, condition));
    cases.push_back(case_task(study, scan, contact, tasks.film, study.lubricant_density(condition),
                              study.flows() ? &fluids.back() : nullptr));
  }
  tasks.contacts.push_back(contact);
  if (analysis::has_density_curve(study.settings)) {
    tasks.wet_shares.push_back(wet_shares_task(study, contact));
  }
  tasks.cases.push_back(std::move(cases));
  tasks.fluids.push_back(std::move(fluids));
}

/// Nothing without a boundary film: such cases are those of stores from before there was one.
std::string boundary_line(const analysis::FrictionSettings& friction) {
  const double strength = friction.boundary_strength();
  return strength > 0 ? text_line("boundary_shear_strength_Pa", strength) : "";
}

}  // namespace

Task surface_task(const Study& study, const Scan& scan, const std::string& scan_sha256) {
  std::string body = text_line("scan_sha256", scan_sha256);
  body += text_line("channel", scan.read.channel.value_or(""));
  body += text_line("unit", scan.read.unit.value_or(""));
  body += text_line("pixel_x_m", scan.read.pixel_x.value_or(0));
  body += text_line("pixel_y_m", scan.read.pixel_y.value_or(0));
  for (const std::string& step : study.treatment) body += text_line("step", step);
  return task_of("surface", "h5", body);
}

Task contact_task(const Study& study, const Task& surface, double mean_pressure) {
  const analysis::ContactSettings& settings = study.settings.contact;
  return task_of("contact", "h5",
                 text_line("surface", surface.key) + text_line("mean_pressure_Pa", mean_pressure) +
                     text_line("effective_modulus_Pa", settings.effective_modulus()) +
                     text_line("saturation_pressure_Pa", settings.pressure_cap()) +
                     text_line("boundary", analysis::kBoundaries.of(settings.boundary)) +
                     text_line("solver", analysis::kSolvers.of(settings.solver)) +
                     text_line("tolerance", settings.tolerance));
}

Task film_task(const Study& study, const Task& surface) {
  const analysis::FilmSettings& lubricant = study.settings.film;
  std::string body = text_line("surface", surface.key) +
                     text_line("oil_density_kg_per_m3", lubricant.oil_density) +
                     text_line("model", deposition::name(lubricant.model)) +
                     text_line("reading", deposition::name(lubricant.reading)) +
                     text_line("edge", deposition::name(lubricant.edge)) +
                     text_line("droplet_height_m", lubricant.droplet_height) +
                     text_line("seed", std::to_string(lubricant.seed));
  for (const double density : lubricant.lubricant_densities) {
    body += text_line("lubricant_density_kg_per_m2", density);
  }
  return task_of("film", "h5", body);
}

Task wet_shares_task(const Study& study, const Task& contact) {
  const analysis::FilmSettings& lubricant = study.settings.film;
  return task_of(kWetSharesKind, "json",
                 text_line("contact", contact.key) +
                     text_line("oil_density_kg_per_m3", lubricant.oil_density) +
                     text_line("reading", deposition::name(lubricant.reading)) +
                     text_line("edge", deposition::name(lubricant.edge)));
}

Task fluid_task(const Study& study, const Task& contact, const Task& film,
                const Condition& condition) {
  const friction::FlowingOil oil = study.settings.fluid.oil();
  std::string body = text_line("fluid_algorithms", kFluidAlgorithms) +
                     text_line("contact", contact.key) + text_line("film", film.key) +
                     text_line("lubricant_density_kg_per_m2", study.lubricant_density(condition)) +
                     text_line("sliding_speed_m_per_s", study.sliding_speeds.at(condition.speed)) +
                     text_line("viscosity_Pa_s", oil.viscosity);
  if (oil.pressure_viscosity) {
    body += text_line("pressure_viscosity_per_Pa", *oil.pressure_viscosity);
  }
  if (oil.eyring_stress) body += text_line("eyring_stress_Pa", *oil.eyring_stress);
  return task_of("fluid", "h5", body);
}

Task case_task(const Study& study, const Scan& scan, const Task& contact, const Task& film,
               double lubricant_density, const Task* fluid) {
  return task_of(
      "case", "json",
      text_line("scan", scan.label) + text_line("group", scan.group) +
          text_line("contact", contact.key) + text_line("film", film.key) +
          text_line("lubricant_density_kg_per_m2", lubricant_density) +
          text_line("shear_strength_Pa", study.settings.friction.shear_strength) +
          boundary_line(study.settings.friction) +
          text_line("area",
                    friction::name(study.settings.friction.area_of(study.settings.contact))) +
          (fluid != nullptr ? text_line("fluid", fluid->key) : ""));
}

std::vector<ScanTasks> tasks_of(const Study& study, const Observer& observer) {
  std::vector<ScanTasks> all;
  for (const Scan& scan : study.scans) {
    ScanTasks tasks;
    const Study alone = study.of(scan);
    const std::string stage = stage_name("hash", scan);
    tasks.sha256 =
        io::sha256_of_file(scan.file, [&] { report_progress(observer, stage, std::nan("")); });
    tasks.surface = surface_task(alone, scan, tasks.sha256);
    tasks.film = film_task(alone, tasks.surface);
    for (const double pressure : alone.settings.mean_pressures) {
      add_pressure(alone, scan, pressure, tasks);
    }
    all.push_back(std::move(tasks));
  }
  return all;
}

std::string stage_name(const std::string& what, const Scan& scan, double mean_pressure) {
  return mean_pressure > 0
             ? fmt::format("{} {} {}", what, scan.label, format_si(mean_pressure, "Pa"))
             : fmt::format("{} {}", what, scan.label);
}

}  // namespace tabor::study
