#include "tabor/cli/fields_file.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <iterator>

#include "tabor/core/version.hpp"
#include "tabor/io/columns.hpp"
#include "tabor/topography/surface_group.hpp"

namespace tabor::cli {

namespace {

std::string now_utc() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

constexpr const char* kFile = "--output";

std::vector<StateField> kept_of(const std::vector<StateField>& fields, Fields wanted) {
  std::vector<StateField> kept;
  std::copy_if(fields.begin(), fields.end(), std::back_inserter(kept), [&](const StateField& one) {
    const bool is_contact = one.name == "pressure" || one.name == "film_thickness";
    return wanted == Fields::all || (wanted == Fields::contact && is_contact);
  });
  return kept;
}

}  // namespace

void write_result_head(io::Hdf5Writer& writer, const Context& context,
                       const std::string& config_toml, const std::vector<std::string>& methods) {
  writer.attribute("/", "format", "tabor");
  writer.attribute("/", "format_version", kFormatVersion);
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

void declare_fields(OptionSet& set, FieldsRequest& request) {
  declare_output(set, request.output);
  set.choice("--fields", kFields, "maps in OUT.h5: contact has heights, pressure and film [all]",
             request.fields)
      .only_with = kFile;
  set.toggle("--double", "keep maps in OUT.h5 in double precision", request.doubles).only_with =
      kFile;
}

FieldsFile::FieldsFile(const FieldsRequest& request, const Context& context, const Scan& scan,
                       const io::Json& settings, const std::vector<std::string>& methods)
    : writer_(request.output.value()),
      grid_(scan.surface.grid),
      fields_(request.fields),
      precision_(request.doubles ? io::Precision::float64 : io::Precision::float32) {
  write_root(context, scan, settings, methods);
  if (fields_ == Fields::none) return;
  topography::write_surface_group(writer_, scan.surface, scan.path, precision_);
}

void FieldsFile::write_root(const Context& context, const Scan& scan, const io::Json& settings,
                            const std::vector<std::string>& methods) {
  write_result_head(writer_, context, toml_of(settings), methods);
  writer_.attribute("/", "input_sha256", scan.sha256);
  if (fields_ != Fields::none) writer_.attribute("/", "default", "surface");
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

void FieldsFile::write_map(const std::string& group, const StateField& field) {
  const std::string path = group + "/" + field.name;
  if (!field.owner.empty()) {
    const auto [first, is_first] = stored_.try_emplace(field.name + ' ' + field.owner, path);
    if (!is_first) return writer_.link(path, first->second);
  }
  writer_.write(path, field.map, precision_);
  writer_.describe(path, field.unit, field.long_name);
  writer_.attach_axes(path);
}

void FieldsFile::add_state(std::size_t number, const NamedCells& scalars,
                           const std::vector<StateField>& fields) {
  ++n_states_;
  const std::string group = fmt::format("/states/{:04}", number);
  writer_.group(group);
  const std::vector<StateField> kept = kept_of(fields, fields_);
  if (!kept.empty()) {
    write_axes(group);
    for (const StateField& field : kept) write_map(group, field);
    writer_.nxdata(group, kept.front().name);
  }
  io::write_attributes(writer_, group, scalars);
}

void FieldsFile::commit(const Context& context) {
  if (n_states_ == 0) return;
  write_warnings(writer_, context);
  writer_.commit();
}

}  // namespace tabor::cli
