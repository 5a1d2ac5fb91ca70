#include "tabor/results/fields_file.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <iterator>

#include "tabor/cases/parameters.hpp"
#include "tabor/cases/states.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/core/version.hpp"
#include "tabor/io/columns.hpp"
#include "tabor/results/result_maps.hpp"
#include "tabor/topography/surface_group.hpp"

namespace tabor::results {

namespace {

std::string now_utc() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

std::vector<StateField> kept_of(const std::vector<StateField>& fields, Fields wanted) {
  std::vector<StateField> kept;
  std::copy_if(fields.begin(), fields.end(), std::back_inserter(kept), [&](const StateField& one) {
    const bool is_contact =
        one.name == "pressure" || one.name == "film_thickness" || one.name == "sheet";
    return wanted == Fields::all || (wanted == Fields::contact && is_contact);
  });
  return kept;
}

bool is_vti(const std::filesystem::path& file) {
  return lower(file.extension().string()) == ".vti";
}

}  // namespace

std::string state_group(std::size_t number) { return fmt::format("/states/{:04}", number); }

void write_result_head(io::Hdf5Writer& writer, const ResultHead& head) {
  writer.attribute("/", "format", "tabor");
  writer.attribute("/", "format_version", kFormatVersion);
  writer.attribute("/", "software_version", kVersion);
  writer.attribute("/", "command", head.command);
  writer.attribute("/", "config_toml", head.config_toml);
  writer.attribute("/", "created", now_utc());
  writer.attribute("/", "methods", head.methods);
}

void write_warnings(io::Hdf5Writer& writer, const std::vector<Finding>& warnings) {
  std::vector<std::string> lines, classes;
  for (const Finding& warning : warnings) {
    lines.push_back(line_of(warning));
    classes.emplace_back(name_of(warning.kind()));
  }
  writer.attribute("/", "warnings", lines);
  writer.attribute("/", "warning_classes", classes);
}

io::Json settings_json(const cases::ContactSettings& settings) {
  io::Json object = io::Json::object();
  if (!settings.material.empty()) object["material"] = settings.material;
  object.update(io::json_of(columns_of(cases::contact_parameters()), settings));
  if (!settings.tool.is_rough()) {
    for (const ParameterHead& one : cases::tool_parameters()) object.erase(one.json_key());
  }
  object["effective_modulus_Pa"] = settings.effective_modulus();
  object["threads"] = thread_count();
  return object;
}

io::Json settings_json(const cases::FilmSettings& settings) {
  return io::json_of(columns_of(cases::film_parameters()), settings);
}

io::Json settings_json(const cases::FluidSettings& settings) {
  return settings.flows() ? io::json_of(columns_of(cases::fluid_parameters()), settings)
                          : io::Json::object();
}

io::Json settings_json(const cases::CaseSettings& settings) {
  io::Json all = settings_json(settings.contact);
  all.update(settings_json(settings.film));
  if (settings.trapped.is_asked()) {
    all.update(io::json_of(columns_of(cases::trapped_parameters()), settings.trapped));
  }
  all.update(settings_json(settings.fluid));
  all.update(io::json_of(columns_of(cases::friction_parameters()), settings.friction));
  all["area"] = friction::kAreas.of(settings.friction.area_of(settings.contact));
  return all;
}

io::Json settings_json(const cases::CaseSettings& settings, const cases::SlideSettings& sliding) {
  io::Json all = settings_json(settings);
  all.update(io::json_of(columns_of(cases::slide_parameters()), sliding));
  if (settings.film.lubricant_densities.empty()) {
    for (const ParameterHead& one : cases::film_parameters()) all.erase(one.json_key());
    all.erase("liquid");
  }
  return all;
}

std::string toml_of(const io::Json& settings) {
  std::string text;
  // Numbers, strings and arrays are written alike in JSON and TOML.
  for (const auto& [key, value] : settings.items()) {
    if (!value.is_null()) text += key + " = " + io::to_text(value, -1) + '\n';
  }
  return text;
}

std::string density_text(double density) { return plain(in_g_per_m2(density)) + " g/m^2"; }

Case case_of(const cases::ContactRecord& record) {
  return {.pressure = si(record.summary.mean_pressure, "Pa"), .warnings = record.warnings};
}

Case case_of(const cases::FilmRecord& record) {
  return {.density = density_text(record.lubricant_density), .warnings = record.warnings};
}

Case case_of(const cases::FrictionRecord& record) {
  return {.pressure = si(record.mean_pressure, "Pa"),
          .density = density_text(record.lubricant_density),
          .warnings = record.warnings};
}

FieldsFile::FieldsFile(const std::filesystem::path& file, const FieldsOptions& options,
                       const ResultHead& head, const topography::Topography& surface,
                       const ScanOrigin& origin)
    : file_(file), writer_(file), grid_(surface.grid), options_(options) {
  if (is_vti(file) && options_.fields == Fields::none) {
    throw InputError(file.string(), "no maps", "fields 'contact' or 'all': a .vti holds maps alone",
                     "");
  }
  write_result_head(writer_, head);
  writer_.attribute("/", "input_sha256", origin.sha256);
  if (options_.fields == Fields::none) return;
  writer_.attribute("/", "default", "surface");
  topography::write_surface_group(writer_, surface, origin.path, precision());
}

io::Precision FieldsFile::precision() const {
  return options_.doubles ? io::Precision::float64 : io::Precision::float32;
}

/// The same coordinates serve all states: only their links are many.
void FieldsFile::write_axes(const std::string& group) {
  const auto [first, is_first] = stored_.try_emplace("axes", group);
  if (is_first) {
    writer_.axes(group, grid_);
    return;
  }
  for (const char* axis : {"/x", "/y"}) writer_.link(group + axis, first->second + axis);
}

/// True for a map to be written; makes a second name for one that is in the file.
bool FieldsFile::is_first(const std::string& name, const std::string& owner,
                          const std::string& path) {
  if (owner.empty()) return true;
  const auto [first, is_new] = stored_.try_emplace(name + ' ' + owner, path);
  if (!is_new) writer_.link(path, first->second);
  return is_new;
}

void FieldsFile::write_map(const std::string& group, const StateField& field) {
  const std::string path = group + "/" + field.name;
  if (!is_first(field.name, field.owner, path)) return;
  writer_.write(path, field.map, precision());
  writer_.describe(path, field.unit, field.long_name);
  writer_.attach_axes(path);
}

void FieldsFile::add_state(std::size_t number, const NamedCells& scalars,
                           const std::vector<StateField>& fields) {
  ++n_states_;
  for (const NamedCell& scalar : scalars) heads_.push_back(scalar.head);
  const std::string group = state_group(number);
  writer_.group(group);
  const std::vector<StateField> kept = kept_of(fields, options_.fields);
  if (!kept.empty()) {
    write_axes(group);
    for (const StateField& field : kept) write_map(group, field);
    writer_.nxdata(group, kept.front().name);
  }
  io::write_attributes(writer_, group, scalars);
}

void FieldsFile::commit(const std::vector<Finding>& warnings) {
  if (n_states_ == 0) return;
  io::write_column_table(writer_, heads_);
  write_warnings(writer_, warnings);
  if (!is_vti(file_)) return writer_.commit();
  const std::filesystem::path& maps = writer_.close();
  scan::write(chosen_maps(read_result_maps(io::Hdf5Reader(maps), maps), {.state = std::nullopt}),
              file_);
}

}  // namespace tabor::results
