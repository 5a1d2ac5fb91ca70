#include "tabor/cases/slide/checkpoint.hpp"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "tabor/cases/parameters.hpp"
#include "tabor/core/error.hpp"
#include "tabor/io/columns.hpp"
#include "tabor/io/files/sealed_file.hpp"
#include "tabor/topography/digest.hpp"

namespace tabor::cases {
namespace {

namespace fs = std::filesystem;
using io::Hdf5Reader;
using io::Hdf5Writer;

const Columns<sliding::Ploughing>& ploughing_columns() {
  using Record = sliding::Ploughing;
  static const Columns<Record> all{{"distance_m", "m", "", &Record::distance},
                                   {"work_J_per_m2", "J/m^2", "", &Record::work},
                                   {"lower_J_per_m2", "J/m^2", "", &Record::lower},
                                   {"upper_J_per_m2", "J/m^2", "", &Record::upper},
                                   {"moved_m", "m", "", &Record::moved},
                                   {"lost_m", "m", "", &Record::lost},
                                   {"without_space_m", "m", "", &Record::without_space},
                                   {"worn_m", "m", "", &Record::worn}};
  return all;
}

const Columns<ReachedSlide>& reached_columns() {
  using Record = ReachedSlide;
  static const Columns<Record> all{
      {"place", "", "", member_of(&Record::slider, &sliding::Slider::Reached::place)},
      {"energy_J_per_m2", "J/m^2", "",
       member_of(&Record::slider, &sliding::Slider::Reached::energy)},
      {"steps", "", "", &Record::steps},
      {"pixels", "", "", &Record::pixels},
      {"converged", "", "", &Record::converged},
      {"squeezed_away_m", "m", "", &Record::away}};
  return all;
}

std::string numbered(const char* name, std::uint64_t number) {
  return fmt::format("/{}/{:06}", name, number);
}

/// Writes records as groups of attributes, one after the other.
template <typename Record>
void write_all(Hdf5Writer& writer, const char* name, const Columns<Record>& columns,
               const std::vector<Record>& records) {
  for (std::size_t i = 0; i < records.size(); ++i) {
    writer.group(numbered(name, i));
    io::write_attributes(writer, numbered(name, i), columns, records[i]);
  }
}

template <typename Record>
std::vector<Record> read_all(const Hdf5Reader& reader, const char* name,
                             const Columns<Record>& columns) {
  std::vector<Record> records;
  while (reader.exists(numbered(name, records.size()))) {
    Record record;
    io::read_attributes(reader, numbered(name, records.size()), columns, record);
    records.push_back(std::move(record));
  }
  return records;
}

/// Calls act(path, list) for the lists of spectra, const or not.
template <typename Spectra, typename Act>
void for_each_list(Spectra& spectra, const std::string& group, const Act& act) {
  act(group + "/q_x", spectra.q_x);
  act(group + "/density_x", spectra.density_x);
  act(group + "/q_y", spectra.q_y);
  act(group + "/density_y", spectra.density_y);
}

/// Calls act(path, map) for the maps of a state, const or not.
template <typename Maps, typename Act>
void for_each_map(Maps& maps, const Act& act) {
  act("/sheet", maps.sheet);
  act("/pressure", maps.pressure);
  act("/gap", maps.gap);
  act("/squeezed", maps.squeezed);
  act("/liquid_pressure", maps.liquid_pressure);
  act("/saturation_pressure", maps.saturation_pressure);
}

void require_whole(const fs::path& file) {
  if (const std::string broken = io::broken_seal(file); !broken.empty()) {
    throw InputError(broken + "; remove the folder, and the run begins again");
  }
}

/// Adds settings as text.
template <typename Settings>
void add_lines(const Parameters<Settings>& parameters, const Settings& settings,
               std::string& text) {
  text += io::to_text(io::json_of(columns_of(parameters), settings), -1) + '\n';
}

}  // namespace

std::string identity_of(const topography::Topography& surface, const CaseSettings& settings,
                        const SlideSettings& sliding, const Tool& tool) {
  std::string text =
      fmt::format("sheet {:x}, tool {:x}, pressure {:.17g}\n",
                  topography::digest_of(surface.height, surface.grid),
                  topography::digest_of(tool.height, tool.grid), settings.mean_pressures.front());
  for (const double density : settings.film.lubricant_densities) {
    text += fmt::format("density {:.17g}\n", density);
  }
  for (const double place : sliding.maps_at) text += fmt::format("maps at {:.17g}\n", place);
  add_lines(contact_parameters(), settings.contact, text);
  add_lines(film_parameters(), settings.film, text);
  add_lines(trapped_parameters(), settings.trapped, text);
  add_lines(friction_parameters(), settings.friction, text);
  add_lines(slide_parameters(), sliding, text);
  return text;
}

fs::path SlideCheckpoint::maps_file(std::uint64_t state) const {
  return folder_ / fmt::format("maps-{:06}.h5", state);
}

void SlideCheckpoint::save(const ReachedSlide& reached) const {
  fs::create_directories(folder_);
  Hdf5Writer writer(file(), io::Seal::yes);
  const bool is_trapped = !reached.states.empty() && reached.states.front().trapped.has_value();
  writer.attribute("/", "identity", identity_);
  writer.attribute("/", "trapped", is_trapped ? 1 : 0);
  writer.write("/sheet", reached.slider.sheet);
  writer.write("/pressure", reached.slider.pressure);
  if (is_trapped) writer.write("/with_oil", reached.slider.with_oil);
  if (reached.slider.caps.size() > 0) writer.write("/caps", reached.slider.caps);
  if (reached.squeezed.size() > 0) writer.write("/squeezed", reached.squeezed);
  writer.group("/reached");
  io::write_attributes(writer, "/reached", reached_columns(), reached);
  writer.group("/since");
  io::write_attributes(writer, "/since", ploughing_columns(), reached.since);
  writer.group("/all");
  io::write_attributes(writer, "/all", ploughing_columns(), reached.all);
  write_all(writer, "periods", period_columns(), reached.periods);
  write_all(writer, "states", slide_columns({.trapped = is_trapped}), reached.states);
  for (std::size_t i = 0; i < reached.spectra.size(); ++i) {
    writer.group(numbered("spectra", i));
    for_each_list(reached.spectra[i], numbered("spectra", i),
                  [&](const std::string& path, const std::vector<double>& list) {
                    if (!list.empty()) writer.write(path, list);
                  });
  }
  if (!reached.with_maps.empty()) {
    writer.write("/with_maps",
                 std::vector<std::int64_t>(reached.with_maps.begin(), reached.with_maps.end()));
  }
  writer.commit();
}

std::optional<ReachedSlide> SlideCheckpoint::load() const {
  if (!fs::exists(file())) return std::nullopt;
  require_whole(file());
  const Hdf5Reader reader(file());
  if (!reader.has_attribute("/", "identity") || reader.text("/", "identity") != identity_) {
    throw InputError(folder_.string(), "the state of a run with other settings or another surface",
                     "one of this run", "name another folder, or remove this one");
  }
  ReachedSlide reached;
  io::read_attributes(reader, "/reached", reached_columns(), reached);
  io::read_attributes(reader, "/since", ploughing_columns(), reached.since);
  io::read_attributes(reader, "/all", ploughing_columns(), reached.all);
  reached.slider.sheet = reader.field("/sheet");
  reached.slider.pressure = reader.field("/pressure");
  if (reader.exists("/with_oil")) reached.slider.with_oil = reader.field("/with_oil");
  if (reader.exists("/caps")) reached.slider.caps = reader.field("/caps");
  if (reader.exists("/squeezed")) reached.squeezed = reader.field("/squeezed");
  reached.periods = read_all(reader, "periods", period_columns());
  reached.states =
      read_all(reader, "states", slide_columns({.trapped = reader.integer("/", "trapped") != 0}));
  while (reader.exists(numbered("spectra", reached.spectra.size()))) {
    SheetSpectra spectra;
    for_each_list(spectra, numbered("spectra", reached.spectra.size()),
                  [&](const std::string& path, std::vector<double>& list) {
                    if (reader.exists(path)) list = reader.numbers(path);
                  });
    reached.spectra.push_back(std::move(spectra));
  }
  if (reader.exists("/with_maps")) {
    const std::vector<std::int64_t> states = reader.integers("/with_maps");
    reached.with_maps.assign(states.begin(), states.end());
  }
  return reached;
}

void SlideCheckpoint::save_maps(std::uint64_t state, const SlideMaps& maps) const {
  fs::create_directories(folder_);
  Hdf5Writer writer(maps_file(state), io::Seal::yes);
  for_each_map(maps, [&](const char* path, const Field& map) {
    if (map.size() > 0) writer.write(path, map);
  });
  writer.write("/state", maps.state);
  writer.commit();
}

SlideMaps SlideCheckpoint::load_maps(std::uint64_t state) const {
  require_whole(maps_file(state));
  const Hdf5Reader reader(maps_file(state));
  SlideMaps maps;
  for_each_map(maps, [&](const char* path, Field& map) {
    if (reader.exists(path)) map = reader.field(path);
  });
  maps.state = reader.bytes("/state");
  return maps;
}

void SlideCheckpoint::remove() const {
  std::error_code ignored;
  fs::remove(file(), ignored);
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("maps-") && name.ends_with(".h5")) fs::remove(entry.path(), ignored);
  }
  fs::remove(folder_, ignored);  // stays where it holds anything else
}

}  // namespace tabor::cases
