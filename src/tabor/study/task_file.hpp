#pragma once

#include <string>

#include "tabor/study/record.hpp"

// What the HDF5 files of the store have in common.
namespace tabor::study {

/// A new file of the task that states its canonical text; `plotted` is the NeXus default group.
io::Hdf5Writer task_writer(const Store& store, const Task& task, const std::string& plotted);

struct MapName {
  const char* name;
  const char* unit;
  const char* long_name;
};

/// Writes a map as float32 with its unit and axes.
void write_map(io::Hdf5Writer& writer, const std::string& group, const MapName& name,
               const Field& map);

/// Texts, codes and weights of warnings as attributes of a group, and back.
void write_warnings(io::Hdf5Writer& writer, const std::string& path,
                    const analysis::Warnings& warnings);
analysis::Warnings read_warnings(const io::Hdf5Reader& reader, const std::string& path);

void write_attributes(io::Hdf5Writer& writer, const std::string& path, const Scalars& scalars);

}  // namespace tabor::study
