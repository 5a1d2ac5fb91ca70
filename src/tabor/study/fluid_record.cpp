#include "tabor/io/columns.hpp"
#include "tabor/io/hdf5/guard.hpp"
#include "tabor/results/fields_file.hpp"
#include "tabor/study/task_file.hpp"

namespace tabor::study {
namespace {

/// All but the maps.
cases::FluidRecord fluid_numbers(const io::Hdf5Reader& reader) {
  cases::FluidRecord record;
  io::read_attributes(reader, "/fluid", cases::fluid_columns(), record);
  if (reader.number("/fluid", "converged") != 0) {
    record.summary.convergence.status = Status::converged;
  }
  record.warnings = read_warnings(reader, "/fluid");
  return record;
}

/// All but the maps.
cases::TrappedRecord trapped_numbers(const io::Hdf5Reader& reader) {
  cases::TrappedRecord record;
  io::read_attributes(reader, "/trapped", cases::trapped_columns(), record);
  if (reader.number("/trapped", "converged") != 0) record.convergence.status = Status::converged;
  record.warnings = read_warnings(reader, "/trapped");
  return record;
}

}  // namespace

void write_trapped(const engine::Store& store, const engine::Task& task, const Grid& grid,
                   const cases::TrappedRecord& record, const Scalars& conditions) {
  const std::string group = "/trapped";
  io::Hdf5Writer writer = task_writer(store, task, "trapped");
  writer.axes(group, grid);
  for (const results::StateField& field : results::fields_of(record)) {
    write_map(writer, group, {field.name.c_str(), field.unit.c_str(), field.long_name.c_str()},
              field.map);
  }
  writer.nxdata(group, "liquid_pressure");
  write_attributes(writer, group, conditions);
  io::write_attributes(writer, group, cases::trapped_columns(), record);
  write_warnings(writer, group, record.warnings);
  writer.commit();
}

cases::TrappedRecord read_trapped(const engine::Store& store, const engine::Task& task) {
  return io::read_guarded(store.path(task), trapped_numbers);
}

void write_fluid(const engine::Store& store, const engine::Task& task, const Grid& grid,
                 const cases::FluidRecord& record, const Scalars& conditions) {
  const std::string group = "/fluid";
  io::Hdf5Writer writer = task_writer(store, task, "fluid");
  writer.axes(group, grid);
  const reynolds::PatchFilm& film = record.state.film;
  write_map(writer, group, {"fluid_pressure", "Pa", "pressure of the oil"}, film.pressure);
  write_map(writer, group, {"fluid_fill", "1", "share of the gap that oil fills while sliding"},
            film.fill);
  write_map(writer, group, {"fluid_gap", "m", "gap while sliding"}, record.state.contact.gap);
  writer.nxdata(group, "fluid_pressure");
  write_attributes(writer, group, conditions);
  io::write_attributes(writer, group, cases::fluid_columns(), record);
  write_warnings(writer, group, record.warnings);
  writer.commit();
}

cases::FluidRecord read_fluid(const engine::Store& store, const engine::Task& task) {
  return io::read_guarded(store.path(task), fluid_numbers);
}

}  // namespace tabor::study
