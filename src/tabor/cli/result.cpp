#include "tabor/cli/result.hpp"

#include <ostream>

#include "tabor/core/printable.hpp"
#include "tabor/core/version.hpp"
#include "tabor/scan/file.hpp"

namespace tabor::cli {

namespace {

/// What belongs to numbers says to which; the rest are plain texts.
io::Json json_of(const results::Finding& finding) {
  if (finding.code.empty()) return finding.text;
  return {{"code", finding.code},
          {"class", cases::name_of(finding.kind())},
          {"text", finding.text},
          {"cases", finding.cases},
          {"n_cases", finding.n_cases}};
}

}  // namespace

io::Json json_head(const Context& context) {
  io::Json head = {{"tabor_version", kVersion}, {"command", context.command_line}};
  if (context.defaults.empty()) return head;
  io::Json used = io::Json::object();
  for (const auto& [flag, value] : context.defaults) {
    if (used.contains(flag)) {  // steps of one kind
      used[flag] = used[flag].get<std::string>() + " " + value;
    } else {
      used[flag] = value;
    }
  }
  head["defaults"] = {{"file", context.defaults_file}, {"used", used}};
  return head;
}

io::Json json_head(const Context& context, const Scan& scan) {
  io::Json object = json_head(context);
  object["scan"] = {{"path", scan.path}, {"sha256", scan.sha256}};
  object["treatment"] = scan.treatment;
  object["treatment_history"] = scan.surface.history;
  return object;
}

results::ResultHead head_of(const Context& context, const std::string& config_toml,
                            const std::vector<std::string>& methods) {
  return {.command = context.command_line, .config_toml = config_toml, .methods = methods};
}

io::Json json_warnings(const Context& context) {
  io::Json list = io::Json::array();
  for (const results::Finding& warning : context.warnings) list.push_back(json_of(warning));
  return list;
}

int finish(Context& context, io::Json object, const std::string& text, int code) {
  if (context.progress) context.progress->clear();
  if (context.json) {
    object["warnings"] = json_warnings(context);
    context.out << printable_json(io::to_text(object)) << '\n';
    return code;
  }
  context.out << printable_lines(text) << std::flush;
  for (const results::Finding& warning : context.warnings) {
    context.err << printable(Context::line_of(warning)) << '\n';
  }
  return code;
}

const std::vector<std::string>& hdf5_extensions() {
  static const std::vector<std::string> extensions = {".h5", ".hdf5"};
  return extensions;
}

std::vector<std::string> scan_extensions() {
  std::vector<std::string> extensions;
  for (const scan::FormatRow& row : scan::formats()) {
    if (!row.writes) continue;
    extensions.insert(extensions.end(), row.extensions.begin(), row.extensions.end());
  }
  return extensions;
}

void declare_template(OptionSet& set, const std::string& what, bool& target) {
  set.toggle(kTemplate, "print " + what + " and do nothing else", target);
}

int show_template(const std::string& text, Context& context) {
  io::Json object = json_head(context);
  object["template"] = text;
  return finish(context, object, text);
}

void declare_output(OptionSet& set, std::optional<std::string>& target) {
  set.group("Output");
  std::vector<std::string> extensions = hdf5_extensions();
  extensions.emplace_back(".vti");
  set.output("OUT.h5|OUT.vti",
             "save the maps of every state in an HDF5 file, or in a .vti for ParaView", extensions,
             target);
}

}  // namespace tabor::cli
