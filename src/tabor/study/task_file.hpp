#pragma once

#include <string>

#include "tabor/study/record.hpp"

// Writes what the HDF5 files of the store have in common.
namespace tabor::study {

/// Opens a new file of the task that states its canonical text; `plotted` is the NeXus default
/// group.
io::Hdf5Writer task_writer(const engine::Store& store, const engine::Task& task,
                           const std::string& plotted);

struct MapName {
  const char* name;
  const char* unit;
  const char* long_name;
};

/// Writes a map as float32 with its unit and axes.
void write_map(io::Hdf5Writer& writer, const std::string& group, const MapName& name,
               const Field& map);

/// Write and read texts, codes and weights of warnings as attributes of a group.
void write_warnings(io::Hdf5Writer& writer, const std::string& path, const Warnings& warnings);
Warnings read_warnings(const io::Hdf5Reader& reader, const std::string& path);

void write_attributes(io::Hdf5Writer& writer, const std::string& path, const Scalars& scalars);

}  // namespace tabor::study
