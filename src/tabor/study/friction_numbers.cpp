#include <fmt/format.h>

#include <cmath>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/io/hdf5/guard.hpp"
#include "tabor/io/text/toml.hpp"
#include "tabor/study/friction_table.hpp"

namespace tabor::study {
namespace {

namespace fs = std::filesystem;

constexpr double kGram = 1e-3;  // [kg]

[[noreturn]] void reject_file(const fs::path& file, const std::string& got) {
  throw InputError(file.string(), got,
                   "a folder of 'tabor sweep', its results.h5, or a file of 'tabor friction -o'",
                   "");
}

std::optional<double> known(double value) {
  return std::isnan(value) ? std::nullopt : std::optional<double>(value);
}

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  for (const std::string& word : split(text, ' ')) {
    if (!word.empty()) words.push_back(word);
  }
  return words;
}

/// A column of the table of a study; NaN in all its rows where it has none.
std::vector<double> column(const io::Hdf5Reader& file, const std::string& name, std::size_t n) {
  const std::string path = "/table/" + name;
  if (!file.exists(path)) return std::vector<double>(n, std::nan(""));
  return file.numbers(path);
}

/// The rows of results.h5 (docs/results.md).
std::vector<FrictionNumber> numbers_of_study(const io::Hdf5Reader& file, const fs::path& path) {
  const std::vector<std::string> scans = file.texts("/table/scan");
  const std::vector<std::string> groups = file.texts("/table/group");
  const std::vector<std::string> errors = file.texts("/table/error");
  const std::vector<std::string> codes = file.texts("/table/warning_codes");
  const std::size_t n = scans.size();
  const auto numbers = [&](const char* name) { return column(file, name, n); };
  const auto pressures = numbers("mean_pressure_Pa");
  const auto densities = numbers("lubricant_density_g_per_m2");
  const auto speeds = numbers("sliding_speed_m_per_s");
  const auto dry = numbers("friction_dry");
  const auto converged = numbers("converged");
  const bool flows = file.exists("/table/friction_mixed");
  const auto friction = numbers(flows ? "friction_mixed" : "friction_lubricated");
  for (const std::size_t size :
       {groups.size(), errors.size(), codes.size(), pressures.size(), densities.size(),
        speeds.size(), dry.size(), converged.size(), friction.size()}) {
    if (size != n) reject_file(path, "a table whose columns differ in length");
  }
  std::vector<FrictionNumber> all;
  all.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    all.push_back({.scan = scans[i],
                   .group = groups[i],
                   .at = {pressures[i], kGram * densities[i], known(speeds[i])},
                   .friction_dry = dry[i],
                   .friction = friction[i],
                   .converged = converged[i] != 0,
                   .failed = !errors[i].empty(),
                   .codes = words_of(codes[i])});
  }
  return all;
}

/// The one speed at which the oil of a file of states flows.
std::optional<double> speed_of_states(const io::Hdf5Reader& file) {
  constexpr const char* kKey = "sliding_speed_m_per_s";
  const io::Config config = io::Config::parse(file.text("/", "config_toml"), "config_toml");
  return config.has(kKey) ? std::optional<double>(config.number(kKey)) : std::nullopt;
}

/// The states of a file of `tabor friction -o`.
std::vector<FrictionNumber> numbers_of_states(const io::Hdf5Reader& file, const fs::path& path) {
  std::vector<FrictionNumber> all;
  std::optional<double> speed;
  for (const std::string& name : file.children("/states")) {
    const std::string state = "/states/" + name;
    if (!file.has_attribute(state, "friction_dry")) reject_file(path, "a result without friction");
    if (file.has_attribute(state, "friction_ploughing")) reject_file(path, "a result of sliding");
    const bool flows = file.has_attribute(state, "friction_mixed");
    if (flows && !speed) speed = speed_of_states(file);
    FrictionNumber number;
    number.at = {file.number(state, "mean_pressure_Pa"),
                 kGram * file.number(state, "lubricant_density_g_per_m2"),
                 flows ? speed : std::nullopt};
    number.friction_dry = file.number(state, "friction_dry");
    number.friction = file.number(state, flows ? "friction_mixed" : "friction_lubricated");
    number.converged = file.number(state, "converged") != 0;
    if (file.has_attribute(state, "warning_codes")) {
      number.codes = file.attribute_texts(state, "warning_codes");
    }
    all.push_back(std::move(number));
  }
  return all;
}

/// Damaged files hold anything.
void check_places(const std::vector<FrictionNumber>& numbers, const fs::path& path) {
  for (const FrictionNumber& number : numbers) {
    const forming::Condition& at = number.at;
    const bool is_place = std::isfinite(at.mean_pressure) && at.mean_pressure > 0 &&
                          std::isfinite(at.lubricant_density) && at.lubricant_density >= 0 &&
                          std::isfinite(at.sliding_speed.value_or(0));
    if (!is_place) reject_file(path, "friction under no pressure or at no density");
  }
}

std::string attribute(const io::Hdf5Reader& file, const char* name) {
  return file.has_attribute("/", name) ? file.text("/", name) : "?";
}

/// What is missing of a study; "" if nothing is, and for other results.
std::string incompleteness_of(const io::Hdf5Reader& file) {
  if (!file.has_attribute("/", "n_cases") || !file.has_attribute("/", "n_cases_done")) return "";
  const auto n = static_cast<Index>(file.number("/", "n_cases"));
  const auto n_done = static_cast<Index>(file.number("/", "n_cases_done"));
  if (n_done >= n) return "";
  return fmt::format("the study is not complete: {} of {} cases are done", n_done, n);
}

FrictionNumbers read_from(const io::Hdf5Reader& file, const fs::path& path) {
  FrictionNumbers read;
  read.file = path;
  if (!file.has_attribute("/", "format") || file.text("/", "format") != "tabor") {
    reject_file(path, "an HDF5 file of another program");
  }
  if (file.exists("/table/friction_dry")) {
    read.numbers = numbers_of_study(file, path);
  } else if (file.exists("/states")) {
    read.numbers = numbers_of_states(file, path);
  }
  if (read.numbers.empty()) reject_file(path, "a result without friction");
  check_places(read.numbers, path);
  read.origin = {fmt::format("source: {}, made by tabor {} on {}", path.string(),
                             attribute(file, "software_version"), attribute(file, "created")),
                 "made with: " + attribute(file, "command")};
  read.incomplete = incompleteness_of(file);
  if (!read.incomplete.empty()) read.origin.push_back(read.incomplete);
  return read;
}

}  // namespace

FrictionNumbers read_friction(const fs::path& results) {
  std::error_code unknown;
  if (!fs::is_directory(results, unknown)) {
    return io::read_guarded(results,
                            [&](const io::Hdf5Reader& file) { return read_from(file, results); });
  }
  const fs::path file = results / "results.h5";
  if (!fs::exists(file, unknown)) reject_file(results, "a folder without results.h5");
  return read_friction(file);
}

}  // namespace tabor::study
