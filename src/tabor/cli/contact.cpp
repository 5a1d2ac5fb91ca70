#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tabor/cases/parameters.hpp"
#include "tabor/cli/contact_request.hpp"
#include "tabor/cli/lowpass_scan.hpp"
#include "tabor/cli/parameter_options.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/core/error.hpp"
#include "tabor/results/parameter_tables.hpp"

namespace tabor::cli {

namespace {

struct Request {
  ScanRequest scan;  ///< how each of the files is read and treated
  std::vector<std::string> files;
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

/// Reads one scan; its file may say what its edges are, too.
Scan prepared(Request& request, const std::string& path, Context& context) {
  request.scan.file = path;
  Scan scan = read_scan(request.scan, context);
  require_no_holes(scan);
  cases::ContactSettings& contact = request.settings.contact;
  check(cases::objection(contact, scan.surface.edges));
  contact.take_edges(scan.surface.edges);
  check_all(request, true);
  return scan;
}

/// Forces, in the order of the states, and the surface that they press on.
std::string words_of(const std::vector<double>& forces, const Grid& grid) {
  std::vector<std::string> each;
  each.reserve(forces.size());
  for (const double force : forces) each.push_back(si(force, "N"));
  return fmt::format("{} on {} x {}", fmt::join(each, ", "), si(grid.lx, "m"), si(grid.ly, "m"));
}

/// The states of one scan, ready for every kind of output.
struct Solved {  // NOLINT(bugprone-exception-escape): moving JSON checks an assertion
  std::string path;
  std::string facts;
  io::Json object;
  std::vector<cases::ContactRecord> records = {};  ///< without their maps
  std::vector<results::Case> cases = {};
  int code = kDone;
};

Solved solve(Request request, const std::string& path, Context& context) {
  const Scan scan = prepared(request, path, context);
  const cases::ContactSettings& settings = request.settings.contact;
  auto file = fields_file(request.file, context, scan, settings);
  Solved solved{.path = path, .facts = {}, .object = json_head(context, scan)};
  io::Json& object = solved.object;
  object["nx"] = scan.surface.grid.nx;
  object["ny"] = scan.surface.grid.ny;
  object.update(results::settings_json(settings));
  object["states"] = io::Json::array();
  const auto receive = [&](cases::ContactRecord&& record) {
    if (file) file->add(solved.records.size(), record);
    object["states"].push_back(
        io::json_of(cases::contact_columns(), record, cases::media::kObject));
    object["states"].back().update(statistics_json(record));
    solved.cases.push_back(results::case_of(record));
    if (!record.convergence.converged()) solved.code = kNotConverged;
    record.state = {};
    solved.records.push_back(std::move(record));
  };
  const int ended = until_interrupted(context, [&] {
    const auto elasticity = cases::make_operator(settings, scan.surface.grid);
    cases::contact_states(*elasticity, scan.surface, settings, cases::controls_of(request.settings),
                          receive, context.observer());
  });
  if (ended == kInterrupted && solved.records.empty()) throw Interrupted();
  if (ended == kInterrupted) solved.code = ended;
  if (file) {
    context.warn(results::findings_of(solved.cases));
    file->commit(context.warnings);
  }
  Facts facts;
  describe(scan, facts);
  describe(settings, facts);
  if (!request.settings.forces.empty()) {
    facts.fact("force", words_of(request.settings.forces, scan.surface.grid));
  }
  solved.facts = facts.text();
  return solved;
}

int show_one(const Request& request, Context& context) {
  const Solved solved = solve(request, request.files.front(), context);
  context.warn(results::findings_of(solved.cases));
  const std::string text =
      solved.facts + '\n' + table_of(shown_columns(request), solved.records).text();
  return finish(
      context, solved.object,
      write_csv(request.file.csv, states_csv(cases::contact_columns(), solved.records), text),
      solved.code);
}

/// A state in a table of several scans.
struct ScanState {
  std::string scan;
  cases::ContactRecord record;
};

Columns<ScanState> with_scan(const Columns<cases::ContactRecord>& columns) {
  return joined<ScanState>({{"scan", "", "scan", &ScanState::scan}},
                           within(columns, &ScanState::record));
}

/// What cannot be read is told and does not end the others.
std::vector<Solved> solve_each(const Request& request, Context& context) {
  std::vector<Solved> all;
  const int ended = until_interrupted(
      context,
      [&] {
        for (const std::string& path : request.files) {
          try {
            all.push_back(solve(request, path, context));
          } catch (const InputError& error) {
            const std::string problem = context.spelled(error.what());
            Solved failed{.path = path, .facts = {}, .object = {}};
            failed.object = {{"scan", {{"path", path}, {"sha256", nullptr}}}, {"failure", problem}};
            failed.code = kInput;
            all.push_back(failed);
            context.warn("not computed: " + problem);
          }
          if (all.back().code == kInterrupted) return;
        }
      },
      "scans");
  if (all.empty()) throw Interrupted();
  if (ended != kDone) all.back().code = ended;
  return all;
}

/// Interrupted before bad input before not converged.
int worse(int a, int b) {
  for (const int code : {int{kInterrupted}, int{kInput}, int{kNotConverged}}) {
    if (a == code || b == code) return code;
  }
  return kDone;
}

int show_many(const Request& request, Context& context) {
  const std::vector<std::string> names = results::headings(request.files);
  std::vector<Solved> all = solve_each(request, context);
  io::Json object = json_head(context);
  std::vector<ScanState> rows;
  std::vector<results::Case> cases;
  int code = kDone;
  for (std::size_t i = 0; i < all.size(); ++i) {
    Solved& one = all[i];
    code = worse(code, one.code);
    for (const char* key : {"tabor_version", "command", "defaults"}) one.object.erase(key);
    object["scans"].push_back(one.object);
    for (cases::ContactRecord& record : one.records) rows.push_back({names[i], std::move(record)});
    for (results::Case& found : one.cases) {
      found.surface = names[i];
      cases.push_back(std::move(found));
    }
  }
  context.warn(results::findings_of(cases));
  const std::string text = table_of(with_scan(shown_columns(request)), rows).text();
  const std::string csv = states_csv(with_scan(cases::contact_columns()), rows);
  return finish(context, object, write_csv(request.file.csv, csv, text), code);
}

void check_for_one_scan(const Request& request) {
  if (request.files.size() < 2) return;
  if (request.file.output) {
    throw UsageError("-o stores the maps of one scan; 'tabor sweep' stores those of several");
  }
  if (!request.cutoffs.empty()) throw UsageError("--lowpass-scan takes one scan");
}

int show(Request request, Context& context) {
  check_for_one_scan(request);
  if (request.settings.contact.statistics && !context.json) {
    throw UsageError("--statistics adds to the JSON object; give --json, too");
  }
  check_all(request, false);
  find_tool(request.settings.contact, context);
  if (request.files.size() > 1) return show_many(request, context);
  if (request.cutoffs.empty()) return show_one(request, context);
  const Scan scan = prepared(request, request.files.front(), context);
  return run_lowpass_scan(scan, request.settings, request.cutoffs, request.shear_strength,
                          request.file.csv, context);
}

void declare_extras(OptionSet& set, cases::ContactSettings& settings) {
  declare(set, parameter_of(cases::contact_parameters(), "load_path"), settings);
  set.toggle("--statistics",
             "add contact stiffness and histograms of pressure, gap and patch area to --json",
             settings.statistics);
}

void declare_lowpass_scan(OptionSet& set, Request& request) {
  set.group("Dependence on the resolution");
  set.add({.flag = "--lowpass-scan",
           .placeholder = "C[,C2,...]",
           .help = "repeat with '--lowpass hann:C/L' for rising C to find where the area no longer "
                   "changes, e.g. 64,128,256,512",
           .assign = [&](const std::string& text) { request.cutoffs = parse_cutoffs(text); }});
  set.quantity("--shear-strength", "TAU", "add dry friction to the low-pass scan",
               dimension::pressure, request.shear_strength)
      .only_with = "--lowpass-scan";
}

}  // namespace

// NOLINTBEGIN(bugprone-suspicious-missing-comma): examples of several lines
Verb contact_verb() {
  return {
      .name = "contact",
      .arguments =
          "SCAN [SCAN...] --pressure P|--separation D|--force F "
          "--material NAME|--youngs-modulus E --poisson-ratio NU [options]",
      .summary = "compute the real contact area, gap and patches under a pressure",
      .details =
          "A rigid flat is pressed on the rough half-space. The certificate bounds the error of "
          "the energy. The contact area is corrected for the pixels at its perimeter; the counted "
          "contact is the share of pixels that touch. With --separation you give the height of "
          "the flat, and the pressure follows. With --tool a rough tool replaces the flat. "
          "Several scans make one table.",
      .examples = {"tabor contact surfaces/edt_before.x3p --level plane --pressure 2MPa,7MPa "
                   "--youngs-modulus 70GPa --poisson-ratio 0.33 --saturation-pressure 240MPa",
                   "tabor contact surfaces/edt_before.x3p --level plane --lowpass gauss:8um "
                   "--pressure 7MPa --youngs-modulus 70GPa --poisson-ratio 0.33 -o contact.h5",
                   "tabor contact surfaces/edt_before.x3p --level plane --lowpass gauss:8um "
                   "--separation 1um,0.8um --youngs-modulus 70GPa --poisson-ratio 0.33",
                   "tabor contact surfaces/edt_before.x3p --level plane --pressure 7MPa "
                   "--material aluminium-6016 --tool ground:Sa=0.1um",
                   "tabor contact surfaces/edt_before.x3p surfaces/edt_after.x3p --level plane "
                   "--pressure 7MPa --material aluminium-6016"},
      .declare = [](OptionSet& set) -> Action {
        const auto request = std::make_shared<Request>();
        declare_scans(set, request->scan, request->files);
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
// NOLINTEND(bugprone-suspicious-missing-comma)

}  // namespace tabor::cli
