#include "tabor/study/study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/scan/read_parameters.hpp"
#include "tabor/study/study_keys.hpp"

namespace tabor::study {
namespace {

namespace fs = std::filesystem;

/// Keys that are no parameters.
const std::vector<std::string> kOtherKeys{"title",           "material.name",  "treatment.steps",
                                          "contact.edges",   "scan[].file",    "scan[].group",
                                          "scan[].pressure", "scan[].density", "scan[].treatment",
                                          "scan[].contact",  "scan[].reading", "experiment.file"};

/// Axes are lists, each of whose values is a case.
bool is_axis(const ParameterHead& parameter) { return parameter.study_key.starts_with("sweep."); }

/// A solid of the library, if one is named.
void read_material(const io::Config& config, cases::CaseSettings& settings) {
  if (!config.has("material.name")) return;
  at_key(config, "material.name", [&](const std::string& name) {
    cases::take_material(name, settings);
    return true;
  });
}

/// Returns the parameters that a file gives with one value.
Parameters<cases::CaseSettings> single_parameters() {
  Parameters<cases::CaseSettings> all = cases::case_parameters();
  std::erase_if(all,
                [](const ParameterHead& one) { return one.study_key.empty() || is_axis(one); });
  return all;
}

/// What the file says of each parameter.
void read_case(const io::Config& config, cases::CaseSettings& settings) {
  read_settings(config, single_parameters(), settings, config.has("material.name"));
  check(config, cases::objection(settings.friction, key_of, settings.contact.material));
}

void read_sweep(const io::Config& config, cases::CaseSettings& settings) {
  settings.film.lubricant_densities = {0};  // no density asked for: dry friction alone
  for (const auto& [name, values] :
       {std::pair{"mean_pressure", &settings.mean_pressures},
        std::pair{"lubricant_density", &settings.film.lubricant_densities}}) {
    const ParameterHead& axis = *cases::find_parameter(name);
    if (config.has(axis.study_key)) *values = read_axis(config, axis.study_key, axis);
  }
}

/// Parameters of sliding that a file gives.
Parameters<cases::SlideSettings> slide_keys() {
  Parameters<cases::SlideSettings> all = cases::slide_parameters();
  std::erase_if(all, [](const ParameterHead& one) { return one.study_key.empty(); });
  return all;
}

/// A table [slide] has every case slide.
void read_slide(const io::Config& config, Study& study) {
  const Parameters<cases::SlideSettings> keys = slide_keys();
  const bool is_there = std::any_of(keys.begin(), keys.end(), [&](const ParameterHead& one) {
    return config.has(one.study_key);
  });
  if (!is_there) return;
  read_settings(config, keys, study.slide.emplace());
  if (study.flows()) {
    check(config,
          objection_to_use("fluid",
                           "oil that flows is not solved while the sheet changes: leave out "
                           "lubricant.fluid or the table [slide]"));
  }
  const cases::CaseSettings one = study.slide_settings(1, 0);  // values are checked as axes
  check(config, cases::objection(*study.slide, one, key_of));
}

}  // namespace

Study Study::of(const Scan& scan) const {
  Study alone = *this;
  alone.scans = {scan};
  const OwnSettings& own = scan.own;
  cases::CaseSettings& under = alone.settings;
  under.mean_pressures = own.mean_pressures.value_or(settings.mean_pressures);
  under.film.lubricant_densities =
      own.lubricant_densities.value_or(settings.film.lubricant_densities);
  under.film.reading = own.reading.value_or(settings.film.reading);
  alone.treatment = own.treatment.value_or(treatment);
  if (edges && !topography::edges_of(alone.treatment)) {
    alone.treatment.push_back(fmt::format("edges={}", topography::kEdges.of(*edges)));
  }
  under.contact.take_edges(topography::edges_of(alone.treatment));
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

cases::FluidSettings Study::fluid_settings(const Condition& condition) const {
  cases::FluidSettings fluid = settings.fluid;
  if (flows()) fluid.sliding_speed = sliding_speeds.at(condition.speed);
  return fluid;
}

cases::CaseSettings Study::slide_settings(double mean_pressure, double lubricant_density) const {
  cases::CaseSettings one = settings;
  one.mean_pressures = {mean_pressure};
  one.film.lubricant_densities.clear();
  if (lubricant_density > 0) one.film.lubricant_densities.push_back(lubricant_density);
  one.trapped.trapped = settings.trapped.trapped && lubricant_density > 0;
  return one;
}

const std::vector<std::string>& known_keys() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> keys = kOtherKeys;
    for (const ParameterHead& one : scan::read_parameters()) {
      if (one.study_key.empty()) continue;
      keys.insert(keys.end(), {one.study_key, "scan[]." + one.study_name()});
    }
    for (const ParameterHead& one : cases::case_parameters()) {
      if (!one.study_key.empty()) keys.push_back(one.study_key);
    }
    for (const ParameterHead& one : slide_keys()) keys.push_back(one.study_key);
    return keys;
  }();
  return all;
}

namespace {

Study study_of(const io::Config& config, const fs::path& file) {
  config.reject_unknown(known_keys());
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  Study study;
  study.file = file;
  study.title = config.has("title") ? config.text("title") : file.stem().string();
  cases::CaseSettings& settings = study.settings;
  if (config.has("contact.edges")) study.edges = named(config, "contact.edges", topography::kEdges);
  read_material(config, settings);
  read_case(config, settings);
  if (config.has("contact.tool")) {
    at_key(config, "contact.tool", [&](const std::string&) {
      return cases::find_tool(settings.contact.tool, folder), true;
    });
  }
  read_sweep(config, settings);
  read_flowing_oil(config, study);
  check(config, cases::objection_to_trapped(settings, key_of));
  read_slide(config, study);
  if (config.has("treatment.steps")) study.treatment = read_steps(config, "treatment.steps");
  read_scans(config, folder, study);
  if (config.has("experiment.file")) {
    study.experiment = read_experiment(folder / config.text("experiment.file"));
  }
  return study;
}

}  // namespace

Study read_study(const fs::path& file, const std::vector<Change>& changes) {
  io::Config config = io::Config::read(file);
  for (const Change& change : changes) config = config.with(change.key, change.value);
  return study_of(config, file);
}

Study parse_study(const std::string& text, const fs::path& file) {
  return study_of(io::Config::parse(text, file.string()), file);
}

}  // namespace tabor::study
