#include <fmt/format.h>

#include <memory>
#include <optional>

#include "tabor/cli/contact_request.hpp"
#include "tabor/cli/fields_file.hpp"
#include "tabor/cli/lowpass_scan.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/core/error.hpp"

namespace tabor::cli {

namespace {

struct Request {
  ScanRequest scan;
  ContactRequest contact;
  std::optional<std::string> output;
  std::vector<double> cutoffs;           ///< of --lowpass-scan
  std::optional<double> shear_strength;  ///< [Pa], for its friction
};

Table table() {
  return Table({"pressure", "contact", "pixels", "saturated", "mean gap", "max pressure", "patches",
                "certificate", "gap error", "converged", "iterations", "time"});
}

std::vector<std::string> row_of(const ContactResult& result) {
  const contact::Summary& summary = result.summary;
  const Convergence& convergence = result.state.convergence;
  return {si(summary.mean_pressure, "Pa"),
          percent(summary.contact_area_fraction),
          percent(summary.contact_area_fraction_pixels),
          percent(summary.saturated_area_fraction),
          si(summary.mean_gap, "m"),
          si(summary.max_pressure, "Pa"),
          fmt::format("{}", summary.n_patches),
          fmt::format("{:.1e}", convergence.certificate),
          si(summary.contact_gap_error, "m"),
          yes_no(convergence.converged),
          fmt::format("{}", convergence.iterations),
          si(result.seconds, "s")};
}

void check(const Request& request) {
  check(request.contact);
  if (request.output && !request.cutoffs.empty()) {
    throw UsageError("--lowpass-scan keeps no maps; leave out -o");
  }
  if (request.shear_strength && request.cutoffs.empty()) {
    throw UsageError("--shear-strength belongs to --lowpass-scan here; see also 'tabor friction'");
  }
}

int show(const Request& request, Context& context) {
  check(request);
  const Scan scan = read_scan(request.scan, context);
  require_no_holes(scan);
  if (!request.cutoffs.empty()) {
    return run_lowpass_scan(scan, request.contact, request.cutoffs, request.shear_strength,
                            context);
  }
  const auto elasticity = make_operator(request.contact, scan.surface.grid);
  const io::Json settings = settings_json(request.contact);

  std::optional<FieldsFile> file;
  if (request.output) {
    file.emplace(*request.output, context, scan, settings, methods_of(request.contact));
  }
  io::Json object = json_head(context, scan);
  object["nx"] = scan.surface.grid.nx;
  object["ny"] = scan.surface.grid.ny;
  object.update(settings);
  object["states"] = io::Json::array();
  Table rows = table();
  std::vector<analysis::Case> cases;
  const auto receive = [&](const ContactResult& result) {
    const io::Json state = state_json(result);
    if (file) file->add_state(object["states"].size(), state, fields_of(result.state));
    object["states"].push_back(state);
    object["states"].back().update(statistics_json(*elasticity, result, request.contact, context));
    rows.row(row_of(result));
    cases.push_back(
        {.pressure = si(result.summary.mean_pressure, "Pa"), .warnings = result.warnings});
  };
  const int code = solve_all(*elasticity, scan, request.contact, context, receive);
  if (code == kInterrupted && object["states"].empty()) throw Interrupted();
  context.warn(analysis::findings_of(cases));
  if (file) file->commit(context);
  Facts facts;
  describe(scan, facts);
  describe(request.contact, facts);
  return finish(context, object, facts.text() + '\n' + rows.text(), code);
}

void declare_extras(OptionSet& set, ContactRequest& request) {
  set.toggle("--load-path",
             "the pressures are one history: the plastic indentation a state leaves is kept in the "
             "next, so that reloading below the largest is elastic",
             request.load_path);
  set.toggle("--statistics",
             "add contact stiffness and histograms of pressure, gap and patch area to --json",
             request.statistics);
}

void declare_lowpass_scan(OptionSet& set, Request& request) {
  set.group("Dependence on the finest wavelength");
  set.add({.flag = "--lowpass-scan",
           .placeholder = "C[,C2,...]",
           .help =
               "repeat with '--lowpass hann:C/L' for rising C and find where the area no longer "
               "changes, e.g. 64,128,256,512",
           .assign = [&](const std::string& text) { request.cutoffs = parse_cutoffs(text); }});
  set.quantity("--shear-strength", "TAU", "add dry friction to the low-pass scan",
               dimension::pressure, request.shear_strength);
}

}  // namespace

Verb contact_verb() {
  return {.name = "contact",
          .arguments = "SCAN --pressure P --youngs-modulus E --poisson-ratio NU [options]",
          .summary = "real contact area, gap, patches and saturated share under a pressure",
          .details =
              "A rigid flat is pressed on the rough half-space. The certificate bounds the "
              "energy error; the contact area is corrected for the pixels of its perimeter, "
              "the pixel count stands beside it.",
          .examples = {"tabor contact surfaces/edt_before.x3p --level plane --pressure 2MPa,7MPa "
                       "--youngs-modulus 70GPa --poisson-ratio 0.33 --saturation-pressure 240MPa",
                       "tabor contact surfaces/edt_before.x3p --level plane --lowpass gauss:8um "
                       "--pressure 7MPa --youngs-modulus 70GPa --poisson-ratio 0.33 -o contact.h5"},
          .declare = [](OptionSet& set) -> Action {
            const auto request = std::make_shared<Request>();
            declare_scan(set, request->scan);
            declare_contact(set, request->contact);
            declare_extras(set, request->contact);
            declare_lowpass_scan(set, *request);
            declare_output(set, request->output);
            return [request](Context& context) { return show(*request, context); };
          }};
}

}  // namespace tabor::cli
