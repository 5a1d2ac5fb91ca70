#include "tabor/results/combination.hpp"

#include <fmt/format.h>

#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/topography/surface_group.hpp"

namespace tabor::results {
namespace {

using comparison::Combination;

io::Json json_of(const comparison::Registration& r) {
  return {{"shift_x_m", r.shift_x},
          {"shift_y_m", r.shift_y},
          {"uncertainty_x_m", r.uncertainty_x},
          {"uncertainty_y_m", r.uncertainty_y},
          {"correlation", r.correlation},
          {"overlap", r.overlap},
          {"distinction", r.distinction},
          {"runner_up", r.runner_up},
          {"iterations", r.iterations}};
}

io::Json json_of(const comparison::Volume& volume) {
  return {{"volume_m3", volume.value},
          {"uncertainty_m3", volume.uncertainty},
          {"area_m2", volume.area}};
}

io::Json json_of(const comparison::WearVolumes& wear) {
  return {{"worn", json_of(wear.worn)},       {"piled_up", json_of(wear.piled_up)},
          {"net", json_of(wear.net)},         {"noise_m", wear.noise},
          {"noise_area_m2", wear.noise_area}, {"noise_floor_m3", wear.noise_floor},
          {"threshold_m", wear.threshold}};
}

/// A repeating texture fits at several shifts.
bool is_ambiguous(const Combination& c) {
  constexpr double suspicious = 0.8;
  return c.registration && c.registration->runner_up > suspicious;
}

/// Returns the share of holes in the overlap. Interpolation widens every hole by some pixels, and
/// what lies there counts nowhere.
double share_of_holes(const Combination& c) {
  return static_cast<double>(topography::count_holes(c.map)) /
         static_cast<double>(c.map.grid.size());
}

void write_numbers(io::Hdf5Writer& writer, const std::string& prefix, const io::Json& values) {
  for (const auto& [key, value] : values.items()) {
    const bool is_volume = value.is_object() && value.contains("volume_m3");
    if (value.is_object()) {
      write_numbers(writer, is_volume ? key + "_" : prefix, value);
    } else if (value.is_number_integer()) {
      writer.attribute("/combination", prefix + key, value.get<std::int64_t>());
    } else if (value.is_number()) {
      writer.attribute("/combination", prefix + key, value.get<double>());
    }
  }
}

}  // namespace

io::Json values_of(const Combination& c) {
  io::Json values = {{"shift_x_m", c.shift_x},
                     {"shift_y_m", c.shift_y},
                     {"registration", c.registration ? json_of(*c.registration) : io::Json()},
                     {"nx", c.map.grid.nx},
                     {"ny", c.map.grid.ny},
                     {"common_points", c.n_common},
                     {"rms_height_first_m", c.rms_a},
                     {"rms_height_second_m", c.rms_b},
                     {"rms_height_m", c.rms_map},
                     {"correlation", io::number(c.correlation)}};
  if (c.wear) values["wear"] = json_of(*c.wear);
  return values;
}

std::vector<std::string> doubts_of(const Combination& c) {
  constexpr double much = 0.01;
  std::vector<std::string> doubts;
  if (is_ambiguous(c)) {
    doubts.push_back(
        fmt::format("Another shift matches nearly as well ({:.0f} %). Check the shift if the "
                    "texture repeats",
                    100 * c.registration->runner_up));
  }
  if (const double share = share_of_holes(c); c.wear && share > much) {
    doubts.push_back(
        fmt::format("{} of the overlap lies in or beside holes and is left out of the volumes; "
                    "<fill=harmonic> fills small holes",
                    percent(share)));
  }
  return doubts;
}

void write_combination(const StoredCombination& combination, const ResultHead& head,
                       const std::vector<Finding>& warnings, const std::filesystem::path& file) {
  io::Hdf5Writer writer(file);
  write_result_head(writer, head);
  writer.attribute("/", "default", "surface");
  topography::write_surface_group(writer, combination.map, combination.map.source);
  writer.group("/combination");
  writer.attribute("/combination", "mode", combination.mode);
  io::Json values = combination.values;
  io::Json registration = values.at("registration");
  values.erase("registration");
  if (registration.is_object()) {  // its correlation is of the search, that of the overlap stays
    registration.erase("correlation");
    values.update(registration);
  }
  write_numbers(writer, "", values);
  write_warnings(writer, warnings);
  writer.commit();
}

}  // namespace tabor::results
