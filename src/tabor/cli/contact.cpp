#include <memory>
#include <optional>

#include "tabor/cases/parameters.hpp"
#include "tabor/cli/contact_request.hpp"
#include "tabor/cli/lowpass_scan.hpp"
#include "tabor/cli/parameter_options.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/core/error.hpp"

namespace tabor::cli {

namespace {

struct Request {
  ScanRequest scan;
  cases::CaseSettings settings;
  FieldsRequest file;
  std::vector<double> cutoffs;           ///< of --lowpass-scan
  std::optional<double> shear_strength;  ///< [Pa], for its friction
};

io::Json histogram_json(const contact::Histogram& histogram, const std::string& edge_key) {
  return {{edge_key, histogram.edges}, {"count", histogram.counts}};
}

/// Contact stiffness and histograms, where --statistics asks for them.
io::Json statistics_json(const cases::ContactRecord& record) {
  if (!record.statistics) return io::Json::object();
  const cases::ContactStatistics& statistics = *record.statistics;
  return {{"contact_stiffness_Pa_per_m", io::number(statistics.stiffness.value)},
          {"pressure_histogram", histogram_json(statistics.pressure, "edge_Pa")},
          {"gap_histogram", histogram_json(statistics.gap, "edge_m")},
          {"patch_area_histogram", histogram_json(statistics.patch_area, "edge_m2")}};
}

/// Returns the columns of the table; the separation is one where it is asked for.
Columns<cases::ContactRecord> shown_columns(const Request& request) {
  Columns<cases::ContactRecord> columns = cases::contact_columns();
  for (Column<cases::ContactRecord>& column : columns) {
    const bool is_asked = column.key == "separation_m" && !request.settings.separations.empty();
    if (is_asked) column.heading = "separation";
  }
  return columns;
}

void check_all(const Request& request, bool boundary_is_known) {
  check(cases::objection_to_controls(request.settings, boundary_is_known, flag_of));
  check_contact(request.settings);
  if (!request.cutoffs.empty() && request.settings.mean_pressures.empty()) {
    throw UsageError("--lowpass-scan needs --pressure");
  }
  if (request.file.output && !request.cutoffs.empty()) {
    throw UsageError("--lowpass-scan keeps no maps; leave out -o");
  }
}

int show(Request request, Context& context) {
  check_all(request, false);
  find_tool(request.settings.contact, context);
  const Scan scan = read_scan(request.scan, context);
  require_no_holes(scan);
  cases::ContactSettings& contact = request.settings.contact;  // a file may say its edges, too
  check(cases::objection(contact, scan.surface.edges, flag_of));
  contact.take_edges(scan.surface.edges);
  check_all(request, true);
  if (!request.cutoffs.empty()) {
    return run_lowpass_scan(scan, request.settings, request.cutoffs, request.shear_strength,
                            request.file.csv, context);
  }
  const cases::ContactSettings& settings = request.settings.contact;
  auto file = fields_file(request.file, context, scan, settings);
  io::Json object = json_head(context, scan);
  object["nx"] = scan.surface.grid.nx;
  object["ny"] = scan.surface.grid.ny;
  object.update(results::settings_json(settings));
  object["states"] = io::Json::array();
  std::vector<cases::ContactRecord> records;  // without their maps
  std::vector<results::Case> cases;
  int code = kDone;
  const auto receive = [&](cases::ContactRecord&& record) {
    if (file) file->add(records.size(), record);
    object["states"].push_back(
        io::json_of(cases::contact_columns(), record, cases::media::kObject));
    object["states"].back().update(statistics_json(record));
    cases.push_back(results::case_of(record));
    if (!record.convergence.converged()) code = kNotConverged;
    record.state = {};
    records.push_back(std::move(record));
  };
  const int ended = until_interrupted(context, [&] {
    const auto elasticity = cases::make_operator(settings, scan.surface.grid);
    cases::contact_states(*elasticity, scan.surface, settings, cases::controls_of(request.settings),
                          receive, context.observer());
  });
  if (ended == kInterrupted && records.empty()) throw Interrupted();
  context.warn(results::findings_of(cases));
  if (file) file->commit(context.warnings);
  Facts facts;
  describe(scan, facts);
  describe(settings, facts);
  const std::string text = facts.text() + '\n' + table_of(shown_columns(request), records).text();
  return finish(context, object,
                write_csv(request.file.csv, states_csv(cases::contact_columns(), records), text),
                ended == kInterrupted ? ended : code);
}

void declare_extras(OptionSet& set, cases::ContactSettings& settings) {
  declare(set, parameter_of(cases::contact_parameters(), "load_path"), settings);
  set.toggle("--statistics",
             "add contact stiffness and histograms of pressure, gap and patch area to --json",
             settings.statistics);
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
               dimension::pressure, request.shear_strength)
      .only_with = "--lowpass-scan";
}

}  // namespace

Verb contact_verb() {
  return {
      .name = "contact",
      .arguments =
          "SCAN --pressure P|--separation D|--force F --youngs-modulus E --poisson-ratio NU "
          "[options]",
      .summary = "real contact area, gap, patches and saturated share under a pressure",
      .details =
          "A rigid flat is pressed on the rough half-space. The certificate bounds the "
          "energy error. 'contact area' is corrected for the pixels of its perimeter, "
          "'counted contact' is the share of the pixels that touch. With --separation the flat "
          "stands at a given height and the pressure follows. With --tool a rough tool presses in "
          "place of the flat.",
      .examples = {"tabor contact surfaces/edt_before.x3p --level plane --pressure 2MPa,7MPa "
                   "--youngs-modulus 70GPa --poisson-ratio 0.33 --saturation-pressure 240MPa",
                   "tabor contact surfaces/edt_before.x3p --level plane --lowpass gauss:8um "
                   "--pressure 7MPa --youngs-modulus 70GPa --poisson-ratio 0.33 -o contact.h5",
                   "tabor contact surfaces/edt_before.x3p --level plane --lowpass gauss:8um "
                   "--separation 1um,0.8um --youngs-modulus 70GPa --poisson-ratio 0.33",
                   "tabor contact surfaces/edt_before.x3p --level plane --pressure 7MPa "
                   "--material aluminium-6016 --tool ground:Sa=0.1um"},
      .declare = [](OptionSet& set) -> Action {
        const auto request = std::make_shared<Request>();
        declare_scan(set, request->scan);
        declare_contact(set, request->settings, Controls::all);
        declare_extras(set, request->settings.contact);
        declare_lowpass_scan(set, *request);
        declare_fields(set, request->file);
        return [request](Context& context) {
          take_edges(request->scan, request->settings.contact);
          return show(*request, context);
        };
      }};
}

}  // namespace tabor::cli
