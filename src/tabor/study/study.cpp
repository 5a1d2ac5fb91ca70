#include "tabor/study/study.hpp"

#include <fmt/format.h>
#include <glob.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/io/toml.hpp"

namespace tabor::study {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kKnownKeys{"title",
                                          "shear_strength",
                                          "area",
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
                                          "lubricant.oil_density",
                                          "lubricant.model",
                                          "lubricant.reading",
                                          "lubricant.edge",
                                          "lubricant.droplet",
                                          "lubricant.seed",
                                          "scan[].file",
                                          "scan[].group",
                                          "scan[].channel",
                                          "scan[].pixel",
                                          "scan[].unit",
                                          "experiment.file"};

[[noreturn]] void refuse(const io::Config& config, std::string_view key, const std::string& got,
                         const std::string& expected) {
  throw InputError(config.place(key), got, expected, "");
}

double positive(const io::Config& config, std::string_view key, Dimension expected) {
  const double value = config.quantity(key, expected);
  if (!(value > 0) || !std::isfinite(value)) {
    refuse(config, key, fmt::format("{}", value), "a value above zero");
  }
  return value;
}

/// One of two words, as a bool that is true for the first.
bool either(const io::Config& config, std::string_view key, std::string_view first,
            std::string_view second) {
  const std::string word = config.text(key);
  if (word != first && word != second) {
    refuse(config, key, "'" + word + "'",
           fmt::format("{} or {}", first, second) +
               suggestion(word, {std::string(first), std::string(second)}));
  }
  return word == first;
}

/// Runs a parser of the modules below and says at which key its complaint arose.
template <typename Parse>
auto at_key(const io::Config& config, std::string_view key, Parse parse) {
  try {
    return parse(config.text(key));
  } catch (const InputError& error) {
    throw InputError(config.place(key) + ": " + error.what());
  }
}

material::Solid read_solid(const io::Config& config, const std::string& prefix) {
  material::Solid solid;
  solid.youngs_modulus = positive(config, prefix + "youngs_modulus", dimension::pressure);
  solid.poissons_ratio = config.number(prefix + "poissons_ratio");
  if (!(solid.poissons_ratio > -1 && solid.poissons_ratio <= 0.5)) {
    refuse(config, prefix + "poissons_ratio", fmt::format("{}", solid.poissons_ratio),
           "a ratio above -1 and at most 0.5");
  }
  return solid;
}

void read_material(const io::Config& config, Study& study) {
  study.solid = read_solid(config, "material.");
  if (config.has("material.counter_youngs_modulus") ||
      config.has("material.counter_poissons_ratio")) {
    study.counter_solid = read_solid(config, "material.counter_");
  }
  if (config.has("material.saturation_pressure")) {
    study.saturation_pressure =
        positive(config, "material.saturation_pressure", dimension::pressure);
  }
}

void read_contact(const io::Config& config, ContactSettings& contact) {
  if (config.has("contact.boundary")) {
    contact.periodic = either(config, "contact.boundary", "periodic", "free");
  }
  if (config.has("contact.solver")) {
    contact.solver = either(config, "contact.solver", "fast", "polonsky-keer")
                         ? contact::Solver::fast
                         : contact::Solver::polonsky_keer;
  }
  if (config.has("contact.tolerance")) {
    contact.tolerance = positive(config, "contact.tolerance", dimension::none);
  }
}

void read_lubricant(const io::Config& config, LubricantSettings& lubricant) {
  if (config.has("lubricant.oil_density")) {
    lubricant.oil_density = positive(config, "lubricant.oil_density", dimension::density);
  }
  if (config.has("lubricant.model")) {
    lubricant.model = at_key(config, "lubricant.model", lubrication::parse_model);
  }
  if (config.has("lubricant.reading")) {
    lubricant.reading = at_key(config, "lubricant.reading", lubrication::parse_reading);
  }
  if (config.has("lubricant.edge")) {
    lubricant.edge = at_key(config, "lubricant.edge", lubrication::parse_edge);
  }
  if (config.has("lubricant.droplet")) {
    lubricant.droplet_height = positive(config, "lubricant.droplet", dimension::length);
  }
  if (config.has("lubricant.seed")) {
    const std::int64_t seed = config.integer("lubricant.seed");
    if (seed < 0) {
      refuse(config, "lubricant.seed", fmt::format("{}", seed), "zero or more");
    }
    lubricant.seed = static_cast<std::uint64_t>(seed);
  }
}

/// A sweep axis: every value finite, at least (or above) zero, and named once.
std::vector<double> read_axis(const io::Config& config, std::string_view key, Dimension expected,
                              bool zero_allowed) {
  const std::vector<double> values = config.quantities(key, expected);
  std::set<double> seen;
  for (const double value : values) {
    if (!std::isfinite(value) || value < 0 || (value == 0 && !zero_allowed)) {
      refuse(config, key, fmt::format("{}", value),
             zero_allowed ? "values of zero or more" : "values above zero");
    }
    if (!seen.insert(value).second) {
      refuse(config, key, "the same value twice", "each value once");
    }
  }
  return values;
}

void read_sweep(const io::Config& config, Study& study) {
  study.mean_pressures = read_axis(config, "sweep.mean_pressure", dimension::pressure, false);
  study.lubricant_densities = {0};  // no density asked for: dry friction alone
  if (config.has("sweep.lubricant_density")) {
    study.lubricant_densities =
        read_axis(config, "sweep.lubricant_density", dimension::areal_density, true);
  }
  for (const double pressure : study.mean_pressures) {
    if (pressure >= study.saturation_pressure) {
      refuse(config, "sweep.mean_pressure", format_si(pressure, "Pa"),
             "pressures below the saturation pressure " +
                 format_si(study.saturation_pressure, "Pa") + ", which no load can exceed");
    }
  }
}

void read_file_options(const io::Config& config, const std::string& prefix,
                       topography::ReadOptions& options) {
  if (config.has(prefix + "channel")) {
    options.channel = config.text(prefix + "channel");
  }
  if (config.has(prefix + "unit")) {
    options.unit = config.text(prefix + "unit");
  }
  if (config.has(prefix + "pixel")) {
    options.pixel_x = options.pixel_y = positive(config, prefix + "pixel", dimension::length);
  }
}

/// The characters of a folder's name mean themselves, whatever a pattern would make of them.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (std::string_view("*?[]\\").find(c) != std::string_view::npos) {
      result += '\\';
    }
    result += c;
  }
  return result;
}

