#include <memory>
#include <optional>

#include "tabor/cli/psd_result.hpp"
#include "tabor/cli/result.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/core/error.hpp"
#include "tabor/metrology/parameters.hpp"

namespace tabor::cli {

namespace {

struct Request {
  ScanRequest scan;
  std::string convention = "jacobs";
  std::string window;  ///< "": none for a periodic surface, else hann
  std::optional<double> fit_min;
  std::optional<double> fit_max;
  std::optional<double> tip_radius;  ///< [m]
  bool acf = false;
  bool hdf = false;
  std::optional<std::string> output;
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

int show(const Request& request, Context& context) {
  const Scan scan = read_scan(request.scan, context);
  const PsdCurves curves = compute(request, scan, context);
  context.warn(analysis::findings_of({doubts_of(scan)}));
  if (curves.spectra) {
    const std::string warning = warning_about_exponents(*curves.spectra);
    if (!warning.empty()) context.warn(warning);
  }
  io::Json object = json_head(context, scan);
  add_curves(object, curves);
  std::string text = text_of(scan, curves);
  if (request.output) {
    write_curves(columns_of(curves), *request.output, context, methods_of(curves));
    object["output"] = *request.output;
    text += "written " + *request.output + '\n';
  }
  return finish(context, object, text);
}

void declare_options(OptionSet& set, Request& request) {
  declare_scan(set, request.scan);
  set.group("Spectrum");
  set.choice("--psd-convention", {"jacobs", "persson", "gwyddion"},
             "normalisation [jacobs: Jacobs, Junge & Pastewka 2017]", request.convention);
  set.choice("--window", {"none", "hann"},
             "taper against edges that do not match [none if periodic, else hann]", request.window);
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
}

}  // namespace

Verb psd_verb() {
  return {.name = "psd",
          .arguments = "SCAN [options]",
          .summary = "power spectra along x, along y and radial, with fitted Hurst exponents",
          .details = "The curves themselves are in the JSON object and in the -o file.",
          .examples = {"tabor psd surfaces/edt_before.x3p --level plane",
                       "tabor psd surfaces/edt_before.x3p --level plane --window none --json",
                       "tabor psd surfaces/edt_before.x3p --level plane --acf --hdf -o curves.csv"},
          .declare = [](OptionSet& set) -> Action {
            const auto request = std::make_shared<Request>();
            declare_options(set, *request);
            return [request](Context& context) { return show(*request, context); };
          }};
}

}  // namespace tabor::cli
