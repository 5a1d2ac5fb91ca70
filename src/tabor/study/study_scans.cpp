#include <glob.h>

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

#include "tabor/core/text.hpp"
#include "tabor/scan/read_parameters.hpp"
#include "tabor/study/study_keys.hpp"

namespace tabor::study {
namespace {

namespace fs = std::filesystem;

/// Takes what the file says at a key, which stands for the name of the parameter in complaints.
void read_at(const io::Config& config, const std::string& key,
             Parameter<scan::ReadOptions> parameter, scan::ReadOptions& options) {
  parameter.study_key = key;
  try {
    read_setting(config, parameter, options);
  } catch (const InputError& error) {
    const std::string text = error.what();
    if (!text.starts_with(parameter.name + ":")) throw;
    throw InputError(config.place(key) + text.substr(parameter.name.size()));
  }
}

void read_file_options(const io::Config& config, const std::string& prefix,
                       scan::ReadOptions& options) {
  for (const Parameter<scan::ReadOptions>& one : scan::read_parameters()) {
    const std::string key = prefix + one.study_name();
    if (!one.study_key.empty() && config.has(key)) read_at(config, key, one, options);
  }
  if (!options.pixel_y) options.pixel_y = options.pixel_x;
}

/// The characters of a folder's name mean themselves, whatever a pattern would make of them.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (std::string_view("*?[]\\").find(c) != std::string_view::npos) result += '\\';
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
  std::error_code unknown;  // reading says what is wrong with a link
  if (fs::exists(fs::symlink_status(exact, unknown))) return {exact};
  std::vector<fs::path> files = matches(folder, name);
  if (files.empty()) {
    const std::string where = fs::path(name).is_absolute() ? "" : " in " + folder.string();
    throw InputError(config.place("file") + ": no file '" + name + "'" + where +
                     suggestion(exact.filename().string(), names_beside(exact)));
  }
  return files;
}

/// Its path relative to the study; as written where one of the two is absolute and the other not.
std::string label_of(const fs::path& file, const fs::path& folder) {
  const fs::path relative = file.lexically_relative(folder);
  return (relative.empty() ? file : relative).generic_string();
}

OwnSettings read_own_settings(const io::Config& entry) {
  OwnSettings own;
  if (entry.has("pressure")) {
    own.mean_pressures = read_axis(entry, "pressure", *cases::find_parameter("mean_pressure"));
  }
  if (entry.has("density")) {
    own.lubricant_densities =
        read_axis(entry, "density", *cases::find_parameter("lubricant_density"));
  }
  if (entry.has("treatment")) own.treatment = read_steps(entry, "treatment");
  if (entry.has("contact")) own.deformation = named(entry, "contact", kDeformations);
  if (entry.has("reading")) own.reading = at_key(entry, "reading", deposition::parse_reading);
  return own;
}

/// Throws where steps of the treatment or the boundary contradict what is said about edges.
void check_edges(const io::Config& config, const Study& alone) {
  try {
    topography::check(alone.treatment);
  } catch (const InputError& error) {
    throw InputError(config.name() + ": " + error.what());
  }
  const auto edges = topography::edges_of(alone.treatment);
  check(config, cases::objection(alone.settings.contact, edges));
  if (alone.flows() && !alone.settings.contact.is_periodic()) {
    reject(config, "contact.edges", "'end'",
           "'tile' or 'cut': a film that flows is solved on a patch that repeats");
  }
}

/// What the scans of one table are computed under, as they all share it.
void check_settings(const io::Config& config, const io::Config& entry, const Study& alone,
                    const OwnSettings& own) {
  check_edges(config, alone);
  const cases::CaseSettings& settings = alone.settings;
  if (settings.mean_pressures.empty()) {
    throw InputError(config.place("sweep.mean_pressure") + " is missing, and " +
                     entry.texts("file").front() + " has no pressure of its own");
  }
  if (own.deformation == Deformation::saturated && !settings.contact.saturation_pressure) {
    reject(entry, "contact", "'saturated' without a limit", "material.saturation_pressure with it");
  }
  const auto found = cases::objection(settings.contact, settings.mean_pressures, key_of);
  if (found && found->setting == "mean_pressure" && own.mean_pressures) {
    throw InputError(entry.place("pressure"), found->got, found->expected, found->remedy);
  }
  check(config, found);
}

}  // namespace

void read_scans(const io::Config& config, const fs::path& folder, Study& study) {
  scan::ReadOptions common;
  read_file_options(config, "treatment.", common);
  std::set<std::pair<fs::path, std::string>> seen;  // with their groups
  for (const io::Config& entry : config.tables("scan")) {
    scan::ReadOptions options = common;
    read_file_options(entry, "", options);
    const std::string group = entry.has("group") ? entry.text("group") : "all";
    const OwnSettings own = read_own_settings(entry);
    const std::size_t n_before = study.scans.size();
    for (const std::string& name : entry.texts("file")) {
      for (const fs::path& file : find_files(entry, folder, name)) {
        if (!seen.emplace(fs::weakly_canonical(file), group).second) {
          reject(entry, "file", "'" + name + "' twice",
                 "each scan once in a group, it would count twice");
        }
        study.scans.push_back({file, label_of(file, folder), group, options, own});
      }
    }
    if (study.scans.size() > n_before) {
      check_settings(config, entry, study.of(study.scans.back()), own);
    }
  }
  if (study.scans.empty()) throw InputError(config.name() + ": no [[scan]] with a file");
}

}  // namespace tabor::study
