#include "tabor/study/study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/study/study_keys.hpp"

namespace tabor::study {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kKeys{"title",
                                     "shear_strength",
                                     "boundary_shear_strength",
                                     "boundary_shear_share",
                                     "area",
                                     "material.name",
                                     "material.youngs_modulus",
                                     "material.poissons_ratio",
                                     "material.saturation_pressure",
                                     "material.counter_youngs_modulus",
                                     "material.counter_poissons_ratio",
                                     "treatment.steps",
                                     "treatment.channel",
                                     "treatment.pixel",
                                     "treatment.unit",
                                     "contact.boundary",
                                     "contact.solver",
                                     "contact.tolerance",
                                     "sweep.mean_pressure",
                                     "sweep.lubricant_density",
                                     "sweep.sliding_speed",
                                     "lubricant.oil_density",
                                     "lubricant.model",
                                     "lubricant.reading",
                                     "lubricant.edge",
                                     "lubricant.droplet",
                                     "lubricant.seed",
                                     "lubricant.fluid",
                                     "lubricant.viscosity",
                                     "lubricant.pressure_viscosity",
                                     "lubricant.eyring_stress",
                                     "scan[].file",
                                     "scan[].group",
                                     "scan[].channel",
                                     "scan[].pixel",
                                     "scan[].unit",
                                     "scan[].pressure",
                                     "scan[].density",
                                     "scan[].treatment",
                                     "scan[].contact",
                                     "scan[].reading",
                                     "experiment.file"};

double read_modulus(const io::Config& config, const std::string& key) {
  return positive(config, key, dimension::pressure);
}

double read_poissons_ratio(const io::Config& config, const std::string& key) {
  const double ratio = config.number(key);
  if (!(ratio > -1 && ratio <= 0.5)) {
    reject(config, key, fmt::format("{}", ratio), "a ratio above -1 and at most 0.5");
  }
  return ratio;
}

/// One of the library, if it is named, and what the file says of its own.
void read_material(const io::Config& config, analysis::CaseSettings& settings) {
  const bool is_named = config.has("material.name");
  if (is_named) {
    at_key(config, "material.name", [&](const std::string& name) {
      analysis::take_material(name, settings);
      return true;
    });
  }
  analysis::ContactSettings& contact = settings.contact;
  if (!is_named || config.has("material.youngs_modulus")) {
    contact.youngs_modulus = read_modulus(config, "material.youngs_modulus");
  }
  if (!is_named || config.has("material.poissons_ratio")) {
    contact.poissons_ratio = read_poissons_ratio(config, "material.poissons_ratio");
  }
  if (config.has("material.counter_youngs_modulus") ||
      config.has("material.counter_poissons_ratio")) {
    contact.counter_youngs_modulus = read_modulus(config, "material.counter_youngs_modulus");
    contact.counter_poissons_ratio = read_poissons_ratio(config, "material.counter_poissons_ratio");
  }
  if (config.has("material.saturation_pressure")) {
    contact.saturation_pressure.reset();
    if (config.text("material.saturation_pressure") != "none") {
      contact.saturation_pressure =
          positive(config, "material.saturation_pressure", dimension::pressure);
    }
  }
}

void read_friction(const io::Config& config, analysis::FrictionSettings& friction) {
  if (friction.shear_strength == 0 || config.has("shear_strength")) {
    friction.shear_strength = positive(config, "shear_strength", dimension::pressure);
  }
  if (config.has("boundary_shear_strength")) {
    friction.boundary_shear_strength =
        config.quantity("boundary_shear_strength", dimension::pressure);
  }
  if (config.has("boundary_shear_share")) {
    friction.boundary_shear_share = config.number("boundary_shear_share");
  }
  if (config.has("area")) friction.area = at_key(config, "area", friction::parse_area);
  const auto same_name = [](std::string_view setting) { return std::string(setting); };
  if (const auto found = analysis::objection(friction, same_name)) {
    throw InputError(config.place(found->setting), found->got, found->expected, found->remedy);
  }
}

void read_contact(const io::Config& config, analysis::ContactSettings& contact) {
  if (config.has("contact.boundary")) {
    contact.boundary = named(config, "contact.boundary", analysis::kBoundaries);
  }
  if (config.has("contact.solver")) {
    contact.solver = named(config, "contact.solver", analysis::kSolvers);
  }
  if (config.has("contact.tolerance")) {
    contact.tolerance = positive(config, "contact.tolerance", dimension::none);
  }
}

void read_lubricant(const io::Config& config, analysis::FilmSettings& lubricant) {
  if (config.has("lubricant.oil_density")) {
    lubricant.oil_density = positive(config, "lubricant.oil_density", dimension::density);
  }
  if (config.has("lubricant.model")) {
    lubricant.model = at_key(config, "lubricant.model", deposition::parse_model);
  }
  if (config.has("lubricant.reading")) {
    lubricant.reading = at_key(config, "lubricant.reading", deposition::parse_reading);
  }
  if (config.has("lubricant.edge")) {
    lubricant.edge = at_key(config, "lubricant.edge", deposition::parse_edge);
  }
  if (config.has("lubricant.droplet")) {
    lubricant.droplet_height = positive(config, "lubricant.droplet", dimension::length);
  }
  if (config.has("lubricant.seed")) {
    const std::int64_t seed = config.integer("lubricant.seed");
    if (seed < 0) reject(config, "lubricant.seed", fmt::format("{}", seed), "zero or more");
    lubricant.seed = static_cast<std::uint64_t>(seed);
  }
}

void read_sweep(const io::Config& config, analysis::CaseSettings& settings) {
  if (config.has("sweep.mean_pressure")) {
    settings.mean_pressures = read_axis(config, "sweep.mean_pressure", dimension::pressure, false);
  }
  settings.film.lubricant_densities = {0};  // no density asked for: dry friction alone
  if (config.has("sweep.lubricant_density")) {
    settings.film.lubricant_densities =
        read_axis(config, "sweep.lubricant_density", dimension::areal_density, true);
  }
}

}  // namespace

