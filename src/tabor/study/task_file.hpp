#pragma once

#include <string>

#include "tabor/study/record.hpp"

// Writes and reads what the HDF5 files of the store have in common.
namespace tabor::study {

/// Opens a new file of the task that states its canonical text; `plotted` is the NeXus default
/// group.
io::Hdf5Writer task_writer(const engine::Store& store, const engine::Task& task,
                           const std::string& plotted);

/// Returns what `read` makes of the HDF5 file of a task. It needs no guard (io/hdf5/guard.hpp), as
/// files from elsewhere do: this process has written the file, or defect() has found every byte of
/// it to be what was sealed.
template <typename Read>
auto read_task(const engine::Store& store, const engine::Task& task, const Read& read) {
  return read(io::Hdf5Reader(store.path(task)));
}

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
