#include <fmt/format.h>

#include <memory>
#include <optional>

#include "tabor/cases/parameters.hpp"
#include "tabor/cases/slide.hpp"
#include "tabor/cli/contact_request.hpp"
#include "tabor/cli/parameter_options.hpp"
#include "tabor/cli/verbs.hpp"

namespace tabor::cli {

namespace {

struct Request {
  ScanRequest scan;
  cases::CaseSettings settings;
  cases::SlideSettings sliding;
  std::optional<std::string> after;  ///< file of the sheet after sliding
  CsvRequest csv;
};

void check_all(const Request& request) {
  const cases::CaseSettings& settings = request.settings;
  check(cases::objection(request.sliding, settings, flag_of));
  check_contact(settings);
  check(cases::objection(settings.film));
  check(cases::objection(settings.friction, flag_of, settings.contact.material));
}

std::string text_of(const Request& request, const Scan& scan, const cases::SlideResult& result) {
  const cases::CaseSettings& settings = request.settings;
  Facts facts;
  describe(scan, facts);
  describe(settings.contact, facts);
  if (!settings.film.lubricant_densities.empty()) describe(settings.film, facts);
  facts.fact("sliding",
             fmt::format("along x under {}, {} steps of {}, displaced material {}",
                         si(settings.mean_pressures.front(), "Pa"), result.steps,
                         si(result.step, "m"), sliding::kDisplaced.of(request.sliding.displaced)));
  if (request.after) facts.fact("sheet after", *request.after);
  return facts.text() + '\n' + table_of(cases::slide_columns(), result.states).text();
}

int show(Request request, Context& context) {
  request.settings.film.seed = context.seed_or_default();
  check_all(request);
  find_tool(request.settings.contact, context);
  const Scan scan = read_scan(request.scan, context);
  require_no_holes(scan);
  cases::ContactSettings& contact = request.settings.contact;
  check(cases::objection(contact, scan.surface.edges, flag_of));
  contact.take_edges(scan.surface.edges);
  const cases::SlideResult result =
      cases::slide(scan.surface, request.settings, request.sliding, {}, context.observer());
  context.warn(results::findings_of({{.pressure = si(request.settings.mean_pressures.front(), "Pa"),
                                      .warnings = result.warnings}}));
  if (request.after) scan::write(result.after, *request.after);
  io::Json object = json_head(context, scan);
  io::Json settings = results::settings_json(request.settings);
  if (request.settings.film.lubricant_densities.empty()) {
    for (const ParameterHead& one : cases::film_parameters()) settings.erase(one.json_key());
  }
  object.update(settings);
  object["displaced"] = sliding::kDisplaced.of(request.sliding.displaced);
  object["reach_m"] = request.sliding.reach;
  object["step_m"] = result.step;
  object["steps"] = result.steps;
  object["states"] = states_json(cases::slide_columns(), result.states);
  object["converged"] = result.converged;
  return finish(context, object,
                write_csv(request.csv, states_csv(cases::slide_columns(), result.states),
                          text_of(request, scan, result)),
                result.converged ? kDone : kNotConverged);
}

}  // namespace

Verb slide_verb() {
  return {
      .name = "slide",
      .arguments = "SCAN --tool TOOL --pressure P --distance L [options]",
      .summary = "a rough tool slides over the sheet: friction, ploughing, the sheet after",
      .details =
          "Each step is a contact on the sheet that the steps before have left; saturated pixels "
          "are "
          "displaced. Ploughing is the work of it over load and distance, and is part of the "
          "friction "
          "coefficients. The tool slides along +x. With --density oil is rained on the sheet "
          "before, "
          "and stays on its pixels.",
      .examples = {"tabor slide surfaces/edt_before.x3p --level plane --crop 0,0,128,128 --mirror "
                   "--material aluminium-6016 --tool ground:Sa=0.1um,length=1mm --pressure 10MPa "
                   "--distance 20um",
                   "tabor slide surfaces/edt_before.x3p --level plane --crop 0,0,128,128 --mirror "
                   "--material aluminium-6016 --tool ground:Sa=0.1um,length=1mm --pressure 10MPa "
                   "--distance 20um --step 2.68um --density 0.9g/m^2 --after worn.x3p --json"},
      .declare = [](OptionSet& set) -> Action {
        const auto request = std::make_shared<Request>();
        declare_scan(set, request->scan);
        cases::CaseSettings& settings = request->settings;
        declare_contact(set, settings, Controls::sliding);
        set.group("Sliding");
        for (const auto& one : cases::slide_parameters()) declare(set, one, request->sliding);
        declare_film(set, settings.film, false);
        declare_dry_below(set, settings.friction);
        declare_friction(set, settings.friction);
        set.group("Output");
        Option& after =
            set.text("--after", "OUT", "write the sheet after sliding; its extension is the format",
                     request->after);
        after.names = FileRole::output;
        after.extensions = scan_extensions();
        declare_csv(set, "one row per state with the keys of --json", request->csv);
        return [request](Context& context) {
          take_edges(request->scan, request->settings.contact);
          return show(*request, context);
        };
      }};
}

}  // namespace tabor::cli
