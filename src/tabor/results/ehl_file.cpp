#include "tabor/results/ehl_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <string>
#include <variant>

#include "tabor/io/columns.hpp"
#include "tabor/results/fields_file.hpp"

namespace tabor::results {
namespace {

/// Numbers of an object in the record, "wear.time_s", in a group of their own; those that are not
/// known are left out.
void write_numbers(io::Hdf5Writer& writer, const std::string& group, const NamedCells& numbers) {
  writer.group(group);
  std::map<std::string, NamedCells> objects;
  NamedCells own;
  for (const NamedCell& one : numbers) {
    const std::size_t dot = one.head.key.find('.');
    const auto* const number = std::get_if<double>(&one.cell);
    if (number != nullptr && !std::isfinite(*number)) continue;
    NamedCells& place = dot == std::string::npos ? own : objects[one.head.key.substr(0, dot)];
    place.push_back(one);
    if (dot != std::string::npos) place.back().head.key.erase(0, dot + 1);
  }
  io::write_attributes(writer, group, own);
  for (const auto& [name, cells] : objects) {
    write_numbers(writer, fmt::format("{}/{}", group, name), cells);
  }
}

}  // namespace

void write_case(const std::filesystem::path& file, const std::string& command,
                const ehl::Program& program, const io::Config& config,
                const ehl::CaseResult& result, const std::vector<Finding>& warnings) {
  io::Hdf5Writer writer(file);
  write_result_head(writer, {command, config.to_text(), program.methods});
  writer.attribute("/", "kind", "ehl " + program.name);
  write_numbers(writer, "/result", result.numbers);
  std::vector<ColumnHead> heads;
  heads.reserve(result.numbers.size());
  for (const NamedCell& number : result.numbers) heads.push_back(number.head);
  io::write_column_table(writer, heads);
  write_warnings(writer, warnings);
  if (result.write) result.write(writer);
  writer.commit();
}

}  // namespace tabor::results