Study Study::of(const Scan& scan) const {
  Study alone = *this;
  alone.scans = {scan};
  const OwnSettings& own = scan.own;
  analysis::CaseSettings& under = alone.settings;
  under.mean_pressures = own.mean_pressures.value_or(settings.mean_pressures);
  under.film.lubricant_densities =
      own.lubricant_densities.value_or(settings.film.lubricant_densities);
  under.film.reading = own.reading.value_or(settings.film.reading);
  alone.treatment = own.treatment.value_or(treatment);
  if (own.deformation == Deformation::elastic) under.contact.saturation_pressure.reset();
  return alone;
}

std::size_t Study::n_cases() const {
  std::size_t n = 0;
  for (const Scan& scan : scans) {
    const Study alone = of(scan);
    n += alone.settings.mean_pressures.size() * alone.conditions().size();
  }
  return n;
}

std::vector<Condition> Study::conditions() const {
  std::vector<Condition> all;
  const std::size_t n_speeds = flows() ? sliding_speeds.size() : 1;
  const std::size_t n_densities = settings.film.lubricant_densities.size();
  all.reserve(n_densities * n_speeds);
  for (std::size_t density = 0; density < n_densities; ++density) {
    for (std::size_t speed = 0; speed < n_speeds; ++speed) all.push_back({density, speed});
  }
  return all;
}

double Study::lubricant_density(const Condition& condition) const {
  return settings.film.lubricant_densities.at(condition.density);
}

analysis::FluidSettings Study::fluid_settings(const Condition& condition) const {
  analysis::FluidSettings fluid = settings.fluid;
  if (flows()) fluid.sliding_speed = sliding_speeds.at(condition.speed);
  return fluid;
}

const std::vector<std::string>& known_keys() { return kKeys; }

namespace {

Study study_of(const io::Config& config, const fs::path& file) {
  config.reject_unknown(known_keys());
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  Study study;
  study.file = file;
  study.title = config.has("title") ? config.text("title") : file.stem().string();
  analysis::CaseSettings& settings = study.settings;
  read_material(config, settings);
  read_friction(config, settings.friction);
  read_contact(config, settings.contact);
  read_lubricant(config, settings.film);
  read_sweep(config, settings);
  read_flowing_oil(config, study);
  if (config.has("treatment.steps")) study.treatment = read_steps(config, "treatment.steps");
  read_scans(config, folder, study);
  if (config.has("experiment.file")) {
    study.experiment = read_experiment(folder / config.text("experiment.file"));
  }
  return study;
}

}  // namespace

Study read_study(const fs::path& file) { return study_of(io::Config::read(file), file); }

Study parse_study(const std::string& text, const fs::path& file) {
  return study_of(io::Config::parse(text, file.string()), file);
}

}  // namespace tabor::study
