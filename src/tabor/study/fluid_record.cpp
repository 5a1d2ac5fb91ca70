#include "tabor/analysis/warnings.hpp"
#include "tabor/io/columns.hpp"
#include "tabor/io/hdf5_guard.hpp"
#include "tabor/study/task_file.hpp"

namespace tabor::study {
namespace {

/// All but the maps.
analysis::FluidRecord fluid_numbers(const io::Hdf5Reader& reader) {
  analysis::FluidRecord record;
  io::read_attributes(reader, "/fluid", analysis::fluid_columns(), record);
  if (reader.number("/fluid", "converged") != 0) {
    record.summary.convergence.status = Status::converged;
  }
  record.warnings = analysis::of_flow(reader.attribute_texts("/fluid", "warnings"));
  return record;
}

std::vector<std::string> texts_of(const analysis::Warnings& warnings) {
  std::vector<std::string> texts;
  for (const analysis::Warning& warning : warnings) texts.push_back(warning.text);
  return texts;
}

}  // namespace

void write_fluid(const Store& store, const Task& task, const Grid& grid,
                 const analysis::FluidRecord& record, const Scalars& conditions) {
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
  io::write_attributes(writer, group, analysis::fluid_columns(), record);
  writer.attribute(group, "warnings", texts_of(record.warnings));
  writer.commit();
}

analysis::FluidRecord read_fluid(const Store& store, const Task& task) {
  return io::read_guarded(store.path(task), fluid_numbers);
}

}  // namespace tabor::study
