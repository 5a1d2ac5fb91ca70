#include <fmt/format.h>

#include <memory>
#include <optional>

#include "tabor/cases/warnings.hpp"
#include "tabor/cli/csv_output.hpp"
#include "tabor/cli/psd_result.hpp"
#include "tabor/cli/result.hpp"
#include "tabor/cli/scan_groups.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/core/error.hpp"
#include "tabor/metrology/parameters.hpp"

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
struct Measured {
  PsdCurves curves;
  io::Json object;
  std::string text;
  results::Case doubts;
};

metrology::PsdOptions options_of(const Request& request) {
  if (request.fit_min && request.fit_max && !(*request.fit_min < *request.fit_max)) {
    throw UsageError("--fit-min and --fit-max: expected a range, the smaller one first");
  }
  return {.convention = *metrology::psd_convention_from(request.convention),
          .window = metrology::psd_window_from(request.window),
          .fit_q_min = request.fit_min,
          .fit_q_max = request.fit_max};
}

PsdCurves compute(const Request& request, const Scan& scan, Context& context) {
  const topography::Topography& surface = scan.surface;
  const bool holes = topography::count_holes(surface) > 0;
  if (!request.acf && !request.hdf) require_no_holes(scan);
  PsdCurves curves;
  curves.trusted = metrology::trusted_range(surface.height, surface.grid, request.tip_radius);
  curves.with_tip = request.tip_radius.has_value();
  if (holes) {
    context.warn("no power spectra: they need every height (--fill harmonic)");
  } else {
    curves.spectra = metrology::power_spectra(surface, options_of(request));
  }
  if (request.acf) curves.acf = metrology::autocorrelation(surface.height, surface.grid);
  if (request.hdf) {
    curves.hdf = metrology::height_differences(surface.height, surface.grid, context.observer());
    const double rms = metrology::rms_height(surface);
    curves.mean_square = rms * rms;
  }
  return curves;
}

/// Keys of references.bib.
std::vector<std::string> methods_of(const PsdCurves& curves) {
  std::vector<std::string> methods;
  if (curves.spectra) methods = {"jacobs2017", "frigo2005"};
  if (curves.with_tip) methods.emplace_back("sanner2022");
  return methods;
}

Measured measure(const Request& request, const std::string& file, Context& context) {
  ScanRequest one = request.scan;
  one.file = file;
  const Scan scan = read_scan(one, context);
  Measured measured{.curves = compute(request, scan, context),
                    .object = json_head(context, scan),
                    .text = {},
                    .doubts = doubts_of(scan)};
  if (measured.curves.spectra) {
    add(cases::of_spectra(*measured.curves.spectra), measured.doubts.warnings);
  }
  add_curves(measured.object, measured.curves);
  measured.text = text_of(scan, measured.curves);
  return measured;
}

void warn_of(const std::vector<Measured>& all, Context& context) {
  std::vector<results::Case> cases;
  cases.reserve(all.size());
  for (const Measured& one : all) cases.push_back(one.doubts);
  results::shorten_paths(cases);
  context.warn(results::findings_of(cases));
}

std::vector<GroupSpectra> means_of(const std::vector<GroupMembers>& groups, const Request& request,
                                   const std::vector<Measured>& all) {
  std::vector<GroupSpectra> means;
  for (const GroupMembers& group : groups) {
    std::vector<std::string> scans;
    std::vector<const PsdCurves*> curves;
    for (const std::size_t place : group.places) {
      scans.push_back(request.files[place]);
      curves.push_back(&all[place].curves);
    }
    means.push_back(mean_of(group.name, scans, curves));
  }
  return means;
}

bool is_one(const Request& request) { return request.files.size() == 1 && request.groups.empty(); }

/// Those of each scan and of each group.
std::vector<CurveSet> curve_sets(const Request& request, const std::vector<Measured>& all,
                                 const std::vector<GroupSpectra>& groups) {
  if (is_one(request)) return {{.curves = columns_of(all.front().curves)}};
  std::vector<CurveSet> sets;
  const std::vector<std::string> names = headings(request.files);
  for (std::size_t i = 0; i < all.size(); ++i) {
    sets.push_back({.place = fmt::format("/scans/{:04}", i),
                    .heading = names[i],
                    .attributes = {{"file", {request.files[i]}}},
                    .curves = columns_of(all[i].curves)});
  }
  for (std::size_t i = 0; i < groups.size(); ++i) {
    sets.push_back({.place = fmt::format("/groups/{:04}", i),
                    .heading = groups[i].name,
                    .attributes = {{"group", {groups[i].name}}, {"scans", groups[i].scans}},
                    .curves = columns_of(groups[i])});
  }
  return sets;
}

io::Json json_of(const std::vector<Measured>& all, const std::vector<GroupSpectra>& groups,
                 const Context& context) {
  io::Json object = json_head(context);
  for (Measured one : all) {
    one.object.erase("tabor_version");
    one.object.erase("command");
    object["scans"].push_back(one.object);
  }
  for (const GroupSpectra& group : groups) object["groups"].push_back(json_of(group));
  return object;
}

int show(const Request& request, Context& context) {
  const std::vector<GroupMembers> members = members_of(request.groups, request.files);
  std::vector<Measured> all;
  std::string text;
  for (const std::string& file : request.files) {
    all.push_back(measure(request, file, context));
    text += (text.empty() ? "" : "\n") + all.back().text;
  }
  warn_of(all, context);
  const std::vector<GroupSpectra> groups = means_of(members, request, all);
  io::Json object = is_one(request) ? all.front().object : json_of(all, groups, context);
  if (!groups.empty()) text += '\n' + text_of(groups);
  const std::vector<CurveSet> sets = curve_sets(request, all, groups);
  if (request.output) {
    write_curves(sets, *request.output, context, methods_of(all.front().curves));
    object["output"] = *request.output;
    text += "written " + *request.output + '\n';
  }
  const std::string csv = request.csv.is_asked() ? csv_of(sets) : "";
  return finish(context, object, write_csv(request.csv, csv, text));
}

void declare_options(OptionSet& set, Request& request) {
  declare_scans(set, request.scan, request.files);
  declare_groups(set, request.groups);
  set.group("Spectrum");
  set.choice("--psd-convention", {"jacobs", "persson", "gwyddion"},
             "normalisation [jacobs: Jacobs, Junge & Pastewka 2017]", request.convention);
  set.choice("--window", {"none", "hann"},
             "taper against edges that do not match [none where they do, else hann]",
             request.window);
  set.quantity("--fit-min", "Q",
               "smallest wavevector of the Hurst fit, 2 pi/wavelength, e.g. 0.1/um",
               dimension::wavevector, request.fit_min);
  set.quantity("--fit-max", "Q", "largest wavevector of the Hurst fit", dimension::wavevector,
               request.fit_max);
  set.quantity("--tip-radius", "R",
               "of a probing tip: says at which wavelengths it shows, e.g. 2um", dimension::length,
               request.tip_radius);
  set.toggle("--acf", "also the autocorrelation, Sal and Str (holes may stay)", request.acf);
  set.toggle("--hdf", "also mean square height differences over the lag (holes may stay)",
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
          .summary = "power spectra along x, along y and radial, with fitted Hurst exponents",
          .details =
              "The curves themselves are in the JSON object, in the -o file and in --csv. Several "
              "scans are treated alike; --group adds the mean of their spectra.",
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
