#include <fmt/format.h>

#include <memory>

#include "tabor/cases/tool.hpp"
#include "tabor/cli/contact_request.hpp"
#include "tabor/cli/parameter_options.hpp"
#include "tabor/cli/python_program.hpp"
#include "tabor/cli/result.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/io/files/subprocess.hpp"
#include "tabor/scan/read_parameters.hpp"
#include "tabor/topography/treatment.hpp"

namespace tabor::cli {

namespace {

struct Request {
  ScanRequest scan;
  std::vector<std::string> files;
  std::vector<std::string> reading;  ///< options of it, as tabor.view takes them
  cases::ToolSettings tool;
  std::vector<std::string> settings;  ///< "tool_repeats=True", by their names in Python
  std::uint64_t port = 0;
  bool no_browser = false;
  bool keep = false;
};

bool is_reading(const Option& option) { return option.group == scan::kReadingGroup; }

/// Options of reading are checked here, and passed on as they were written.
void declare_files(OptionSet& set, Request& request) {
  OptionSet scans;
  declare_scans(scans, request.scan, request.files);
  for (Option option : scans.options()) {
    if (is_reading(option)) {
      option.assign = [&request, option](const std::string& value) {
        option.assign(value);
        request.reading.push_back(option.is_switch() ? option.flag : option.flag + "=" + value);
      };
    }
    set.add(option);
  }
}

/// Options of the tool are checked here, and passed on with their names.
void declare_tool(OptionSet& set, Request& request) {
  set.group("Tool");
  for (const auto& parameter : cases::tool_parameters()) {
    if (parameter.name == "tool_places") continue;  // of studies and friction: a page has one
    Option& option = declare(set, parameter, request.tool);
    option.assign = [&request, check = option.assign, name = parameter.name,
                     is_switch = option.is_switch()](const std::string& value) {
      check(value);
      request.settings.push_back(fmt::format("{}={}", name, is_switch ? "True" : value));
    };
  }
}

std::vector<std::string> python_words(const Request& request, const Context& context) {
  std::vector<std::string> words = isolated_python("view");
  words.insert(words.end(), request.reading.begin(), request.reading.end());
  for (const std::string& step : request.scan.treatment) words.push_back("--step=" + step);
  for (const std::string& one : request.settings) words.push_back("--setting=" + one);
  if (context.seed) words.push_back(fmt::format("--setting=seed={}", *context.seed));
  words.push_back(fmt::format("--port={}", request.port));
  words.push_back(fmt::format("--threads={}", context.threads));
  if (request.no_browser) words.emplace_back("--no-browser");
  if (request.keep) words.emplace_back("--keep");
  if (context.json) words.push_back("--json-head=" + io::to_text(json_head(context)));
  words.emplace_back("--");
  words.insert(words.end(), request.files.begin(), request.files.end());
  return words;
}

int view(const Request& request, Context& context) {
  constexpr std::uint64_t last_port = 65535;
  if (request.port > last_port) {
    throw UsageError(fmt::format("--port: got {}; expected at most {}", request.port, last_port));
  }
  check(request.scan);
  check(cases::objection(request.tool, flag_of));
  cases::ToolSettings tool = request.tool;
  cases::find_tool(tool, {});  // the page reads it again
  io::become_program(python_program("view"), python_words(request, context));
}

void declare_options(OptionSet& set, Request& request) {
  set.group("View");
  set.count("--port", "port of 127.0.0.1 [0: any free one]", request.port);
  set.toggle("--no-browser", "print the address and do not open a browser", request.no_browser);
  set.toggle("--keep", "keep running when the last page closes", request.keep);
}

}  // namespace

Verb view_verb() {
  return {
      .name = "view",
      .arguments = "SCAN... [options]",
      .summary = "open a workbench for scans in the browser",
      .details =
          "tabor serves a page on 127.0.0.1 alone and prints its address with a random token. "
          "Nothing leaves this machine. The page shows scans, their treatment, contact, oil and "
          "friction, and writes the command line, the Python program and the study file with the "
          "same numbers. The program ends when the last page closes. It needs the Python package "
          "of tabor and Bokeh (docs/view.md). TABOR_PYTHON chooses the interpreter, such as that "
          "of a virtual environment.",
      .examples = {"tabor view surfaces/edt_before.x3p",
                   "tabor view surfaces/edt_before.x3p surfaces/edt_after.x3p --recipe sheet "
                   "--no-browser"},
      .declare = [](OptionSet& set) -> Action {
        const auto request = std::make_shared<Request>();
        declare_files(set, *request);
        declare_tool(set, *request);
        declare_options(set, *request);
        return [request](Context& context) { return view(*request, context); };
      }};
}

}  // namespace tabor::cli
