#include "tabor/io/columns.hpp"
#include "tabor/results/fields_file.hpp"
#include "tabor/study/task_file.hpp"

// Stores what oil does in a contact beside wetting: trapped, or flowing.
namespace tabor::study {
namespace {

/// Writes a file with one group: numbers, and maps for the report.
template <typename Record>
void write_oil(const engine::Store& store, const engine::Task& task, const std::string& name,
               const Grid& grid, const std::vector<results::StateField>& fields,
               const Columns<Record>& columns, const Record& record, const Scalars& conditions) {
  const std::string group = "/" + name;
  io::Hdf5Writer writer = task_writer(store, task, name);
  writer.axes(group, grid);
  for (const results::StateField& field : fields) {
    write_map(writer, group, {field.name.c_str(), field.unit.c_str(), field.long_name.c_str()},
              field.map);
  }
  writer.nxdata(group, fields.front().name);
  write_attributes(writer, group, conditions);
  io::write_attributes(writer, group, columns, record);
  write_warnings(writer, group, record.warnings);
  writer.commit();
}

/// Reads all but the maps. `convergence`: member of the record that says whether it converged.
template <typename Record, typename Access>
Record read_oil(const engine::Store& store, const engine::Task& task, const std::string& name,
                const Columns<Record>& columns, const Access& convergence) {
  return read_task(store, task, [&](const io::Hdf5Reader& reader) {
    const std::string group = "/" + name;
    Record record;
    io::read_attributes(reader, group, columns, record);
    if (reader.number(group, "converged") != 0) convergence(record).status = Status::converged;
    record.warnings = read_warnings(reader, group);
    return record;
  });
}

}  // namespace

void write_trapped(const engine::Store& store, const engine::Task& task, const Grid& grid,
                   const cases::TrappedRecord& record, const Scalars& conditions) {
  write_oil(store, task, "trapped", grid, results::fields_of(record), cases::trapped_columns(),
            record, conditions);
}

cases::TrappedRecord read_trapped(const engine::Store& store, const engine::Task& task) {
  return read_oil(
      store, task, "trapped", cases::trapped_columns(),
      [](cases::TrappedRecord & record) -> auto& { return record.convergence; });
}

void write_fluid(const engine::Store& store, const engine::Task& task, const Grid& grid,
                 const cases::FluidRecord& record, const Scalars& conditions) {
  std::vector<results::StateField> fields;
  for (const results::StateField& field : results::fields_of(record)) {
    if (field.name != "fluid_solid_pressure") fields.push_back(field);  // no page draws it
  }
  write_oil(store, task, "fluid", grid, fields, cases::fluid_columns(), record, conditions);
}

cases::FluidRecord read_fluid(const engine::Store& store, const engine::Task& task) {
  return read_oil(
      store, task, "fluid", cases::fluid_columns(),
      [](cases::FluidRecord & record) -> auto& { return record.summary.convergence; });
}

}  // namespace tabor::study
