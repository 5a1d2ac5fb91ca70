#include "tabor/results/result_maps.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/io/hdf5/guard.hpp"
#include "tabor/io/text/toml.hpp"
#include "tabor/results/fields_file.hpp"

namespace tabor::results {
namespace {

namespace fs = std::filesystem;
using io::Hdf5Reader;
using scan::NamedMap;

constexpr double kGram = 1e-3;  // [kg]

std::optional<double> number(const Hdf5Reader& reader, const std::string& group,
                             const std::string& name) {
  if (group.empty() || !reader.has_attribute(group, name)) return std::nullopt;
  return reader.number(group, name);
}

std::string unit_of(const Hdf5Reader& reader, const std::string& path) {
  return reader.has_attribute(path, "units") ? reader.text(path, "units") : "1";
}

/// A map as it stands in the file.
NamedMap stored(const Hdf5Reader& reader, const ResultMaps& result, const std::string& path) {
  const auto [ny, nx] = reader.map_shape(path);
  if (ny != result.grid.ny || nx != result.grid.nx) {
    throw InputError(fmt::format("{}: {}", result.file.string(), path),
                     fmt::format("{} x {} pixels", nx, ny),
                     fmt::format("{} x {} as the surface", result.grid.nx, result.grid.ny),
                     "the file is damaged: compute it again");
  }
  return {.name = path.substr(path.rfind('/') + 1),
          .unit = unit_of(reader, path),
          .load = [file = result.file, path] { return io::read_guarded_map(file, path); },
          .precision = reader.precision(path)};
}

/// True for what a map of a group is: not an axis, and not what `contact` says.
bool is_map(const Hdf5Reader& reader, const std::string& path, const std::string& name) {
  return name != "x" && name != "y" && name != "state" && reader.exists(path) &&
         reader.is_dataset(path) && reader.shape(path).size() == 2;
}

void add_stored(const Hdf5Reader& reader, const std::string& group, ResultMaps& result) {
  if (group.empty()) return;
  std::vector<NamedMap>& maps = result.states.back().maps;
  for (const std::string& name : reader.children(group)) {
    const std::string path = fmt::format("{}/{}", group, name);
    const bool is_new = std::none_of(maps.begin(), maps.end(),
                                     [&](const NamedMap& one) { return one.name == name; });
    if (is_new && is_map(reader, path, name)) maps.push_back(stored(reader, result, path));
  }
}

/// 1 where the solids touch: under pressure, or as the store of a study keeps it.
void add_contact(const Hdf5Reader& reader, const std::string& group, ResultMaps& result) {
  for (const char* name : {"pressure", "state"}) {
    const std::string path = group + "/" + name;
    if (group.empty() || !reader.exists(path)) continue;
    NamedMap map = stored(reader, result, path);
    map.name = "contact";
    map.unit = "1";
    map.load = [load = map.load]() -> Field { return (load() > 0).cast<double>(); };
    result.states.back().maps.push_back(std::move(map));
    return;
  }
}

void add_displacement(const Hdf5Reader& reader, const std::string& group, ResultMaps& result) {
  const std::string path = group + "/gap";
  const std::optional<double> separation = number(reader, group, "separation_m");
  if (!separation || !reader.exists(path) || result.surface.empty()) return;
  NamedMap map = stored(reader, result, path);
  map.name = "displacement";
  map.load = [gap = map.load, height = result.surface.front().load, separation]() -> Field {
    return gap() + height() - *separation;
  };
  if (const std::string tool = group + "/tool"; reader.exists(tool)) {
    map.load = [under_flat = map.load, over = stored(reader, result, tool).load]() -> Field {
      return under_flat() + over();
    };
  }
  result.states.back().maps.push_back(std::move(map));
}

/// "7 MPa, 0.9 g/m^2, 5 mm/s", whichever of them the groups say.
std::string label_of(const Hdf5Reader& reader, const StateGroups& groups) {
  const auto first = [&](const std::string& name) {
    for (const std::string& group : {groups.fluid, groups.contact, groups.film}) {
      if (const auto value = number(reader, group, name)) return value;
    }
    return std::optional<double>();
  };
  std::vector<std::string> parts;
  if (const auto distance = first("distance_m")) parts.push_back("after " + si(*distance, "m"));
  if (const auto pressure = first("mean_pressure_Pa")) parts.push_back(si(*pressure, "Pa"));
  if (const auto density = first("lubricant_density_g_per_m2")) {
    parts.push_back(density_text(kGram * *density));
  }
  if (const auto speed = first("sliding_speed_m_per_s")) parts.push_back(si(*speed, "m/s"));
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// True if every contact was solved on the surface as the one before has left it.
bool has_load_path(const Hdf5Reader& reader) {
  if (!reader.has_attribute("/", "config_toml")) return false;
  const io::Config config = io::Config::parse(reader.text("/", "config_toml"), "config_toml");
  return config.has("load_path") && config.flag("load_path");
}

double pitch(const Hdf5Reader& reader, const fs::path& file, const std::string& surface,
             const char* axis) {
  const double pixel = reader.number(surface, fmt::format("pixel_{}_m", axis));
  if (pixel > 0 && std::isfinite(pixel)) return pixel;
  throw InputError(fmt::format("{}: {}", file.string(), surface),
                   fmt::format("a pixel of {} m", pixel), "a positive length",
                   "the file is damaged: compute it again");
}

std::vector<std::string> names_of(const std::vector<const NamedMap*>& maps) {
  std::vector<std::string> names;
  names.reserve(maps.size());
  for (const NamedMap* map : maps) names.push_back(map->name);
  return names;
}

/// Each name once, in the order of the alphabet.
std::string list_of(const std::vector<const NamedMap*>& maps) {
  std::vector<std::string> names = names_of(maps);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names.empty() ? "no map" : fmt::format("{}", fmt::join(names, ", "));
}

std::size_t first_state(const ResultMaps& result, const MapChoice& choice) {
  if (!choice.state || result.states.empty()) return 0;
  if (*choice.state < result.states.size()) return *choice.state;
  std::string states;
  for (std::size_t i = 0; i < result.states.size(); ++i) {
    states += fmt::format("{}{} ({})", i > 0 ? ", " : "", i, result.states[i].label);
  }
  throw InputError(fmt::format("state of {}", result.file.string()),
                   fmt::format("{}", *choice.state), states + " or all", "");
}

struct Axis {
  double begin = 0;  ///< edge of the first pixel [m]
  double pixel = 0;
};

Axis axis_of(const Hdf5Reader& reader, const fs::path& file, const std::string& path) {
  const std::vector<double> places = reader.numbers(path);
  const double pixel = places.size() > 1 ? places[1] - places[0] : 0;
  if (pixel > 0) return {places[0] - pixel / 2, pixel};
  throw InputError(fmt::format("{}: {}", file.string(), path), "places that do not rise",
                   "two or more, rising", "the file is damaged: compute it again");
}

/// The maps of `ehl point`, about the centre of the contact.
ResultMaps maps_of_point(const Hdf5Reader& reader, const fs::path& file) {
  const auto [ny, nx] = reader.map_shape("/contact/film");
  const Axis x = axis_of(reader, file, "/contact/x"), y = axis_of(reader, file, "/contact/y");
  ResultMaps result{.file = file,
                    .grid = {.nx = nx,
                             .ny = ny,
                             .lx = static_cast<double>(nx) * x.pixel,
                             .ly = static_cast<double>(ny) * y.pixel},
                    .surface = {},
                    .states = {{reader.exists("/history") ? "at the end" : "steady", {}}},
                    .left = x.begin,
                    .top = y.begin};
  add_stored(reader, "/contact", result);
  for (NamedMap& map : result.states.back().maps) {
    if (map.name == "film") map.name = "film_thickness";
  }
  return result;
}

/// "/profile/film, /profile/pressure": all data below a group.
void list_data(const Hdf5Reader& reader, const std::string& group,
               std::vector<std::string>& names) {
  for (const std::string& name : reader.children(group)) {
    const std::string path = fmt::format("{}/{}", group == "/" ? "" : group, name);
    if (!reader.exists(path)) continue;
    reader.is_dataset(path) ? names.push_back(path) : list_data(reader, path, names);
  }
}

InputError without_maps(const Hdf5Reader& reader, const fs::path& file) {
  constexpr const char* kExpected =
      "a result of contact, lubricate, friction, sweep or ehl point with its maps";
  std::vector<std::string> names;
  list_data(reader, "/", names);
  if (reader.exists("/states") || names.empty()) {
    return {file.string(), "a file without maps", kExpected,
            "write it with fields=contact or fields=all"};
  }
  return {
      file.string(), fmt::format("a file without maps, with {}", fmt::join(names, ", ")), kExpected,
      fmt::format("'tabor report {} --no-html' writes curves as figures and CSV", file.string())};
}

}  // namespace

ResultMaps maps_on(const Hdf5Reader& reader, const fs::path& file, const std::string& surface) {
  const std::string path = surface + "/height";
  const auto [ny, nx] = reader.map_shape(path);
  const double dx = pitch(reader, file, surface, "x"), dy = pitch(reader, file, surface, "y");
  ResultMaps result{.file = file,
                    .grid = {.nx = nx,
                             .ny = ny,
                             .lx = static_cast<double>(nx) * dx,
                             .ly = static_cast<double>(ny) * dy},
                    .surface = {},
                    .states = {}};
  result.surface = {stored(reader, result, path)};
  return result;
}

void add_state(const Hdf5Reader& reader, const StateGroups& groups, ResultMaps& result) {
  result.states.push_back({label_of(reader, groups), {}});
  for (const std::string& group : {groups.contact, groups.film, groups.trapped, groups.fluid}) {
    add_stored(reader, group, result);
  }
  add_contact(reader, groups.contact, result);
  if (groups.keeps_height) add_displacement(reader, groups.contact, result);
}

ResultMaps read_result_maps(const Hdf5Reader& reader, const fs::path& file) {
  if (reader.exists("/contact/film")) return maps_of_point(reader, file);
  if (!reader.exists("/surface/height")) throw without_maps(reader, file);
  ResultMaps result = maps_on(reader, file, "/surface");
  if (!reader.exists("/states")) return result;
  const bool has_path = has_load_path(reader);
  for (const std::string& name : reader.children("/states")) {
    const bool is_first = result.states.empty();
    add_state(reader,
              {.contact = "/states/" + name,
               .film = {},
               .trapped = {},
               .fluid = {},
               .keeps_height = is_first || !has_path},
              result);
  }
  return result;
}

namespace {

/// Throws InputError where the chosen state lacks the map, but others have it.
void require_another_state(const ResultMaps& result, const MapChoice& choice) {
  std::vector<std::size_t> with_map;
  for (std::size_t i = 0; i < result.states.size(); ++i) {
    const std::vector<NamedMap>& maps = result.states[i].maps;
    const bool has_map = std::any_of(maps.begin(), maps.end(),
                                     [&](const NamedMap& map) { return map.name == choice.field; });
    if (has_map) with_map.push_back(i);
  }
  if (with_map.empty() || !choice.state) return;
  throw InputError(fmt::format("state of {}", result.file.string()),
                   fmt::format("{}, which has no map '{}'", *choice.state, choice.field),
                   fmt::format("one of {}", fmt::join(with_map, ", ")), "");
}

}  // namespace

scan::MapSet chosen_maps(const ResultMaps& result, const MapChoice& choice) {
  const std::size_t begin = first_state(result, choice);
  const std::size_t end =
      choice.state ? std::min(begin + 1, result.states.size()) : result.states.size();
  const bool is_numbered = end - begin > 1;
  scan::MapSet set{.grid = result.grid,
                   .maps = {},
                   .metadata = {{"Source", result.file.string()}},
                   .left = result.left,
                   .top = result.top};
  std::vector<const NamedMap*> known;
  const auto take = [&](const NamedMap& map, const std::string& name) {
    known.push_back(&map);
    if (choice.field != "all" && choice.field != map.name) return;
    set.maps.push_back(map);
    set.maps.back().name = name;
  };
  for (const NamedMap& map : result.surface) take(map, map.name);
  for (std::size_t i = begin; i < end; ++i) {
    for (const NamedMap& map : result.states[i].maps) {
      take(map, is_numbered ? fmt::format("{}_{:04}", map.name, i) : map.name);
    }
  }
  if (!set.maps.empty()) return set;
  require_another_state(result, choice);
  throw InputError(fmt::format("field of {}", result.file.string()),
                   fmt::format("'{}'{}", choice.field, suggestion(choice.field, names_of(known))),
                   list_of(known) + " or all", "");
}

std::filesystem::path file_of_result(const std::filesystem::path& result) {
  std::error_code unknown;
  return std::filesystem::is_directory(result, unknown) ? result / "results.h5" : result;
}

}  // namespace tabor::results
