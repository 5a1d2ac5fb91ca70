#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string_view>

#include "tabor/cases/parameters.hpp"
#include "tabor/cases/slide/slide.hpp"
#include "tabor/cli/contact_request.hpp"
#include "tabor/cli/failure.hpp"
#include "tabor/cli/parameter_options.hpp"
#include "tabor/cli/time_left.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/printable.hpp"
#include "tabor/core/units.hpp"

namespace tabor::cli {

namespace {

struct Request {
  ScanRequest scan;
  cases::CaseSettings settings;
  cases::SlideSettings sliding;
  std::optional<std::string> after;       ///< file of the sheet after sliding
  std::optional<std::string> checkpoint;  ///< folder that keeps the run while it lasts
  FieldsRequest file;
};

void check_all(const Request& request) {
  const cases::CaseSettings& settings = request.settings;
  check(cases::objection(request.sliding, settings, flag_of));
  const bool has_oil = !settings.film.lubricant_densities.empty();
  if (!has_oil && request.sliding.liquid != cases::SlidingOil::both) {
    throw UsageError("--liquid needs oil; give --density");
  }
  check_contact(settings);
  check(cases::objection(settings.film));
  check(cases::objection(settings.friction, flag_of, settings.contact.material));
}

std::string steps_of(std::uint64_t n, double length) {
  return fmt::format("{} {} of {}", n, n == 1 ? "step" : "steps", si(length, "m"));
}

/// The steps, of which the last may be shorter.
std::string steps_to(double distance, std::uint64_t n, double length) {
  constexpr double same = 0.01;  // of a step
  const double last = distance - static_cast<double>(n - 1) * length;
  if (n < 2 || !(last > 0) || last > (1 - same) * length) return steps_of(n, length);
  return fmt::format("{} and one of {}", steps_of(n - 1, length), si(last, "m"));
}

/// The steps; then the distance where it is another than asked for, as steps are whole pixels.
std::string steps_and_end(const Request& request, const cases::SlideResult& result) {
  constexpr double same = 1e-4;  // of the distance
  const double done = result.states.back().distance;
  if (result.interrupted) {
    return fmt::format("steps of {}, interrupted after {}", si(result.step, "m"), si(done, "m"));
  }
  std::string steps = steps_to(done, result.steps, result.step);
  const std::optional<double> asked = request.sliding.distance;
  if (!asked || result.steady.value_or(false) || std::abs(done - *asked) < same * *asked) {
    return steps;
  }
  return fmt::format("{} to {} (whole pixels)", steps, si(done, "m"));
}

std::string text_of(const Request& request, const Scan& scan, const cases::SlideResult& result) {
  const cases::CaseSettings& settings = request.settings;
  Facts facts;
  describe(scan, facts);
  describe(settings.contact, facts);
  if (!settings.film.lubricant_densities.empty()) {
    describe(settings.film, facts);
    describe(settings.trapped, facts);
  }
  facts.fact("sliding",
             fmt::format("along x under {}, {}, displaced material {}",
                         si(settings.mean_pressures.front(), "Pa"), steps_and_end(request, result),
                         sliding::kDisplaced.of(request.sliding.displaced)));
  if (result.steady) facts.fact("steady", *result.steady ? "yes" : "no");
  if (request.after) facts.fact("sheet after", *request.after);
  const auto columns = cases::slide_columns(cases::parts_of(settings, request.sliding));
  return facts.text() + '\n' + table_of(columns, result.states).text();
}

/// Takes "archard:K" in place of a word, too: what is displaced rises near, and contacts wear.
void take_wear(Option& option, cases::SlideSettings& sliding) {
  static constexpr std::string_view law = "archard:";
  option.help += "; archard:K is near, with the wear coefficient K";
  option.assign = [&sliding, of_word = option.assign](const std::string& value) {
    if (!value.starts_with(law)) {
      if (sliding::kDisplaced.find(value)) return of_word(value);
      throw InputError("--displaced", fmt::format("'{}'", value),
                       fmt::format("{} or archard:K, e.g. archard:1e-15/Pa",
                                   fmt::join(sliding::kDisplaced.all(), ", ")),
                       "");
    }
    sliding.displaced = sliding::Displaced::near;
    const std::string coefficient = value.substr(law.size());
    if (const auto number = parse_number(coefficient)) {
      throw InputError(fmt::format("--displaced {}: got a number without a unit; write {}{}/Pa",
                                   value, law, coefficient));
    }
    sliding.wear_coefficient =
        parse_si(coefficient, dimension::per_pressure, "--displaced archard:K");
  };
}

/// Says how long it will take, before it does.
void tell(const cases::SlidePlan& plan, Context& context) {
  constexpr double worth_saying = 2;  // [s]
  if (context.quiet || plan.seconds < worth_saying) return;
  if (context.progress != nullptr) context.progress->clear();
  if (plan.gone_before > 0) {
    context.err << fmt::format("slide: goes on from {}\n", si(plan.gone_before, "m"));
  }
  const std::string part = plan.gone_before > 0 ? fmt::format("{} of ", plan.steps_left) : "";
  context.err << fmt::format("slide: {}{}, about {}\n", part, steps_of(plan.steps, plan.step),
                             format_estimate(plan.seconds));
}

io::Json json_of(const Request& request, const Scan& scan, const cases::SlideResult& result,
                 const Context& context) {
  io::Json object = json_head(context, scan);
  object.update(results::settings_json(request.settings, request.sliding));
  object["tool"] = {{"source", *request.settings.contact.tool.tool},
                    {"x_m", request.settings.contact.tool.tool_x.value_or(0)},
                    {"length_m", result.tool_length},
                    {"rms_height_m", result.tool_rms_height}};
  object["step_m"] = result.step;
  object["steps"] = result.steps;
  object["steady"] = result.steady ? io::Json(*result.steady) : io::Json();
  object["states"] = states_json(
      cases::slide_columns(cases::parts_of(request.settings, request.sliding)), result.states);
  object["converged"] = result.converged;
  return object;
}

int show(Request request, Context& context) {
  request.settings.film.seed = context.seed_or_default();
  check_all(request);
  find_tool(request.settings.contact, context);
  if (request.checkpoint) context.files.fills(*request.checkpoint);
  const Scan scan = read_scan(request.scan, context);
  require_no_holes(scan);
  cases::ContactSettings& contact = request.settings.contact;
  check(cases::objection(contact, scan.surface.edges));
  contact.take_edges(scan.surface.edges);
  const cases::SlideParts parts = cases::parts_of(request.settings, request.sliding);
  auto file = fields_file(request.file, context, scan, request.settings, request.sliding);
  std::size_t n_states = 0;
  const cases::SlideRun run{
      .plan = [&](const cases::SlidePlan& plan) { tell(plan, context); },
      .receive =
          [&](const cases::SlideState& state) {
            if (file) file->add(n_states++, state, parts);
          },
      .wants_maps = request.file.output && request.file.options.fields != results::Fields::none,
      .checkpoint = request.checkpoint.value_or(""),
      .ends_when_stopped = true};
  cases::SlideResult result;
  try {
    result = cases::slide(scan.surface, request.settings, request.sliding, run, context.observer());
  } catch (const Interrupted&) {
    if (!request.checkpoint) throw;
    return fail(context,
                fmt::format("interrupted; the run is kept in {}; the same command continues",
                            printable(*request.checkpoint)),
                kInterrupted);
  }
  if (result.interrupted) {
    context.warn(
        "Interrupted. Only the finished states are shown. With --checkpoint DIR the same "
        "command continues a run");
  }
  context.warn(results::findings_of({{.pressure = si(request.settings.mean_pressures.front(), "Pa"),
                                      .warnings = result.warnings}}));
  if (file) {
    file->add_run(result);
    file->commit(context.warnings);
  }
  if (request.after) scan::write(result.after, *request.after);
  return finish(context, json_of(request, scan, result, context),
                write_csv(request.file.csv, states_csv(cases::slide_columns(parts), result.states),
                          text_of(request, scan, result)),
                result.interrupted ? kInterrupted
                : result.converged ? kDone
                                   : kNotConverged);
}

}  // namespace

Verb slide_verb() {
  return {
      .name = "slide",
      .arguments = "SCAN --tool TOOL --pressure P --distance L|--until-steady [options]",
      .summary = "slide a rough tool over the sheet, for friction, ploughing and the sheet after",
      .details =
          "Each step is a contact on the sheet as the steps before left it, and displaces the "
          "material of saturated pixels. Ploughing is the work of this over load and distance; "
          "the friction coefficients include it. The tool slides along +x. With --density the "
          "sheet is oiled first. Oil that stays on its pixels gives a lower bound of friction; "
          "oil that contacts squeeze out gives an upper bound.",
      .examples = {"tabor slide surfaces/edt_before.x3p --level plane --crop 0,0,128,128 --mirror "
                   "--material aluminium-6016 --tool ground:Sa=0.1um,length=1mm --pressure 10MPa "
                   "--distance 20um",
                   "tabor slide surfaces/edt_before.x3p --level plane --crop 0,0,128,128 --mirror "
                   "--material aluminium-6016 --tool ground:Sa=0.1um,length=1mm --pressure 10MPa "
                   "--distance 20um --step 2.68um --density 0.9g/m^2 --after worn.x3p -o slide.h5 "
                   "--checkpoint slide_run"},
      .declare = [](OptionSet& set) -> Action {
        const auto request = std::make_shared<Request>();
        declare_scan(set, request->scan);
        cases::CaseSettings& settings = request->settings;
        declare_contact(set, settings, Controls::sliding);
        for (const auto& one : cases::slide_parameters()) {
          Option& option = declare(set, one, request->sliding);
          if (one.name == "displaced") take_wear(option, request->sliding);
        }
        declare_film(set, settings.film, false);
        declare_trapped(set, settings);
        declare_friction(set, settings.friction);
        set.group("Output");
        Option& after = set.text("--after", "OUT",
                                 "save the sheet after sliding; the extension gives the "
                                 "format",
                                 request->after);
        after.names = FileRole::output;
        after.extensions = scan_extensions();
        set.text("--checkpoint", "DIR",
                 "save the run in DIR while it lasts; the same command continues a killed run",
                 request->checkpoint)
            .may_name_file = true;
        declare_fields(set, request->file);
        return [request](Context& context) {
          take_edges(request->scan, request->settings.contact);
          return show(*request, context);
        };
      }};
}

}  // namespace tabor::cli