/// Files that a pattern matches, in byte order whatever the locale.
std::vector<fs::path> matches(const fs::path& folder, const std::string& pattern) {
  const std::string whole =
      fs::path(pattern).is_absolute() ? pattern : escaped(folder.string()) + "/" + pattern;
  glob_t found{};
  std::vector<fs::path> files;
  if (::glob(whole.c_str(), GLOB_NOSORT, nullptr, &found) == 0) {
    files.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  }
  ::globfree(&found);
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> names_beside(const fs::path& file) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(file.parent_path(), error)) {
    names.push_back(entry.path().filename().string());
  }
  return names;
}

std::vector<fs::path> find_files(const io::Config& config, const fs::path& folder,
                                 const std::string& name) {
  const fs::path exact = folder / name;
  if (fs::exists(exact)) {
    return {exact};
  }
  std::vector<fs::path> files = matches(folder, name);
  if (files.empty()) {
    throw InputError(config.place("file") + ": no file '" + name + "' in " + folder.string() +
                     suggestion(exact.filename().string(), names_beside(exact)));
  }
  return files;
}

void read_scans(const io::Config& config, const fs::path& folder, Study& study) {
  topography::ReadOptions common;
  read_file_options(config, "treatment.", common);
  std::set<fs::path> seen;
  for (const io::Config& entry : config.tables("scan")) {
    topography::ReadOptions options = common;
    read_file_options(entry, "", options);
    for (const std::string& name : entry.texts("file")) {
      for (const fs::path& file : find_files(entry, folder, name)) {
        if (!seen.insert(fs::weakly_canonical(file)).second) {
          refuse(entry, "file", "'" + name + "' twice", "each scan once, it would count twice");
        }
        study.scans.push_back({file, file.lexically_relative(folder).generic_string(),
                               entry.has("group") ? entry.text("group") : "all", options});
      }
    }
  }
  if (study.scans.empty()) {
    throw InputError(config.name() + ": no [[scan]] with a file");
  }
}

}  // namespace

double Study::effective_modulus() const {
  return counter_solid ? material::effective_modulus(solid, *counter_solid)
                       : material::effective_modulus(solid);
}

double in_g_per_m2(double lubricant_density) {
  return parse_number(fmt::format("{:.15g}", 1e3 * lubricant_density)).value();
}

Study read_study(const fs::path& file) {
  const io::Config config = io::Config::read(file);
  config.reject_unknown(kKnownKeys);
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  Study study;
  study.file = file;
  study.title = config.has("title") ? config.text("title") : file.stem().string();
  study.shear_strength = positive(config, "shear_strength", dimension::pressure);
  if (config.has("area")) {
    study.area = at_key(config, "area", friction::parse_area);
  }
  read_material(config, study);
  read_contact(config, study.contact);
  read_lubricant(config, study.lubricant);
  read_sweep(config, study);
  if (config.has("treatment.steps")) {
    study.treatment = config.texts("treatment.steps");
    try {
      topography::check(study.treatment);
    } catch (const InputError& error) {
      throw InputError(config.place("treatment.steps") + ": " + error.what());
    }
  }
  read_scans(config, folder, study);
  if (config.has("experiment.file")) {
    study.experiment = read_experiment(folder / config.text("experiment.file"));
  }
  return study;
}

}  // namespace tabor::study
