#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <ostream>

#include "tabor/cli/result.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/io/subprocess.hpp"

namespace tabor::cli {

namespace {

namespace fs = std::filesystem;

struct Request {
  std::string result;
  bool no_html = false;
  bool all_scans = false;
  std::vector<std::string> passed_on;  ///< options with values, as tabor_report takes them
};

// Debian's own interpreter first: that is where apt puts numpy, h5py and matplotlib.
fs::path python() {
  if (const char* chosen = std::getenv("TABOR_PYTHON")) return chosen;
  if (fs::exists("/usr/bin/python3")) return "/usr/bin/python3";
  if (const auto found = io::find_program("python3")) return *found;
  throw InputError("tabor report", "no python3", "Python 3.9 or newer", "apt install python3");
}

// Beside an installed program, or in the source tree this program was built from.
fs::path package_folder() {
  std::error_code error;
  const fs::path self = fs::read_symlink("/proc/self/exe", error);
  for (const fs::path& folder :
       {self.parent_path().parent_path() / "share/tabor/python", fs::path(TABOR_SOURCE_PYTHON)}) {
    if (fs::exists(folder / "tabor_report/__main__.py", error)) return folder;
  }
  throw InputError("tabor report", "no Python package tabor_report beside the program", "",
                   "install tabor with 'cmake --install'");
}

std::string python_path() {
  const char* inherited = std::getenv("PYTHONPATH");
  return package_folder().string() + (inherited ? std::string(":") + inherited : "");
}

int report(const Request& request, Context& context) {
  std::vector<std::string> arguments = {"-m", "tabor_report", request.result};
  arguments.insert(arguments.end(), request.passed_on.begin(), request.passed_on.end());
  if (request.no_html) arguments.emplace_back("--no-html");
  if (request.all_scans) arguments.emplace_back("--all-scans");
  const io::Completed done = io::run_program(
      python(), arguments, {{"PYTHONPATH", python_path()}, {"PYTHONDONTWRITEBYTECODE", "1"}},
      std::chrono::hours(1));
  if (done.timed_out)
    throw InputError("tabor report: drawing took more than an hour and was ended");
  if (done.exit_code != 0) {
    context.err << done.output;
    return done.exit_code == kUsage || done.exit_code == kInput || done.exit_code == kOutput
               ? done.exit_code
               : static_cast<int>(kInternal);
  }
  io::Json object = json_head(context);
  object["files"] = io::Json::array();
  for (const std::string& line : split(done.output, '\n')) {
    if (!line.empty()) object["files"].push_back(line);
  }
  return finish(context, object, done.output);
}

void pass_on(OptionSet& set, Request& request, const std::string& flag,
             const std::string& short_flag, const std::string& placeholder,
             const std::string& help) {
  set.add({.flag = flag,
           .short_flag = short_flag,
           .placeholder = placeholder,
           .help = help,
           .assign = [&request, flag](const std::string& value) {
             request.passed_on.push_back(flag + "=" + value);
           }});
}

void declare_options(OptionSet& set, Request& request) {
  set.group("Report");
  set.positional("RESULT", "folder of 'tabor sweep', or a file written with -o", request.result);
  pass_on(set, request, "--output", "-o", "DIR", "where to write [beside the result]");
  set.toggle("--no-html", "figures and tables only", request.no_html);
  pass_on(set, request, "--scan", "", "N", "scan that the maps show, counted from 0");
  set.toggle("--all-scans", "maps of every scan", request.all_scans);
  pass_on(set, request, "--pressure", "", "P", "pressure that the maps show (nearest computed)");
  pass_on(set, request, "--density", "", "D", "lubricant density that the maps show");
  pass_on(set, request, "--error-bar", "", "std|sem",
          "standard deviation or standard error of the mean [std]");
}

}  // namespace

Verb report_verb() {
  return {.name = "report",
          .arguments = "RESULT [options]",
          .summary = "figures and one self-contained HTML page from a study or a result file",
          .details =
              "Needs python3-numpy, python3-h5py, python3-matplotlib and python3-jinja2. "
              "TABOR_PYTHON chooses another interpreter.",
          .examples = {"tabor report study_results", "tabor report contact.h5 -o contact_page"},
          .declare = [](OptionSet& set) -> Action {
            const auto request = std::make_shared<Request>();
            declare_options(set, *request);
            return [request](Context& context) { return report(*request, context); };
          }};
}

}  // namespace tabor::cli
