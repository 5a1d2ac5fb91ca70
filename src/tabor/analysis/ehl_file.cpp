#include "tabor/analysis/ehl_file.hpp"

#include <fmt/format.h>

#include "tabor/analysis/fields_file.hpp"
#include "tabor/io/columns.hpp"

namespace tabor::analysis {
namespace {

/// Objects in it as groups of their own.
void write_result(io::Hdf5Writer& writer, const std::string& group, const io::Json& scalars) {
  writer.group(group);
  io::write_members(writer, group, scalars);
  for (const auto& [key, value] : scalars.items()) {
    if (value.is_object()) write_result(writer, fmt::format("{}/{}", group, key), value);
  }
}

}  // namespace

void write_case(const std::filesystem::path& file, const std::string& command,
                const ehl::Program& program, const io::Config& config,
                const ehl::CaseResult& result, const std::vector<Finding>& warnings) {
  io::Hdf5Writer writer(file);
  write_result_head(writer, {command, config.to_text(), program.methods});
  writer.attribute("/", "kind", "ehl " + program.name);
  write_result(writer, "/result", result.scalars);
  write_warnings(writer, warnings);
  if (result.write) result.write(writer);
  writer.commit();
}

}  // namespace tabor::analysis
