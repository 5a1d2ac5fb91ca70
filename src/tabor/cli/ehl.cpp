#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <set>

#include "tabor/cases/ehl_surfaces.hpp"
#include "tabor/cli/axis_option.hpp"
#include "tabor/cli/film_sweep.hpp"
#include "tabor/cli/result.hpp"
#include "tabor/cli/table.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/io/columns.hpp"
#include "tabor/results/ehl_file.hpp"
#include "tabor/study/ehl_tables.hpp"

namespace tabor::cli {

namespace {

using study::SweepAxis;

struct Request {
  std::string program;
  std::string file;
  std::vector<SweepAxis> axes;
  std::optional<std::string> study;
  std::optional<std::string> output;
  bool wants_template = false;
  bool chooses_domain = false;
  RunRequest run;
  CsvRequest csv;
};

std::vector<std::string> names_of_programs() {
  std::vector<std::string> names;
  for (const ehl::Program& program : ehl::programs()) names.push_back(program.name);
  return names;
}

const ehl::Program& find_program(const std::string& name) {
  for (const ehl::Program& program : ehl::programs()) {
    if (program.name == name) return program;
  }
  const std::vector<std::string> names = names_of_programs();
  throw UsageError(fmt::format("ehl: got program '{}'; expected {}; see 'tabor ehl --help'{}", name,
                               fmt::join(names, ", "), suggestion(name, names)));
}

// One case

std::string text_of(const std::vector<ehl::Facts>& groups) {
  std::string text;
  for (const ehl::Facts& group : groups) {
    Facts facts;
    for (const ehl::Fact& fact : group) facts.fact(fact.label, fact.value);
    text += facts.text();
  }
  return text;
}

int show_one(const ehl::Program& program, const io::Config& config, const Request& request,
             Context& context) {
  const ehl::CaseResult result = solve_case(program, config,
                                            {.observer = context.observer(),
                                             .seed = context.seed_or_default(),
                                             .surfaces = cases::ehl_surfaces()});
  context.warn(results::findings_of({{.warnings = result.warnings}}));
  if (request.output) {
    results::write_case(*request.output, context.command_line, program, config, result,
                        context.warnings);
  }
  io::Json object = json_head(context);
  object["case"] = request.file;
  object.update(io::json_of(result.numbers));
  const std::string csv =
      request.csv.is_asked() ? csv_of(study::sweep_of(program, {}, {result})) : "";
  return finish(context, object, write_csv(request.csv, csv, text_of(result.facts)),
                result.converged() ? kDone : kNotConverged);
}

// What the words ask for

/// Puts single values into the case; returns what is to be varied.
std::vector<SweepAxis> take_axes(const std::vector<SweepAxis>& axes, io::Config& config) {
  std::vector<SweepAxis> swept;
  std::set<std::string> seen;
  for (const SweepAxis& axis : axes) {
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
  return swept;
}

void check_combination(const Request& request, const std::vector<SweepAxis>& swept) {
  if (request.study && (!swept.empty() || request.output)) {
    throw UsageError(
        "--study allows neither a range in --set nor -o, because it chooses the "
        "values itself");
  }
  if ((request.run.shard || request.run.retry) && (swept.empty() || !request.output)) {
    throw UsageError(
        "--shard and --retry need a sweep; give a range or a list in --set, and -o OUT.h5");
  }
  if (request.run.shard && request.csv.is_asked()) {
    throw UsageError("--csv writes all cases; give it to the run without --shard");
  }
}

int run(const Request& request, Context& context) {
  if (request.wants_template) {
    return show_template(case_template(find_program(request.program)), context);
  }
  if (request.chooses_domain && request.program != "point") {
    throw UsageError("--domain: only 'tabor ehl point' chooses its domain");
  }
  FilmSweep sweep{find_program(request.program),
                  request.file,
                  io::Config::read(request.file),
                  {},
                  request.output,
                  request.run,
                  request.csv};
  sweep.axes = take_axes(request.axes, sweep.config);
  check_combination(request, sweep.axes);
  study::EhlSeries series =
      ehl_sweep(sweep.program, sweep.config, sweep.axes, context.seed_or_default());
  for (const std::filesystem::path& file : files_of(series)) context.files.reads(file);
  if (request.study) return show_study(sweep, *request.study, context);
  if (sweep.axes.empty()) return show_one(sweep.program, sweep.config, request, context);
  if (request.output) context.files.fills(sweep.folder());
  return show_sweep(sweep, series, context);
}

std::string details() {
  std::string text = "Programs:";
  for (const ehl::Program& program : ehl::programs()) {
    text += fmt::format(" {} - {}.", program.name, program.summary);
  }
  return text +
         " 'tabor ehl PROGRAM --help' lists the keys of a case. docs/ehl.md, docs/ehl_line.md and "
         "docs/ehl_point.md explain them. A sweep with -o saves its finished cases, and the same "
         "command continues a stopped sweep. With --shard it saves its part beside OUT.h5; the "
         "same command without --shard then writes OUT.h5.";
}

void declare_options(OptionSet& set, Request& request) {
  set.group("Case");
  set.positional("PROGRAM", "impact, squeeze, line or point", request.program).words =
      names_of_programs();
  set.input("CASE.toml", "case file with bodies, lubricant, motion and grid", request.file).unless =
      kTemplate;
  declare_template(set, "a case file to start from, with every key of the program",
                   request.wants_template);
  Option& axis = set.add(
      {.flag = "--set",
       .placeholder = "KEY=VALUE",
       .help = "change a value of the case; a range such as ball.speed=0.05m/s..1m/s:log:5 or a "
               "list such as grid.nodes=65,97,145 computes every value, and several options every "
               "combination",
       .assign = [&](const std::string& text) { request.axes.push_back(parse_axis(text)); }});
  axis.repeatable = true;
  set.add({.flag = "--domain",
           .placeholder = "auto",
           .help = "choose a domain, and a grid unless the case has one, large enough for the film "
                   "of a point contact; the same as --set grid.domain=auto",
           .words = {"auto"},
           .assign = [&](const std::string& text) {
             if (text != "auto") throw UsageError("--domain: got '" + text + "'; expected auto");
             request.chooses_domain = true;
             request.axes.push_back(parse_axis("grid.domain=auto"));
           }});
  set.text("--study", "grid|domain|time-step",
           "show how much the result depends on the grid, the domain or the time step",
           request.study)
      .words = {"grid", "domain", "time-step"};
  set.group("Output");
  set.output("OUT.h5", "save histories, profiles and maps, or the numbers of a sweep",
             hdf5_extensions(), request.output);
  declare_csv(set, "one row per case with the keys of --json", request.csv);
  set.group("Many cases");
  declare_run_options(set, request.run);
}

/// The keys of every program, for `tabor ehl PROGRAM --help` and docs/options.md.
std::vector<HelpTable> key_tables() {
  std::vector<HelpTable> tables;
  for (const ehl::Program& program : ehl::programs()) {
    HelpTable table{.word = program.name,
                    .title = fmt::format("Keys of a case of 'tabor ehl {}'", program.name),
                    .keys = {}};
    for (const ParameterHead& key : program.keys) {
      table.keys.push_back({key.name, key.shown_unit(), key.when_absent(), key.meaning()});
    }
    tables.push_back(std::move(table));
  }
  return tables;
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
          .summary =
              "compute films under load for impact, squeeze and slide, line and point "
              "contacts",
          .details = details(),
          .examples = {"tabor ehl impact examples/09_ball_drop/safa_gohar.toml -o impact.h5",
                       kRestitutionMap, "tabor ehl line examples/11_hdpe_glycerol/hdpe.toml",
                       "tabor ehl point examples/12_stribeck/ball.toml --set grid.nodes=65,97,129",
                       kStribeckCurve, "tabor ehl point --template"},
          .declare = [](OptionSet& set) -> Action {
            const auto request = std::make_shared<Request>();
            declare_options(set, *request);
            return [request](Context& context) { return run(*request, context); };
          },
          .tables = key_tables};
}

}  // namespace tabor::cli
