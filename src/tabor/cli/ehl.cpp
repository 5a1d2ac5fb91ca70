#include "tabor/cli/ehl.hpp"

#include <fmt/format.h>

#include <memory>
#include <set>

#include "tabor/cli/ehl_case.hpp"
#include "tabor/cli/ehl_cases.hpp"
#include "tabor/cli/ehl_series.hpp"
#include "tabor/cli/fields_file.hpp"
#include "tabor/cli/result.hpp"
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

const std::vector<EhlProgram>& programs() { return ehl_programs(); }

const EhlProgram& find_program(const std::string& name) {
  std::vector<std::string> names;
  for (const EhlProgram& program : programs()) {
    if (program.name == name) return program;
    names.push_back(program.name);
  }
  throw UsageError(fmt::format("ehl: got program '{}'; expected {}; see 'tabor ehl --help'{}", name,
                               fmt::join(names, ", "), suggestion(name, names)));
}

/// Objects in it as groups of their own.
void write_result(io::Hdf5Writer& writer, const std::string& group, const io::Json& scalars) {
  writer.group(group);
  write_scalars(writer, group, scalars);
  for (const auto& [key, value] : scalars.items()) {
    if (value.is_object()) write_result(writer, fmt::format("{}/{}", group, key), value);
  }
}

int show_one(const EhlProgram& program, const io::Config& config, const Request& request,
             Context& context) {
  reject_unknown_keys(program, config);
  const EhlAnswer answer = program.solve(config, context);
  for (const std::string& warning : answer.warnings) context.warn(warning);
  if (request.output) {
    io::Hdf5Writer writer(*request.output);
    write_result_head(writer, context, config.to_text(), program.methods);
    writer.attribute("/", "kind", "ehl " + program.name);
    write_result(writer, "/result", answer.scalars);
    write_warnings(writer, context);
    if (answer.write) answer.write(writer);
    writer.commit();
  }
  io::Json object = json_head(context);
  object["case"] = request.file;
  object.update(answer.scalars);
  return finish(context, object, answer.text, answer.converged ? kDone : kNotConverged);
}

/// The files that the cases name.
void note_inputs(const EhlProgram& program, const io::Config& config,
                 const std::vector<SweepAxis>& swept, CommandFiles& files) {
  for (const std::string& key : program.files) {
    if (config.has(key)) files.reads(named_file(config, key));
    for (const SweepAxis& axis : swept) {
      if (axis.key != key) continue;
      for (const std::string& value : axis.values) {
        files.reads(named_file(config.with(key, value), key));
      }
    }
  }
}

int run(const Request& request, Context& context) {
  const EhlProgram& program = find_program(request.program);
  io::Config config = io::Config::read(request.file);
  std::vector<SweepAxis> swept;
  std::set<std::string> seen;
  for (const SweepAxis& axis : request.axes) {
    if (axis.is_range && !seen.insert(axis.key).second) {
      throw UsageError("--set " + axis.key + ": varied twice; a list takes all values: --set " +
                       axis.key + "=V1,V2");
    }
    if (axis.is_range) {
      swept.push_back(axis);
    } else {
      config = config.with(axis.key, axis.values.front());
    }
  }
  if (request.study && (!swept.empty() || request.output)) {
    throw UsageError("--study varies one thing by itself: no range in --set and no -o beside it");
  }
  note_inputs(program, config, swept, context.files);
  if (!request.study && swept.empty()) return show_one(program, config, request, context);
  const EhlSeries series{program, config, request.file, request.output};
  if (request.output) context.files.fills(kept_folder(series));
  return request.study ? show_study(series, *request.study, context)
                       : show_sweep(series, swept, context);
}

std::string details() {
  std::string text = "Programs:";
  for (const EhlProgram& program : programs()) {
    text += fmt::format(" {} - {}.", program.name, program.summary);
  }
  return text +
         " 'tabor ehl PROGRAM --help' lists the keys of its cases; docs/ehl.md, docs/ehl_line.md "
         "and "
         "docs/ehl_point.md explain what they do. A sweep with -o keeps its finished cases; if "
         "it is stopped, the same command continues it.";
}

void declare_options(OptionSet& set, Request& request) {
  set.group("Case");
  set.positional("PROGRAM", "impact, squeeze, line or point", request.program);
  set.input("CASE.toml", "the case: bodies, lubricant, motion, grid", request.file);
  Option& axis = set.add(
      {.flag = "--set",
       .placeholder = "KEY=VALUE",
       .help = "change one value of the case; a range as in ball.speed=0.05m/s..1m/s:log:5 or a "
               "list as in grid.nodes=65,97,145 computes all of its values (and all combinations "
               "of several)",
       .assign = [&](const std::string& text) { request.axes.push_back(parse_axis(text)); }});
  axis.repeatable = true;
  set.text("--study", "grid|domain|time-step",
           "how far the result depends on the grid, the domain or the time step", request.study);
  set.group("Output");
  set.output("OUT.h5", "keep histories, profiles and maps, or the numbers of a sweep",
             hdf5_extensions(), request.output);
}

constexpr const char* kRestitutionMap =
    "tabor ehl impact examples/10_restitution_map/ball.toml --set ball.speed=0.05m/s..1m/s:log:3 "
    "--set grid.nodes=100 --json";
constexpr const char* kStribeckCurve =
    "tabor ehl point examples/12_stribeck/ball.toml --set grid.nodes=65 "
    "--set motion.speed=0.1m/s..10m/s:log:3";

}  // namespace

Verb ehl_verb() {
  return {.name = "ehl",
          .arguments = "PROGRAM CASE.toml [options]",
          .summary = "films under load: impact, squeeze and slide, line and point contacts",
          .details = details(),
          .examples = {"tabor ehl impact examples/09_ball_drop/safa_gohar.toml -o impact.h5",
                       kRestitutionMap, "tabor ehl line examples/11_hdpe_glycerol/hdpe.toml",
                       "tabor ehl point examples/12_stribeck/ball.toml --set grid.nodes=65,97,129",
                       kStribeckCurve},
          .declare = [](OptionSet& set) -> Action {
            const auto request = std::make_shared<Request>();
            declare_options(set, *request);
            return [request](Context& context) { return run(*request, context); };
          },
          .tables = ehl_key_tables};
}

}  // namespace tabor::cli
