#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>

#include "tabor/cli/python_program.hpp"
#include "tabor/cli/result.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/io/files/subprocess.hpp"

namespace tabor::cli {

namespace {

struct Request {
  std::string result;
  bool no_html = false;
  bool is_static = false;
  bool all_scans = false;
  std::string error_bar;  ///< "" if not given
  std::optional<std::string> output;
  std::vector<std::string> passed_on;  ///< options with values, as tabor.report takes them
};

std::vector<std::string> python_words(const Request& request) {
  std::vector<std::string> words = isolated_python("report");
  words.push_back(request.result);
  words.insert(words.end(), request.passed_on.begin(), request.passed_on.end());
  if (request.output) words.push_back("--output=" + *request.output);
  if (!request.error_bar.empty()) words.push_back("--error-bar=" + request.error_bar);
  if (request.is_static) words.emplace_back("--static");
  if (request.no_html) words.emplace_back("--no-html");
  if (request.all_scans) words.emplace_back("--all-scans");
  return words;
}

/// The last line that the program wrote, without the name it gives itself.
std::string complaint_of(const std::string& output) {
  constexpr std::string_view name = "tabor report: ";
  std::string last;
  for (const std::string& line : split(output, '\n')) {
    if (!trim(line).empty()) last = line;
  }
  return last.starts_with(name) ? last.substr(name.size()) : last;
}

[[noreturn]] void reject(const Request& request, const io::Completed& done) {
  const bool wants_all = std::getenv("TABOR_TRACEBACK") != nullptr;
  const std::string complaint = wants_all ? done.output : complaint_of(done.output);
  if (done.exit_code == kUsage) throw UsageError(complaint);
  if (done.exit_code == kInput) throw InputError(complaint);
  if (done.exit_code == kOutput) throw OutputError(complaint);
  if (done.exit_code > 128) {
    throw InputError(
        request.result,
        fmt::format("the end of the drawing program by signal {}", done.exit_code - 128),
        "a result that can be drawn", "the file is damaged or memory ran out");
  }
  throw std::runtime_error("report: " + complaint);
}

/// Rejects the name of a page: a folder of that name would be made.
void check_folder(const std::string& output) {
  const std::string ending = std::filesystem::path(output).extension().string();
  if ((ending != ".html" && ending != ".htm") || std::filesystem::is_directory(output)) return;
  throw UsageError(fmt::format(
      "--output: got '{}'; expected a folder, in which the page is report.html", output));
}

int report(const Request& request, Context& context) {
  if (request.output) check_folder(*request.output);
  const auto may_stop = [observer = context.observer()] {
    report_progress(observer, "draw", std::nan(""));
  };
  const io::Completed done = io::run_program(python_program("report"), python_words(request), {},
                                             std::chrono::hours(1), may_stop);
  if (done.timed_out) {
    throw InputError("tabor report: drawing took more than an hour and was ended");
  }
  if (done.exit_code != 0) reject(request, done);
  io::Json object = json_head(context);
  object["files"] = io::Json::array();
  for (const std::string& line : split(done.output, '\n')) {
    if (!line.empty()) object["files"].push_back(line);
  }
  return finish(context, object, done.output);
}

using Check = std::function<std::string(const std::string&)>;

/// An option that tabor.report takes: `checked` gives the value in the form that it reads.
void pass_on(OptionSet& set, Request& request, const std::string& flag,
             const std::string& placeholder, const std::string& help, const Check& checked) {
  set.add({.flag = flag,
           .placeholder = placeholder,
           .help = help,
           .assign = [&request, flag, checked](const std::string& value) {
             request.passed_on.push_back(flag + "=" + checked(value));
           }});
}

Check in_unit(const std::string& flag, Dimension dimension, const std::string& unit) {
  return [=](const std::string& value) {
    const double factor = *unit_factor(unit, dimension);
    return fmt::format("{}{}", parse_si(value, dimension, flag) / factor, unit);
  };
}

std::string checked_scan(const std::string& value) {
  const std::optional<double> number = parse_number(value);
  if (!number || *number < 0 || *number > 1e9 || *number != std::floor(*number)) {
    throw UsageError(fmt::format("--scan: got '{}'; expected a whole number from 0", value));
  }
  return fmt::format("{:.0f}", *number);
}

std::string checked_formats(const std::string& value) {
  for (const std::string& format : split(value, ',')) {
    if (format != "png" && format != "svg" && format != "pdf") {
      throw UsageError(fmt::format(
          "--figures: got '{}'; expected png, svg, pdf or several of them, as png,svg", value));
    }
  }
  return value;
}

void declare_options(OptionSet& set, Request& request) {
  set.group("Report");
  set.input("RESULT", "folder of 'tabor sweep', or a file written with -o", request.result);
  Option& output =
      set.text("--output", "DIR", "folder of the page [beside the result]", request.output);
  output.short_flag = "-o";
  output.names = FileRole::folder;
  pass_on(set, request, "--figures", "FORMATS",
          "also write figures and their tables, as png, svg, pdf or a list such as png,svg",
          checked_formats);
  set.toggle("--static", "make a static page, as without Bokeh or Pillow", request.is_static);
  set.toggle("--no-html", "write figures and tables only [--figures png,svg]", request.no_html);
  set.group("Report of a study");
  pass_on(set, request, "--scan", "N", "number of the scan that the maps show, from 0",
          checked_scan);
  set.toggle("--all-scans", "show maps of every scan", request.all_scans);
  pass_on(set, request, "--pressure", "P",
          "pressure that the maps show (nearest computed), e.g. 7MPa",
          in_unit("--pressure", dimension::pressure, "Pa"));
  pass_on(set, request, "--density", "D",
          "lubricant density that the maps show (nearest computed), e.g. 0.45g/m^2",
          in_unit("--density", dimension::areal_density, "g/m^2"));
  set.choice("--error-bar", {"std", "sem"},
             "error bars show the standard deviation or the standard error of the mean [std]",
             request.error_bar);
}

}  // namespace

Verb report_verb() {
  return {.name = "report",
          .arguments = "RESULT [options]",
          .summary = "make one HTML page, and figures, from a study or a result file",
          .details =
              "The page is interactive if Bokeh and Pillow are installed, as by tools/quickstart, "
              "and static otherwise. It needs python3-numpy, python3-h5py, python3-matplotlib and "
              "python3-jinja2. TABOR_PYTHON chooses another interpreter, such as that of a "
              "virtual environment. tabor ignores PYTHONPATH, packages of the user and the "
              "current folder.",
          .examples = {"tabor report study_results",
                       "tabor report contact.h5 -o contact_page --figures png,pdf"},
          .declare = [](OptionSet& set) -> Action {
            const auto request = std::make_shared<Request>();
            declare_options(set, *request);
            return [request](Context& context) { return report(*request, context); };
          }};
}

}  // namespace tabor::cli
