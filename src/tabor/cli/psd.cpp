#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "tabor/cli/csv_output.hpp"
#include "tabor/cli/each_scan.hpp"
#include "tabor/cli/psd_text.hpp"
#include "tabor/cli/result.hpp"
#include "tabor/cli/scan_groups.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/core/error.hpp"
#include "tabor/results/parameter_tables.hpp"
#include "tabor/results/spectra_curves.hpp"

namespace tabor::cli {

namespace {

struct Request {
  ScanRequest scan;  ///< how each of the files is read and treated
  std::vector<std::string> files;
  std::vector<ScanGroup> groups;
  std::string convention = "jacobs";
  std::string window;  ///< "": none where edges match, else hann
  std::optional<double> fit_min;
  std::optional<double> fit_max;
  std::optional<double> tip_radius;  ///< [m]
  bool acf = false;
  bool hdf = false;
  std::optional<std::string> output;
  CsvRequest csv;
};

/// One scan of a run.
struct Measured {  // NOLINT(bugprone-exception-escape): moving JSON checks an assertion
  cases::SpectraRecord record;
  io::Json object;
  std::string text;
  results::Case doubts;
  std::vector<std::string> treatment;  ///< steps
};

cases::SpectraSettings settings_of(const Request& request) {
  if (request.fit_min && request.fit_max && !(*request.fit_min < *request.fit_max)) {
    throw UsageError("--fit-min and --fit-max: expected a range, the smaller one first");
  }
  return {.psd = {.convention = *metrology::psd_convention_from(request.convention),
                  .window = metrology::psd_window_from(request.window),
                  .fit_q_min = request.fit_min,
                  .fit_q_max = request.fit_max},
          .tip_radius = request.tip_radius,
          .autocorrelation = request.acf,
          .height_differences = request.hdf};
}

Measured measure(const Request& request, const std::string& file, const Context& context,
                 const Observer& observer) {
  ScanRequest one = request.scan;
  one.file = file;
  const Scan scan = read_scan(one, context, observer);
  const cases::SpectraSettings settings = settings_of(request);
  if (!request.acf && !request.hdf) require_no_holes(scan);
  Measured measured{.record = cases::spectra_of(scan.surface, settings, observer),
                    .object = json_head(context, scan),
                    .text = {},
                    .doubts = doubts_of(scan),
                    .treatment = scan.treatment};
  add(measured.record.warnings, measured.doubts.warnings);
  measured.object.update(results::json_of(measured.record));
  measured.text = text_of(scan, measured.record);
  return measured;
}

std::vector<Measured> measure_all(const Request& request, const Context& context) {
  return measure_each<Measured>(
      request.files, "psd",
      [&](const std::string& file, const Observer& observer) {
        return measure(request, file, context, observer);
      },
      context);
}

void warn_of(const std::vector<Measured>& all, Context& context) {
  std::vector<results::Case> cases;
  cases.reserve(all.size());
  for (const Measured& one : all) cases.push_back(one.doubts);
  results::shorten_paths(cases);
  context.warn(results::findings_of(cases));
  for (const Measured& one : all) {
    if (!one.record.spectra) {
      context.warn("Power spectra need every height. Fill holes with --fill harmonic");
    }
  }
}

std::vector<cases::GroupSpectra> means_of(const std::vector<GroupMembers>& groups,
                                          const Request& request,
                                          const std::vector<Measured>& all) {
  std::vector<cases::GroupSpectra> means;
  for (const GroupMembers& group : groups) {
    std::vector<std::string> scans;
    std::vector<const cases::SpectraRecord*> records;
    for (const std::size_t place : group.places) {
      scans.push_back(request.files[place]);
      records.push_back(&all[place].record);
    }
    means.push_back(cases::mean_of(group.name, scans, records));
  }
  return means;
}

bool is_one(const Request& request) { return request.files.size() == 1 && request.groups.empty(); }

/// What the curves of one scan depend on, for a file.
std::vector<std::pair<std::string, std::vector<std::string>>> attributes_of(const Measured& one) {
  std::vector<std::pair<std::string, std::vector<std::string>>> attributes;
  if (one.record.spectra) {
    attributes.push_back(
        {"convention", {std::string(metrology::name_of(one.record.spectra->convention))}});
    attributes.push_back({"window", {std::string(metrology::name_of(one.record.spectra->window))}});
  }
  if (!one.treatment.empty()) attributes.push_back({"treatment", one.treatment});
  return attributes;
}

/// Returns the curves of each scan and of each group.
std::vector<results::CurveSet> curve_sets(const Request& request, const std::vector<Measured>& all,
                                          const std::vector<cases::GroupSpectra>& groups) {
  if (is_one(request)) {
    return {{.attributes = attributes_of(all.front()),
             .curves = results::curves_of(all.front().record)}};
  }
  std::vector<results::CurveSet> sets;
  const std::vector<std::string> names = results::headings(request.files);
  for (std::size_t i = 0; i < all.size(); ++i) {
    sets.push_back({.place = fmt::format("/scans/{:04}", i),
                    .heading = names[i],
                    .attributes = attributes_of(all[i]),
                    .curves = results::curves_of(all[i].record)});
    sets.back().attributes.push_back({"file", {request.files[i]}});
  }
  for (std::size_t i = 0; i < groups.size(); ++i) {
    sets.push_back({.place = fmt::format("/groups/{:04}", i),
                    .heading = groups[i].name,
                    .attributes = {{"group", {groups[i].name}}, {"scans", groups[i].scans}},
                    .curves = results::curves_of(groups[i])});
  }
  return sets;
}

io::Json json_of(const std::vector<Measured>& all, const std::vector<cases::GroupSpectra>& groups,
                 const Context& context) {
  io::Json object = json_head(context);
  for (Measured one : all) {
    one.object.erase("tabor_version");
    one.object.erase("command");
    object["scans"].push_back(one.object);
  }
  for (const cases::GroupSpectra& group : groups) {
    object["groups"].push_back(results::json_of(group));
  }
  return object;
}

int show(const Request& request, Context& context) {
  const std::vector<GroupMembers> members = members_of(request.groups, request.files);
  const std::vector<Measured> all = measure_all(request, context);
  std::string text;
  for (const Measured& one : all) text += (text.empty() ? "" : "\n") + one.text;
  warn_of(all, context);
  const std::vector<cases::GroupSpectra> groups = means_of(members, request, all);
  io::Json object = is_one(request) ? all.front().object : json_of(all, groups, context);
  const bool has_window = std::any_of(all.begin(), all.end(), [](const Measured& one) {
    return one.record.spectra && one.record.spectra->window_gain != 1;
  });
  if (!groups.empty()) text += '\n' + text_of(groups, has_window);
  const std::vector<results::CurveSet> sets = curve_sets(request, all, groups);
  if (request.output) {
    results::write_curves(sets, *request.output,
                          head_of(context, "", all.front().record.references), context.warnings);
    object["output"] = *request.output;
    text += "written " + *request.output + '\n';
  }
  const std::string csv = request.csv.is_asked() ? results::csv_of(sets) : "";
  return finish(context, object, write_csv(request.csv, csv, text));
}

void declare_options(OptionSet& set, Request& request) {
  declare_scans(set, request.scan, request.files);
  declare_groups(set, request.groups);
  set.group("Spectrum");
  set.choice("--psd-convention", {"jacobs", "persson", "gwyddion"},
             "normalisation [jacobs: Jacobs, Junge & Pastewka 2017]", request.convention);
  set.choice("--window", {"none", "hann"},
             "taper for edges that do not match [none if they match, else hann]", request.window);
  set.quantity("--fit-min", "Q",
               "smallest wavevector of the Hurst fit, 2 pi/wavelength, e.g. 0.1/um",
               dimension::wavevector, request.fit_min);
  set.quantity("--fit-max", "Q", "largest wavevector of the Hurst fit", dimension::wavevector,
               request.fit_max);
  set.quantity("--tip-radius", "R",
               "radius of the probing tip, to show which wavelengths it changes, e.g. 2um",
               dimension::length, request.tip_radius);
  set.toggle("--acf", "add the autocorrelation, Sal and Str (allows holes)", request.acf);
  set.toggle("--hdf", "add mean square height differences over the lag (allows holes)",
             request.hdf);
  set.group("Output");
  std::vector<std::string> extensions = hdf5_extensions();
  extensions.insert(extensions.begin(), ".csv");
  set.output("OUT", "write all curves as columns of a .csv or datasets of an .h5 file", extensions,
             request.output);
  declare_csv(set, "the curves as columns", request.csv);
}

}  // namespace

Verb psd_verb() {
  return {.name = "psd",
          .arguments = "SCAN [SCAN...] [options]",
          .summary = "compute power spectra along x, along y and radially, with Hurst exponents",
          .details =
              "--json, -o and --csv hold the curves themselves. Several scans are treated in the "
              "same way; --group adds the mean of their spectra.",
          .examples = {"tabor psd surfaces/edt_before.x3p --level plane",
                       "tabor psd surfaces/edt_before.x3p --level plane --window none --json",
                       "tabor psd surfaces/edt_before.x3p --level plane --acf --hdf -o curves.csv",
                       "tabor psd surfaces/edt_before.x3p surfaces/edt_after.x3p --level plane "
                       "--group 'edt=edt_*' --csv spectra.csv"},
          .declare = [](OptionSet& set) -> Action {
            const auto request = std::make_shared<Request>();
            declare_options(set, *request);
            return [request](Context& context) { return show(*request, context); };
          }};
}

}  // namespace tabor::cli
