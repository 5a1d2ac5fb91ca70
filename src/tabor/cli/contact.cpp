#include <fmt/format.h>

#include <memory>
#include <optional>

#include "tabor/cli/contact_request.hpp"
#include "tabor/cli/fields_file.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/core/error.hpp"

namespace tabor::cli {

namespace {

struct Request {
  ScanRequest scan;
  ContactRequest contact;
  std::optional<std::string> output;
};

std::vector<std::string> methods_of(const ContactRequest& request) {
  std::vector<std::string> methods = {"polonsky1999", "yastrebov2017",
                                      request.is_periodic() ? "stanley1997" : "love1929"};
  if (request.solver == "fast") methods.insert(methods.begin(), "rey2017");
  if (request.saturation_pressure) methods.push_back("almqvist2007");
  return methods;
}

std::vector<StateField> fields_of(const contact::State& state) {
  return {{"pressure", "Pa", "contact pressure", state.pressure},
          {"displacement", "m", "displacement of the surface, into the body", state.displacement},
          {"gap", "m", "gap between the deformed surface and the flat", state.gap}};
}

Table table() {
  return Table({"pressure", "contact", "pixels", "saturated", "mean gap", "max pressure", "patches",
                "certificate", "converged", "iterations", "time"});
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
          yes_no(convergence.converged),
          fmt::format("{}", convergence.iterations),
          si(result.seconds, "s")};
}

int show(const Request& request, Context& context) {
  check(request.contact);
  if (request.output) check_can_write(*request.output);
  const Scan scan = load_scan(request.scan, context);
  require_no_holes(scan);
  warn_if_not_levelled(scan, context);
  warn_about_edges(scan, request.contact, context);
  const auto elasticity = make_operator(request.contact, scan.surface.grid);
  const io::Json settings = settings_json(request.contact);

  std::optional<FieldsFile> file;
  if (request.output)
    file.emplace(*request.output, context, scan, settings, methods_of(request.contact));
  io::Json object = json_head(context, scan);
  object["nx"] = scan.surface.grid.nx;
  object["ny"] = scan.surface.grid.ny;
  object.update(settings);
  object["states"] = io::Json::array();
  Table rows = table();
  int code = kDone;
  for (const double pressure : request.contact.pressures) {
    try {
      const ContactResult result =
          solve(*elasticity, scan.surface.height, pressure, request.contact, context);
      const io::Json state = state_json(result);
      if (file) file->add_state(object["states"].size(), state, fields_of(result.state));
      object["states"].push_back(state);
      rows.row(row_of(result));
      if (!result.state.convergence.converged) code = kNotConverged;
    } catch (const Interrupted&) {
      context.warn("interrupted: only the states that were finished are shown");
      code = kInterrupted;
      break;
    }
  }
  if (file) file->commit();
  return finish(context, object, describe(scan) + describe(request.contact) + '\n' + rows.text(),
                code);
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
            declare_output(set, request->output);
            return [request](Context& context) { return show(*request, context); };
          }};
}

}  // namespace tabor::cli
