#include "tabor/study/task_file.hpp"

#include <fmt/format.h>

#include "tabor/cases/warnings.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/version.hpp"

namespace tabor::study {

io::Hdf5Writer task_writer(const engine::Store& store, const engine::Task& task,
                           const std::string& plotted) {
  io::Hdf5Writer writer(store.path(task), io::Seal::yes);
  write_root(writer, plotted);
  writer.attribute("/", "canonical_text", task.text);
  return writer;
}

void write_map(io::Hdf5Writer& writer, const std::string& group, const MapName& name,
               const Field& map) {
  const std::string path = group + "/" + name.name;
  writer.write(path, map, io::Precision::float32);
  writer.describe(path, name.unit, name.long_name);
  writer.attach_axes(path);
}

void write_warnings(io::Hdf5Writer& writer, const std::string& path, const Warnings& warnings) {
  std::vector<std::string> texts, codes, weights;
  for (const Warning& warning : warnings) {
    texts.push_back(warning.text);
    codes.push_back(warning.code);
    weights.push_back(fmt::format("{:.17g}", warning.weight));
  }
  writer.attribute(path, "warnings", texts);
  writer.attribute(path, "warning_codes", codes);
  writer.attribute(path, "warning_weights", weights);
}

Warnings read_warnings(const io::Hdf5Reader& reader, const std::string& path) {
  const auto texts = reader.attribute_texts(path, "warnings");
  if (!reader.has_attribute(path, "warning_codes")) {  // a film that flows, of earlier versions
    Warnings of_flow;
    for (const std::string& text : texts) of_flow.push_back({"fluid-film", text});
    return of_flow;
  }
  const auto codes = reader.attribute_texts(path, "warning_codes");
  const auto weights = reader.attribute_texts(path, "warning_weights");
  if (codes.size() != texts.size() || weights.size() != texts.size()) {
    throw InputError(path + ": its warnings are not complete");
  }
  Warnings warnings;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    warnings.push_back({codes[i], texts[i], parse_number(weights[i]).value_or(0)});
  }
  return warnings;
}

void write_attributes(io::Hdf5Writer& writer, const std::string& path, const Scalars& scalars) {
  for (const auto& [name, value] : scalars) writer.attribute(path, name, value);
}

void write_root(io::Hdf5Writer& writer, const std::string& default_group) {
  writer.attribute("/", "format", "tabor");
  writer.attribute("/", "format_version", kFormatVersion);
  writer.attribute("/", "software_version", kVersion);
  writer.attribute("/", "default", default_group);
}

}  // namespace tabor::study
