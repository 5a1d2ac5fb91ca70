#include "tabor/cli/ehl.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <memory>

#include "tabor/cli/ehl_sweep.hpp"
#include "tabor/cli/fields_file.hpp"
#include "tabor/cli/result.hpp"
#include "tabor/cli/table.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"

namespace tabor::cli {

namespace {

struct Request {
  std::string program;
  std::string file;
  std::vector<SweepAxis> axes;
  std::optional<std::string> study;
  std::optional<std::string> output;
};

const std::vector<EhlProgram>& programs() {
  static const std::vector<EhlProgram> all = {impact_program(), squeeze_program(), line_program()};
  return all;
}

const EhlProgram& find_program(const std::string& name) {
  std::vector<std::string> names;
  for (const EhlProgram& program : programs()) {
    if (program.name == name) return program;
    names.push_back(program.name);
  }
  throw UsageError(fmt::format("unknown program '{}'{}; expected {}; see 'tabor ehl --help'", name,
                               suggestion(name, names), fmt::join(names, " or ")));
}

const EhlStudy& find_study(const EhlProgram& program, const std::string& name) {
  std::vector<std::string> names;
  for (const EhlStudy& study : program.studies) {
    if (study.name == name) return study;
    names.push_back(study.name);
  }
  throw UsageError(fmt::format("--study '{}'{}; 'tabor ehl {}' knows {}", name,
                               suggestion(name, names), program.name,
                               names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

double number_of(const io::Json& scalars, const std::string& key) {
  const auto found = scalars.find(key);
  const bool is_number = found != scalars.end() && found->is_number();
  return is_number ? found->get<double>() : std::numeric_limits<double>::quiet_NaN();
}

std::string cell(const io::Json& scalars, const EhlColumn& column) {
  const double value = number_of(scalars, column.key);
  return column.unit.empty() ? plain(value) : si(value, column.unit);
}

/// The case with one combination of the swept values.
io::Config case_at(const io::Config& config, const std::vector<SweepAxis>& axes,
                   const std::vector<std::size_t>& places) {
  io::Config changed = config;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    changed = changed.with(axes[i].key, axes[i].values[places[i]]);
  }
  return changed;
}

EhlAnswer solve(const EhlProgram& program, const io::Config& config, Context& context) {
  config.reject_unknown(program.keys);
  return program.solve(config, context);
}

/// The same inside a sweep, where a case that makes no sense is a row like another.
EhlAnswer solve_or_refuse(const EhlProgram& program, const io::Config& config, Context& context) {
  config.reject_unknown(program.keys);
  try {
    return program.solve(config, context);
  } catch (const InputError& error) {
    return {.scalars = {{"refused", error.what()}, {"converged", false}},
            .text = "",
            .warnings = {std::string("refused: ") + error.what()}};
  }
}

/// One line for the warnings of many cases; the JSON object has them all.
void warn_of_many(const io::Json& results, Context& context) {
  std::size_t n_doubtful = 0;
  for (const io::Json& result : results) n_doubtful += result.at("warnings").empty() ? 0 : 1;
  if (n_doubtful == 0) return;
  context.warn(fmt::format("{} of {} cases come with warnings of their own; --json lists them",
                           n_doubtful, results.size()));
}

int code_of(bool converged) { return converged ? kDone : kNotConverged; }

int show_one(const EhlProgram& program, const io::Config& config, const Request& request,
             Context& context) {
  const EhlAnswer answer = solve(program, config, context);
  for (const std::string& warning : answer.warnings) context.warn(warning);
  if (request.output) {
    io::Hdf5Writer writer(*request.output);
    write_result_head(writer, context, config.to_text(), program.methods);
    writer.attribute("/", "kind", "ehl " + program.name);
    writer.group("/result");
    write_scalars(writer, "/result", answer.scalars);
    if (answer.write) answer.write(writer);
    writer.commit();
  }
  io::Json object = json_head(context);
  object["case"] = request.file;
  object.update(answer.scalars);
  return finish(context, object, answer.text, code_of(answer.converged));
}

/// Numbers of all cases of a sweep, one array per axis and column.
void write_sweep(const EhlProgram& program, const io::Config& config, const Request& request,
                 const std::vector<SweepAxis>& ranges, const io::Json& results,
                 const Context& context) {
  io::Hdf5Writer writer(*request.output);
  write_result_head(writer, context, config.to_text(), program.methods);
  writer.attribute("/", "kind", "ehl " + program.name + " sweep");
  writer.group("/sweep/axes");
  std::vector<std::string> keys;
  std::vector<std::int64_t> shape;
  for (const SweepAxis& axis : ranges) {
    keys.push_back(axis.key);
    shape.push_back(static_cast<std::int64_t>(axis.values.size()));
    writer.write("/sweep/axes/" + axis.key, axis.numbers());
    writer.describe("/sweep/axes/" + axis.key, "SI", axis.key);
  }
  writer.attribute("/sweep", "axes", keys);  // the last one fastest
  writer.write("/sweep/shape", shape);
  for (const EhlColumn& column : program.columns) {
    std::vector<double> values;
    for (const io::Json& result : results) values.push_back(number_of(result, column.key));
    writer.write("/sweep/" + column.key, values);
    writer.describe("/sweep/" + column.key, column.unit, column.heading);
  }
  writer.commit();
}

int show_sweep(const EhlProgram& program, const io::Config& config, const Request& request,
               Context& context) {
  std::vector<SweepAxis> ranges;
  std::vector<std::string> headings;
  for (const SweepAxis& axis : request.axes) {
    if (!axis.is_range) continue;
    ranges.push_back(axis);
    headings.push_back(axis.key);
  }
  for (const EhlColumn& column : program.columns) headings.push_back(column.heading);
  headings.emplace_back("converged");
  Table table(headings);
  io::Json results = io::Json::array();
  bool converged = true;
  const auto all = combinations(ranges);
  for (const std::vector<std::size_t>& places : all) {
    report_progress(context.observer(), "sweep",
                    static_cast<double>(results.size()) / static_cast<double>(all.size()));
    const EhlAnswer answer = solve_or_refuse(program, case_at(config, ranges, places), context);
    io::Json result = {{"set", io::Json::object()}};
    std::vector<std::string> cells;
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      cells.push_back(ranges[i].values[places[i]]);
      result["set"][ranges[i].key] = ranges[i].values[places[i]];
    }
    for (const EhlColumn& column : program.columns) cells.push_back(cell(answer.scalars, column));
    cells.push_back(yes_no(answer.converged));
    table.row(cells);
    result.update(answer.scalars);
    result["warnings"] = answer.warnings;
    results.push_back(result);
    converged = converged && answer.converged;
  }
  warn_of_many(results, context);
  if (request.output) write_sweep(program, config, request, ranges, results, context);
  io::Json object = json_head(context);
  object["case"] = request.file;
  object["results"] = results;
  object["converged"] = converged;
  return finish(context, object, table.text(), code_of(converged));
}

/// The limit of three values whose errors fall geometrically; NaN where they do not.
double limit_of(double first, double second, double third) {
  const double before = second - first;
  const double after = third - second;
  if (std::abs(after) <= 1e-9 * std::abs(third)) return third;
  const double ratio = after / before;
  if (!(std::abs(ratio) < 0.9)) return std::numeric_limits<double>::quiet_NaN();
  return third + after * ratio / (1 - ratio);
}

int show_study(const EhlProgram& program, const io::Config& config, const Request& request,
               Context& context) {
  const EhlStudy& study = find_study(program, *request.study);
  const EhlAnswer usual = solve(program, config, context);
  const double value = number_of(usual.scalars, study.scalar);
  if (!std::isfinite(value)) {
    throw InputError("--study " + study.name, "a case that has no " + study.key, "", "");
  }
  std::vector<std::string> headings = {study.key};
  for (const EhlColumn& column : program.columns) headings.push_back(column.heading);
  Table table(headings);
  io::Json results = io::Json::array();
  bool converged = true;
  for (const double factor : study.factors) {
    const double changed = study.unit.empty() ? std::round(value * factor) : value * factor;
    const std::string text =
        fmt::format("{:.12g}{}", changed, study.unit.empty() ? "" : " " + study.unit);
    const EhlAnswer answer = solve(program, config.with(study.key, text), context);
    std::vector<std::string> cells = {study.unit.empty() ? text : si(changed, study.unit)};
    for (const EhlColumn& column : program.columns) cells.push_back(cell(answer.scalars, column));
    table.row(cells);
    io::Json result = {{"set", {{study.key, text}}}};
    result.update(answer.scalars);
    result["warnings"] = answer.warnings;
    results.push_back(result);
    converged = converged && answer.converged;
  }
  warn_of_many(results, context);
  io::Json limits = io::Json::object();
  if (study.has_limit) {
    std::vector<std::string> cells = {"limit"};
    for (const EhlColumn& column : program.columns) {
      limits[column.key] =
          io::number(limit_of(number_of(results[0], column.key), number_of(results[1], column.key),
                              number_of(results[2], column.key)));
      cells.push_back(cell(limits, column));
    }
    table.row(cells);
  }
  io::Json object = json_head(context);
  object.update({{"case", request.file}, {"study", study.name}, {"results", results}});
  if (study.has_limit) object["limits"] = limits;
  object["converged"] = converged;
  return finish(context, object, table.text(), code_of(converged));
}

int run(const Request& request, Context& context) {
  const EhlProgram& program = find_program(request.program);
  if (request.output) check_can_write(*request.output);
  io::Config config = io::Config::read(request.file);
  bool sweeps = false;
  for (const SweepAxis& axis : request.axes) {
    if (!axis.is_range) config = config.with(axis.key, axis.values.front());
    sweeps = sweeps || axis.is_range;
  }
  if (request.study && (sweeps || request.output)) {
    throw UsageError("--study varies one thing by itself: no range in --set and no -o beside it");
  }
  if (request.study) return show_study(program, config, request, context);
  return sweeps ? show_sweep(program, config, request, context)
                : show_one(program, config, request, context);
}

std::string details() {
  std::string text = "Programs:";
  for (const EhlProgram& program : programs()) {
    text += fmt::format(" {} - {}.", program.name, program.summary);
  }
  return text + " docs/ehl.md lists the keys of their cases.";
}

void declare_options(OptionSet& set, Request& request) {
  set.group("Case");
  set.positional("PROGRAM", "which program", request.program);
  set.positional("CASE.toml", "the case: bodies, lubricant, motion, grid", request.file);
  Option& axis = set.add(
      {.flag = "--set",
       .placeholder = "KEY=VALUE",
       .help =
           "change one value of the case; a range as in ball.speed=0.05m/s..1m/s:log:5 computes "
           "all of its values (and all combinations of several ranges)",
       .assign = [&](const std::string& text) { request.axes.push_back(parse_axis(text)); }});
  axis.repeatable = true;
  set.text("--study", "grid|domain|time-step",
           "how far the result depends on the grid, the domain or the time step", request.study);
  set.group("Output");
  set.text("--output", "OUT.h5", "keep histories and profiles, or the numbers of a sweep",
           request.output)
      .short_flag = "-o";
}

}  // namespace

Verb ehl_verb() {
  return {.name = "ehl",
          .arguments = "PROGRAM CASE.toml [options]",
          .summary = "films under load: impact, squeeze and slide, line contact with wear",
          .details = details(),
          .examples = {"tabor ehl impact examples/09_ball_drop/safa_gohar.toml -o impact.h5",
                       "tabor ehl impact examples/10_restitution_map/ball.toml "
                       "--set ball.speed=0.05m/s..1m/s:log:3 --set grid.nodes=100 --json",
                       "tabor ehl line examples/11_hdpe_glycerol/hdpe.toml"},
          .declare = [](OptionSet& set) -> Action {
            const auto request = std::make_shared<Request>();
            declare_options(set, *request);
            return [request](Context& context) { return run(*request, context); };
          }};
}

}  // namespace tabor::cli
