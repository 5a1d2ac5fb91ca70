#include "tabor/study/study_maps.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tabor/core/error.hpp"
#include "tabor/io/hdf5/guard.hpp"

namespace tabor::study {
namespace {

namespace fs = std::filesystem;
using io::Hdf5Reader;
using results::ResultMaps;

constexpr const char* kResult = "a result of contact, lubricate, friction, sweep or ehl point";

/// "0 (before_1.x3p), 1 (before_2.x3p)"
std::string listed(const Hdf5Reader& reader, const std::vector<std::string>& scans) {
  std::string text;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    text +=
        fmt::format("{}{} ({})", i > 0 ? ", " : "", i, reader.text("/scans/" + scans[i], "file"));
  }
  return text;
}

std::string chosen_scan(const Hdf5Reader& reader, const fs::path& file,
                        std::optional<std::size_t> scan) {
  const std::vector<std::string> scans = reader.children("/scans");
  const bool is_alone = !scan && scans.size() == 1;
  if (is_alone || (scan && *scan < scans.size())) return "/scans/" + scans[scan.value_or(0)];
  throw InputError("scan of " + file.string(), scan ? fmt::format("{}", *scan) : "none chosen",
                   "one of: " + listed(reader, scans), "");
}

/// The place of a value among the different ones, in the order in which they come.
std::size_t place_of(double value, std::vector<double>& known) {
  const auto place = std::find(known.begin(), known.end(), value) - known.begin();
  if (place == std::ssize(known)) known.push_back(value);
  return static_cast<std::size_t>(place);
}

/// The rows of a scan in the table of a study.
std::vector<std::size_t> rows_of(const Hdf5Reader& reader, const std::string& scan) {
  const std::vector<std::string> files = reader.texts("/table/scan");
  const std::vector<std::string> groups = reader.texts("/table/group");
  const std::string file = reader.text(scan, "file"), group = reader.text(scan, "group");
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < std::min(files.size(), groups.size()); ++i) {
    if (files[i] == file && groups[i] == group) rows.push_back(i);
  }
  return rows;
}

/// What the store still holds of a state.
std::string if_there(const Hdf5Reader& reader, const std::string& group) {
  return reader.exists(group) ? group : "";
}

void add_states(const Hdf5Reader& reader, const std::string& scan, ResultMaps& result) {
  const std::vector<double> pressures = reader.numbers("/table/mean_pressure_Pa");
  const std::vector<double> densities = reader.numbers("/table/lubricant_density_g_per_m2");
  std::vector<double> pressures_so_far, densities_so_far;
  std::size_t place = 0;
  for (const std::size_t row : rows_of(reader, scan)) {
    if (row >= std::min(pressures.size(), densities.size())) return;
    const auto member = [&](const char* name, std::size_t number) {
      return if_there(reader, fmt::format("{}/{}/{:04}", scan, name, number));
    };
    results::add_state(reader,
                       {.contact = member("contact", place_of(pressures[row], pressures_so_far)),
                        .film = member("films", place_of(densities[row], densities_so_far)),
                        .trapped = member("trapped", place),
                        .fluid = member("fluid", place)},
                       result);
    ++place;
  }
}

ResultMaps read_study(const Hdf5Reader& reader, const fs::path& file,
                      std::optional<std::size_t> scan) {
  const std::string chosen = chosen_scan(reader, file, scan);
  if (!reader.exists(chosen + "/surface/height")) {
    throw InputError(file.string(), "a scan whose surface is not in the store",
                     "its folder 'store' beside it", "run the study again, which makes it anew");
  }
  ResultMaps result = results::maps_on(reader, file, chosen + "/surface");
  add_states(reader, chosen, result);
  return result;
}

ResultMaps read_from(const Hdf5Reader& reader, const fs::path& file,
                     std::optional<std::size_t> scan) {
  if (!reader.has_attribute("/", "format") || reader.text("/", "format") != "tabor") {
    throw InputError(file.string(), "an HDF5 file of another program", kResult, "");
  }
  if (reader.exists("/scans")) return read_study(reader, file, scan);
  if (scan.value_or(0) > 0) {
    throw InputError("scan of " + file.string(), fmt::format("{}", *scan),
                     "none: it holds one surface", "");
  }
  return results::read_result_maps(reader, file);
}

}  // namespace

ResultMaps read_maps(const fs::path& result, std::optional<std::size_t> scan) {
  std::error_code unknown;
  const fs::path file = results::file_of_result(result);
  if (fs::is_regular_file(file, unknown) && !io::is_hdf5(file)) {
    throw InputError(file.string(), "no HDF5 file", kResult, "");
  }
  return io::read_guarded(file,
                          [&](const Hdf5Reader& reader) { return read_from(reader, file, scan); });
}

}  // namespace tabor::study
