#include "tabor/study/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <ostream>

#include "tabor/cli/density_curve.hpp"
#include "tabor/cli/failure.hpp"
#include "tabor/cli/result.hpp"
#include "tabor/cli/run_options.hpp"
#include "tabor/cli/table.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/printable.hpp"
#include "tabor/core/units.hpp"
#include "tabor/io/columns.hpp"
#include "tabor/study/friction_table.hpp"

namespace tabor::cli {

namespace {

namespace fs = std::filesystem;

struct Request {
  std::string study;
  std::optional<std::string> directory;
  std::vector<study::Change> changes;
  bool wants_template = false;
  RunRequest run;

  fs::path folder() const {
    return directory ? fs::path(*directory) : fs::path(study).stem().concat("_results");
  }
};

study::Study read_study(const Request& request, const Context& context) {
  study::Study study = study::read_study(request.study, request.changes);
  if (context.seed) study.settings.film.seed = *context.seed;
  return study;
}

study::SweepOptions options_for(const Request& request, const Context& context) {
  study::SweepOptions options{run_options(request.run, context), {}};
  options.command = context.command_line;
  return options;
}

io::Json averages_json(const study::Study& study, const std::vector<study::Average>& averages) {
  const auto columns = study::average_columns(cases::parts_of(study.settings));
  io::Json rows = io::Json::array();
  for (const study::Average& average : averages) rows.push_back(io::json_of(columns, average));
  return rows;
}

/// "0.29 ± 0.012"
std::string with_deviation(const study::Mean& mean) {
  if (std::isnan(mean.mean)) return "-";
  const std::string text = plain(mean.mean);
  return std::isnan(mean.standard_deviation) ? text
                                             : text + " ± " + plain(mean.standard_deviation, 2);
}

/// "5.2 ± 0.4 %"
std::string share_with_deviation(const study::Mean& share) {
  const study::Mean in_percent{share.n, 100 * share.mean, 100 * share.standard_deviation};
  return std::isnan(share.mean) ? "-" : with_deviation(in_percent) + " %";
}

/// A column of the table of averages.
struct AverageColumn {
  std::string title;
  std::function<std::string(const study::Average&)> cell;
};

bool has_places(const study::Average& average) {
  return average.tool_spread && std::isfinite(average.tool_spread->friction_dry);
}

/// Columns that only some studies have: of oil that flows, of trapped oil, of places of a tool.
std::vector<AverageColumn> further_columns(const study::Study& study,
                                           const std::vector<study::Average>& averages) {
  const auto any = [&](const auto& has) {
    return std::any_of(averages.begin(), averages.end(), has);
  };
  std::vector<AverageColumn> columns;
  if (study.flows()) {
    columns.push_back({"speed", [](const study::Average& one) {
                         return one.fluid ? si(one.fluid->sliding_speed, "m/s") : "-";
                       }});
    columns.push_back({"oil carries", [](const study::Average& one) {
                         return one.fluid ? share_with_deviation(one.fluid->load_share) : "-";
                       }});
    columns.push_back({"friction mixed", [](const study::Average& one) {
                         return one.fluid ? with_deviation(one.fluid->friction_mixed) : "-";
                       }});
  }
  if (any([](const study::Average& one) { return one.liquid_load_share.has_value(); })) {
    columns.push_back({"trapped oil carries", [](const study::Average& one) {
                         return one.liquid_load_share ? share_with_deviation(*one.liquid_load_share)
                                                      : "-";
                       }});
  }
  if (any(has_places)) {
    const auto of_places = [](double cases::ToolSpread::*value) {
      return [value](const study::Average& one) {
        return one.tool_spread ? "± " + plain(*one.tool_spread.*value, 2) : "-";
      };
    };
    columns.push_back({"dry, places", of_places(&cases::ToolSpread::friction_dry)});
    columns.push_back({"wet, places", of_places(&cases::ToolSpread::friction_lubricated)});
  }
  if (any([](const study::Average& one) { return !one.left_out.empty(); })) {
    columns.push_back(
        {study::kLeftOutHeading, [](const study::Average& one) { return one.left_out; }});
  }
  return columns;
}

std::string averages_text(const study::Study& study, const std::vector<study::Average>& averages) {
  const std::vector<AverageColumn> further = further_columns(study, averages);
  std::vector<std::string> titles = {"group", "pressure",     "lubricant",
                                     "n",     "friction dry", "friction wet"};
  for (const AverageColumn& column : further) titles.push_back(column.title);
  Table table(titles);
  for (const study::Average& one : averages) {
    std::vector<std::string> cells = {one.group,
                                      si(one.mean_pressure, "Pa"),
                                      plain(in_g_per_m2(one.lubricant_density)) + " g/m²",
                                      std::to_string(one.n),
                                      with_deviation(one.friction_dry),
                                      with_deviation(one.friction_lubricated)};
    for (const AverageColumn& column : further) cells.push_back(column.cell(one));
    table.row(cells);
  }
  return table.text() + "± is the standard deviation over n scans" +
         (std::any_of(averages.begin(), averages.end(), has_places)
              ? "; of places: over the places of the tool.\n"
              : ".\n");
}

io::Json curves_json(const std::vector<study::GroupCurve>& curves) {
  io::Json all = io::Json::array();
  for (const study::GroupCurve& one : curves) {
    io::Json object = {{"group", one.group}, {"n", one.n}};
    object.update(json_of(one.curve, one.asked));
    all.push_back(std::move(object));
  }
  return all;
}

/// The last state of each slide.
std::string slides_text(const study::Study& study, const std::vector<study::SlideRow>& rows) {
  std::vector<study::SlideRow> last;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool ends = i + 1 == rows.size() || rows[i + 1].state.distance == 0;
    if (ends) last.push_back(rows[i]);
  }
  Columns<study::SlideRow> columns = study::slide_row_columns(study);
  for (Column<study::SlideRow>& one : columns) {
    if (one.key == "mean_pressure_Pa") one.heading = "pressure";
  }
  return "\nAt the end of sliding:\n" + table_of(columns, last).text();
}

std::string outcome_text(const Request& request, const study::Outcome& outcome) {
  Facts facts;
  facts.fact("study", request.study);
  facts.fact("results", request.folder().string());
  facts.fact("cases", fmt::format("{} of {} done, {} failed, {} not converged", outcome.n_done,
                                  outcome.n_cases, outcome.n_failed, outcome.n_not_converged));
  facts.fact(
      "computed now",
      fmt::format("{} surfaces, {} contacts, {} films, {}{} flowing, {} cases", outcome.n_surfaces,
                  outcome.n_contacts, outcome.n_films,
                  outcome.n_trapped > 0 ? fmt::format("{} trapped, ", outcome.n_trapped) : "",
                  outcome.n_fluids, outcome.n_rows) +
          (outcome.n_slides > 0 ? fmt::format(", {} slides", outcome.n_slides) : ""));
  return facts.text();
}

io::Json outcome_json(const Context& context, const Request& request,
                      const study::Outcome& outcome) {
  io::Json object = json_head(context);
  object.update({{"study", request.study},
                 {"directory", request.folder().string()},
                 {"results", (request.folder() / "results.h5").string()},
                 {"results_csv", (request.folder() / "results.csv").string()},
                 {"averages_csv", (request.folder() / "averages.csv").string()},
                 {"n_cases", outcome.n_cases},
                 {"n_done", outcome.n_done},
                 {"n_failed", outcome.n_failed},
                 {"n_not_converged", outcome.n_not_converged},
                 {"n_computed_surfaces", outcome.n_surfaces},
                 {"n_computed_contacts", outcome.n_contacts},
                 {"n_computed_films", outcome.n_films},
                 {"n_computed_trapped", outcome.n_trapped},
                 {"n_computed_fluids", outcome.n_fluids},
                 {"n_computed_cases", outcome.n_rows},
                 {"n_computed_slides", outcome.n_slides},
                 {"failures", outcome.failures}});
  return object;
}

int code_of(const study::Outcome& outcome) {
  if (outcome.n_failed + outcome.n_failed_slides > 0) return kInput;
  return outcome.n_not_converged > 0 ? kNotConverged : kDone;
}

/// Tables are replaced, and whatever the store holds.
void note_files(const study::Study& study, const fs::path& folder, CommandFiles& files) {
  files.fills(folder / "store");
  for (const char* table :
       {"results.h5", "results.csv", "averages.csv", "density_curves.csv", "slides.csv"}) {
    files.writes(folder / table);
  }
  for (const study::Scan& scan : study.scans) files.reads(scan.file);
  if (study.experiment) files.reads(study.experiment->file);
}

int sweep(const Request& request, Context& context) {
  if (request.wants_template) return show_template(study::study_template(), context);
  const study::Study study = read_study(request, context);
  note_files(study, request.folder(), context.files);
  study::Outcome outcome;
  try {
    outcome = study::run(study, request.folder(), options_for(request, context));
  } catch (const Interrupted&) {
    return fail(context,
                fmt::format("interrupted; the same command continues with the finished cases in {}",
                            printable(request.folder().string())),
                kInterrupted);
  }
  for (const std::string& warning : outcome.warnings) context.warn(warning);
  context.warn(outcome.findings);
  for (const std::string& failure : outcome.failures) context.warn("failed: " + failure);
  io::Json object = outcome_json(context, request, outcome);
  object["averages"] = averages_json(study, outcome.averages);
  if (!outcome.density_curves.empty()) {
    object["density_curves"] = curves_json(outcome.density_curves);
  }
  std::string text = outcome_text(request, outcome) + '\n' + averages_text(study, outcome.averages);
  if (!outcome.slides.empty()) text += slides_text(study, outcome.slides);
  if (!outcome.density_curves.empty()) {
    text += "\nFriction against the lubricant's density:\n" + places_text(outcome.density_curves);
  }
  return finish(context, object, text, code_of(outcome));
}

study::Change parse_change(const std::string& text) {
  const std::size_t equal = text.find('=');
  if (equal == 0 || equal == std::string::npos) {
    throw UsageError("--set: got '" + text + "'; expected KEY=VALUE, e.g. contact.tolerance=1e-8");
  }
  return {text.substr(0, equal), text.substr(equal + 1)};
}

void declare_options(OptionSet& set, Request& request) {
  set.group("Study");
  set.input("STUDY.toml", "study file with scans, treatment, material, pressures and densities",
            request.study)
      .unless = kTemplate;
  declare_template(set, "a study file to start from", request.wants_template);
  set.add(
      {.flag = "--set",
       .placeholder = "KEY=VALUE",
       .help = "replace a value of the file, e.g. lubricant.model=limit; may be repeated",
       .repeatable = true,
       .assign = [&](const std::string& text) { request.changes.push_back(parse_change(text)); }});
  set.output("DIR", "folder of the results [STUDY_results]", {}, request.directory);
  declare_run_options(set, request.run);
}

}  // namespace

Verb sweep_verb() {
  return {.name = "sweep",
          .arguments = "STUDY.toml [-o DIR] [options]",
          .summary = "compute a study of scans, pressures and densities, resumable",
          .details =
              "Finished cases are saved, and the same command skips them when it runs again and "
              "rebuilds the tables. A [[scan]] may have its own pressure, density, treatment, "
              "contact (elastic or saturated) and reading. With lubricant.fluid = \"reynolds\", "
              "lubricant.viscosity and a list sweep.sliding_speed the deposited oil flows, "
              "carries part of the load and adds viscous friction at each speed.",
          .examples = {"tabor sweep examples/06_study/study.toml -o study_results",
                       "tabor sweep examples/06_study/study.toml -o study_results --jobs 2 --json",
                       "tabor sweep examples/06_study/study.toml --set lubricant.model=limit -o "
                       "limit_results",
                       "tabor sweep --template"},
          .declare = [](OptionSet& set) -> Action {
            const auto request = std::make_shared<Request>();
            declare_options(set, *request);
            return [request](Context& context) { return sweep(*request, context); };
          }};
}

}  // namespace tabor::cli
