#include "tabor/cli/result.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <ostream>

#include "tabor/core/error.hpp"
#include "tabor/core/printable.hpp"
#include "tabor/core/version.hpp"
#include "tabor/io/atomic_file.hpp"

namespace tabor::cli {

io::Json json_head(const Context& context) {
  return {{"tabor_version", kVersion}, {"command", context.command_line}};
}

io::Json json_head(const Context& context, const Scan& scan) {
  io::Json object = json_head(context);
  object["scan"] = {{"path", scan.path}, {"sha256", scan.sha256}};
  object["treatment"] = scan.treatment;
  object["treatment_history"] = scan.surface.history;
  return object;
}

int finish(Context& context, io::Json object, const std::string& text, int code) {
  if (context.progress) context.progress->clear();
  if (context.json) {
    object["warnings"] = context.warnings;
    context.out << printable_json(io::to_text(object)) << '\n';
    return code;
  }
  context.out << printable_lines(text) << std::flush;
  for (const std::string& warning : context.warnings) {
    context.err << "warning: " << printable(warning) << '\n';
  }
  return code;
}

void declare_output(OptionSet& set, std::optional<std::string>& target) {
  set.group("Output");
  set.text("--output", "OUT.h5", "keep the maps of every state in an HDF5 file", target)
      .short_flag = "-o";
}

void check_can_write(const std::filesystem::path& file) {
  const std::filesystem::path target = io::written_file(file);
  const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : ".";
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error)) {
    throw OutputError(fmt::format("{}: the folder {} does not exist; create it first",
                                  file.string(), folder.string()));
  }
  if (access(folder.c_str(), W_OK) != 0) {
    throw OutputError(fmt::format("{}: the folder {} cannot be written to; choose another name",
                                  file.string(), folder.string()));
  }
}

}  // namespace tabor::cli
