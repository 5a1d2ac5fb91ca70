#include "tabor/study/unit_file.hpp"

#include "tabor/core/version.hpp"

namespace tabor::study {

io::Hdf5Writer unit_writer(const Store& store, const Unit& unit, const std::string& plotted) {
  io::Hdf5Writer writer(store.path(unit), io::Seal::yes);
  write_root(writer, plotted);
  writer.attribute("/", "canonical_text", unit.text);
  return writer;
}

void write_map(io::Hdf5Writer& writer, const std::string& group, const MapName& name,
               const Field& map) {
  const std::string path = group + "/" + name.name;
  writer.write(path, map, io::Precision::float32);
  writer.describe(path, name.unit, name.long_name);
  writer.attach_axes(path);
}

void write_attributes(io::Hdf5Writer& writer, const std::string& path, const Scalars& scalars) {
  for (const auto& [name, value] : scalars) {
    writer.attribute(path, name, value);
  }
}

void write_root(io::Hdf5Writer& writer, const std::string& default_group) {
  writer.attribute("/", "format", "tabor");
  writer.attribute("/", "format_version", 1);
  writer.attribute("/", "software_version", kVersion);
  writer.attribute("/", "default", default_group);
}

}  // namespace tabor::study
