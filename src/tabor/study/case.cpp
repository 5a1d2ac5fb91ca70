#include "tabor/study/case.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "tabor/core/units.hpp"
#include "tabor/io/digest.hpp"

namespace tabor::study {
namespace {

std::string line(std::string_view name, double value) {
  return fmt::format("{} = {:.17g}\n", name, value);
}

/// Length first, so that no text can look like the lines around it.
std::string line(std::string_view name, std::string_view value) {
  return fmt::format("{} = {}:{}\n", name, value.size(), value);
}

Unit unit(std::string_view kind, std::string_view extension, const std::string& body) {
  Unit made;
  made.text = fmt::format("tabor {} {}\n{}", kind, kAlgorithms, body);
  made.key = io::sha256(made.text).substr(0, 16);
  made.file = fmt::format("{}-{}.{}", kind, made.key, extension);
  return made;
}

/// The contact under one pressure, and what is computed from it.
void add_pressure(const Study& study, const Scan& scan, double pressure, ScanUnits& units) {
  const Unit contact = contact_unit(study, units.surface, pressure);
  const std::vector<Condition> conditions = study.conditions();
  std::vector<Unit> cases;
  std::vector<Unit> fluids;
  cases.reserve(conditions.size());
  fluids.reserve(conditions.size());
  for (const Condition& condition : conditions) {
    if (study.flows()) fluids.push_back(fluid_unit(study, contact, units.film, condition));
    cases.push_back(case_unit(study, scan, contact, units.film,
                              study.lubricant_densities[condition.density],
                              study.flows() ? &fluids.back() : nullptr));
  }
  units.contacts.push_back(contact);
  units.cases.push_back(std::move(cases));
  units.fluids.push_back(std::move(fluids));
}

}  // namespace

Unit surface_unit(const Study& study, const Scan& scan, const std::string& scan_sha256) {
  std::string body = line("scan_sha256", scan_sha256);
  body += line("channel", scan.read.channel.value_or(""));
  body += line("unit", scan.read.unit.value_or(""));
  body += line("pixel_x_m", scan.read.pixel_x.value_or(0));
  body += line("pixel_y_m", scan.read.pixel_y.value_or(0));
  for (const std::string& step : study.treatment) {
    body += line("step", step);
  }
  return unit("surface", "h5", body);
}

Unit contact_unit(const Study& study, const Unit& surface, double mean_pressure) {
  const bool fast = study.contact.solver == contact::Solver::fast;
  return unit("contact", "h5",
              line("surface", surface.key) + line("mean_pressure_Pa", mean_pressure) +
                  line("effective_modulus_Pa", study.effective_modulus()) +
                  line("saturation_pressure_Pa", study.saturation_pressure) +
                  line("boundary", study.contact.periodic ? "periodic" : "free") +
                  line("solver", fast ? "fast" : "polonsky-keer") +
                  line("tolerance", study.contact.tolerance));
}

Unit film_unit(const Study& study, const Unit& surface) {
  const LubricantSettings& lubricant = study.lubricant;
  std::string body = line("surface", surface.key) +
                     line("oil_density_kg_per_m3", lubricant.oil_density) +
                     line("model", lubrication::name(lubricant.model)) +
                     line("reading", lubrication::name(lubricant.reading)) +
                     line("edge", lubrication::name(lubricant.edge)) +
                     line("droplet_height_m", lubricant.droplet_height) +
                     line("seed", std::to_string(lubricant.seed));
  for (const double density : study.lubricant_densities) {
    body += line("lubricant_density_kg_per_m2", density);
  }
  return unit("film", "h5", body);
}

Unit fluid_unit(const Study& study, const Unit& contact, const Unit& film,
                const Condition& condition) {
  const friction::FlowingOil& oil = study.lubricant.flowing.value();
  std::string body =
      line("fluid_algorithms", kFluidAlgorithms) + line("contact", contact.key) +
      line("film", film.key) +
      line("lubricant_density_kg_per_m2", study.lubricant_densities.at(condition.density)) +
      line("sliding_speed_m_per_s", study.sliding_speeds.at(condition.speed)) +
      line("viscosity_Pa_s", oil.viscosity);
  if (oil.pressure_viscosity) body += line("pressure_viscosity_per_Pa", *oil.pressure_viscosity);
  if (oil.eyring_stress) body += line("eyring_stress_Pa", *oil.eyring_stress);
  return unit("fluid", "h5", body);
}

Unit case_unit(const Study& study, const Scan& scan, const Unit& contact, const Unit& film,
               double lubricant_density, const Unit* fluid) {
  return unit("case", "json",
              line("scan", scan.label) + line("group", scan.group) + line("contact", contact.key) +
                  line("film", film.key) + line("lubricant_density_kg_per_m2", lubricant_density) +
                  line("shear_strength_Pa", study.shear_strength) +
                  line("area", friction::name(study.area)) +
                  (fluid != nullptr ? line("fluid", fluid->key) : ""));
}

std::vector<ScanUnits> units_of(const Study& study, const Observer& observer) {
  std::vector<ScanUnits> all;
  for (const Scan& scan : study.scans) {
    ScanUnits units;
    const std::string stage = stage_name("hash", scan);
    units.sha256 =
        io::sha256_of_file(scan.file, [&] { report_progress(observer, stage, std::nan("")); });
    units.surface = surface_unit(study, scan, units.sha256);
    units.film = film_unit(study, units.surface);
    for (const double pressure : study.mean_pressures) add_pressure(study, scan, pressure, units);
    all.push_back(std::move(units));
  }
  return all;
}

std::string stage_name(const std::string& what, const Scan& scan, double mean_pressure) {
  return mean_pressure > 0
             ? fmt::format("{} {} {}", what, scan.label, format_si(mean_pressure, "Pa"))
             : fmt::format("{} {}", what, scan.label);
}

}  // namespace tabor::study
