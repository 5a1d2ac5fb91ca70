#include "tabor/cli/fields_file.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>

#include "tabor/core/version.hpp"
#include "tabor/io/columns.hpp"
#include "tabor/topography/surface_group.hpp"

namespace tabor::cli {

namespace {

std::string now_utc() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

}  // namespace

void write_result_head(io::Hdf5Writer& writer, const Context& context,
                       const std::string& config_toml, const std::vector<std::string>& methods) {
  writer.attribute("/", "format", "tabor");
  writer.attribute("/", "format_version", 1);
  writer.attribute("/", "software_version", kVersion);
  writer.attribute("/", "command", context.command_line);
  writer.attribute("/", "config_toml", config_toml);
  writer.attribute("/", "created", now_utc());
  writer.attribute("/", "methods", methods);
}

void write_warnings(io::Hdf5Writer& writer, const Context& context) {
  std::vector<std::string> lines;
  for (const analysis::Finding& warning : context.warnings) {
    lines.push_back(analysis::line_of(warning));
  }
  writer.attribute("/", "warnings", lines);
}

std::string toml_of(const io::Json& settings) {
  std::string text;
  // Numbers, strings and arrays are written alike in JSON and TOML.
  for (const auto& [key, value] : settings.items()) {
    if (!value.is_null()) text += key + " = " + io::to_text(value, -1) + '\n';
  }
  return text;
}

FieldsFile::FieldsFile(const std::filesystem::path& file, const Context& context, const Scan& scan,
                       const io::Json& settings, const std::vector<std::string>& methods)
    : writer_(file), grid_(scan.surface.grid) {
  write_root(context, scan, settings, methods);
  topography::write_surface_group(writer_, scan.surface, scan.path);
}

void FieldsFile::write_root(const Context& context, const Scan& scan, const io::Json& settings,
                            const std::vector<std::string>& methods) {
  write_result_head(writer_, context, toml_of(settings), methods);
  writer_.attribute("/", "input_sha256", scan.sha256);
  writer_.attribute("/", "default", "surface");
}

void FieldsFile::add_state(std::size_t number, const NamedCells& scalars,
                           const std::vector<StateField>& fields) {
  ++n_states_;
  const std::string group = fmt::format("/states/{:04}", number);
  writer_.group(group);
  writer_.axes(group, grid_);
  for (const StateField& field : fields) {
    const std::string path = group + "/" + field.name;
    writer_.write(path, field.map);
    writer_.describe(path, field.unit, field.long_name);
    writer_.attach_axes(path);
  }
  writer_.nxdata(group, fields.front().name);
  io::write_attributes(writer_, group, scalars);
}

void FieldsFile::commit(const Context& context) {
  if (n_states_ == 0) return;
  write_warnings(writer_, context);
  writer_.commit();
}

}  // namespace tabor::cli
