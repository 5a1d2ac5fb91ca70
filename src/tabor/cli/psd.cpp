#include <fmt/format.h>

#include <memory>

#include "tabor/cli/result.hpp"
#include "tabor/cli/table.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/topography/psd.hpp"

namespace tabor::cli {

namespace {

using topography::PowerSpectra;
using topography::Spectrum;

struct Request {
  ScanRequest scan;
  std::string convention = "jacobs";
  std::string window;  ///< "": none for a periodic surface, else hann
  std::optional<double> fit_min;
  std::optional<double> fit_max;
};

// Keys name SI units; the unit of the chosen convention stands beside them.
io::Json json_of(const Spectrum& spectrum, const std::string& density_key) {
  return {{"q_rad_per_m", spectrum.q},
          {density_key, spectrum.density},
          {"unit", spectrum.unit},
          {"hurst", io::number(spectrum.hurst.hurst)},
          {"hurst_standard_error", io::number(spectrum.hurst.standard_error)},
          {"fit_q_min_rad_per_m", spectrum.hurst.q_min},
          {"fit_q_max_rad_per_m", spectrum.hurst.q_max},
          {"fit_bins", spectrum.hurst.n_bins}};
}

std::vector<std::string> row_of(const std::string& name, const Spectrum& spectrum) {
  const topography::HurstFit& fit = spectrum.hurst;
  return {name,
          plain(fit.hurst, 3) + " ± " + plain(fit.standard_error, 1),
          fmt::format("{:.3g} to {:.3g} rad/m", fit.q_min, fit.q_max),
          fmt::format("{}", fit.n_bins),
          si(spectrum.rms_height, "m"),
          fmt::format("{} [{}]", spectrum.density.size(), spectrum.unit)};
}

std::string text_of(const Scan& scan, const PowerSpectra& spectra) {
  Facts facts;
  describe(scan, facts);
  facts.fact("convention", std::string(name_of(spectra.convention)));
  facts.fact("window",
             std::string(name_of(spectra.window)) +
                 fmt::format(" (changes the variance {:.3g} times)", spectra.window_gain));
  facts.fact("rms height", si(spectra.rms_height, "m"));
  facts.fact("rms slope", plain(spectra.rms_slope));
  Table table({"spectrum", "Hurst exponent", "fitted over", "bins", "rms height", "points"});
  table.row(row_of("C1D along x", spectra.x));
  table.row(row_of("C1D along y", spectra.y));
  table.row(row_of("C2D radial", spectra.radial));
  return facts.text() + '\n' + table.text();
}

topography::PsdOptions options_of(const Request& request) {
  return {.convention = *topography::psd_convention_from(request.convention),
          .window = topography::psd_window_from(request.window),
          .fit_q_min = request.fit_min,
          .fit_q_max = request.fit_max};
}

int show(const Request& request, Context& context) {
  const Scan scan = load_scan(request.scan, context);
  require_no_holes(scan);
  warn_if_not_levelled(scan, context);
  const PowerSpectra spectra = topography::power_spectra(scan.surface, options_of(request));
  io::Json object = json_head(context, scan);
  object["convention"] = name_of(spectra.convention);
  object["window"] = name_of(spectra.window);
  object["window_gain"] = spectra.window_gain;
  object["x"] = json_of(spectra.x, "c1d_m3");
  object["y"] = json_of(spectra.y, "c1d_m3");
  object["radial"] = json_of(spectra.radial, spectra.radial.unit == "m^3" ? "w_m3" : "c2d_m4");
  object["rms_height_m"] = spectra.rms_height;
  object["rms_slope"] = spectra.rms_slope;
  return finish(context, object, text_of(scan, spectra));
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
}

}  // namespace

Verb psd_verb() {
  return {.name = "psd",
          .arguments = "SCAN [options]",
          .summary = "power spectra along x, along y and radial, with fitted Hurst exponents",
          .details = "The spectra themselves are in the JSON object.",
          .examples = {"tabor psd surfaces/edt_before.x3p --level plane",
                       "tabor psd surfaces/edt_before.x3p --level plane --window none --json"},
          .declare = [](OptionSet& set) -> Action {
            const auto request = std::make_shared<Request>();
            declare_options(set, *request);
            return [request](Context& context) { return show(*request, context); };
          }};
}

}  // namespace tabor::cli
