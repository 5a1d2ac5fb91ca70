#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>

#include "tabor/cli/psd_curves.hpp"
#include "tabor/cli/result.hpp"
#include "tabor/cli/table.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/topography/correlation.hpp"
#include "tabor/topography/parameters.hpp"
#include "tabor/topography/psd.hpp"
#include "tabor/topography/reliability.hpp"

namespace tabor::cli {

namespace {

using topography::Autocorrelation;
using topography::HeightDifference;
using topography::HeightDifferences;
using topography::PowerSpectra;
using topography::Spectrum;

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

/// Everything that was asked for; without filled holes there are no spectra.
struct Curves {
  std::optional<PowerSpectra> spectra;
  std::optional<Autocorrelation> acf;
  std::optional<HeightDifferences> hdf;
  double mean_square = 0;  ///< [m^2], of the valid heights about their mean
  topography::TrustedRange trusted;
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
  const bool found = std::isfinite(fit.hurst);  // else no range of scales is long enough
  return {name,
          found ? plain(fit.hurst, 3) + " ± " + plain(fit.standard_error, 1) : "-",
          found ? fmt::format("{:.3g} to {:.3g} rad/m", fit.q_min, fit.q_max) : "no range",
          fmt::format("{}", fit.n_bins),
          si(spectrum.rms_height, "m"),
          fmt::format("{} [{}]", spectrum.density.size(), spectrum.unit)};
}

/// Autocorrelation along an axis, from zero lag.
std::vector<double> profile(const Autocorrelation& acf, bool along_x) {
  std::vector<double> values;
  const Index n = along_x ? acf.grid().nx : acf.grid().ny;
  for (Index k = 0; k < n; ++k) values.push_back(along_x ? acf(0, k) : acf(k, 0));
  return values;
}

std::vector<double> lags(Index n, double pixel) {
  std::vector<double> values;
  for (Index k = 0; k < n; ++k) values.push_back(static_cast<double>(k) * pixel);
  return values;
}

io::Json json_of(const Autocorrelation& acf) {
  const auto numbers = [](const std::vector<double>& values) {
    io::Json list = io::Json::array();
    for (const double value : values) list.push_back(io::number(value));
    return list;
  };
  const topography::CorrelationLengths lengths = topography::correlation_lengths(acf);
  const auto aspect = lengths.texture_aspect();
  return {{"lag_x_m", lags(acf.grid().nx, acf.grid().dx())},
          {"acf_x", numbers(profile(acf, true))},
          {"lag_y_m", lags(acf.grid().ny, acf.grid().dy())},
          {"acf_y", numbers(profile(acf, false))},
          {"mean_square_m2", acf.mean_square()},
          {"sal_m", io::number(lengths.shortest)},
          {"str", aspect ? io::Json(*aspect) : io::Json()},
          {"str_below", aspect ? io::Json() : io::Json(lengths.texture_bound())}};
}

io::Json json_of(const HeightDifference& difference, double mean_square) {
  const topography::DifferenceHurst fit = topography::fit_hurst(difference, mean_square);
  return {{"lag_m", difference.lag},
          {"mean_square_m2", difference.mean_square},
          {"pairs", difference.pairs},
          {"hurst", io::number(fit.hurst)},
          {"hurst_standard_error", io::number(fit.standard_error)},
          {"fit_lag_min_m", fit.lag_min},
          {"fit_lag_max_m", fit.lag_max},
          {"fit_bins", fit.n_bins}};
}

io::Json json_of(const topography::TrustedRange& range) {
  return {{"shortest_wavelength_m", range.shortest},
          {"longest_wavelength_m", range.longest},
          {"shortest_is_limited_by", range.tip_limits ? "tip" : "pixel"}};
}

std::vector<std::string> row_of(const std::string& name, const HeightDifference& difference,
                                double mean_square) {
  const topography::DifferenceHurst fit = topography::fit_hurst(difference, mean_square);
  return {name,
          plain(fit.hurst, 3) + " ± " + plain(fit.standard_error, 1),
          fmt::format("{} to {}", si(fit.lag_min, "m"), si(fit.lag_max, "m")),
          fmt::format("{}", fit.n_bins),
          "-",
          fmt::format("{} [m^2]", difference.lag.size())};
}

void describe(const PowerSpectra& spectra, Facts& facts) {
  facts.fact("convention", std::string(name_of(spectra.convention)));
  facts.fact("window",
             std::string(name_of(spectra.window)) +
                 fmt::format(" (changes the variance {:.3g} times)", spectra.window_gain));
  facts.fact("rms height", si(spectra.rms_height, "m"));
  facts.fact("rms slope", plain(spectra.rms_slope));
}

void describe(const topography::TrustedRange& range, bool with_tip, Facts& facts) {
  facts.fact(
      "trust",
      fmt::format("wavelengths {} to {} (rule of thumb: {} to a quarter of the "
                  "side{})",
                  si(range.shortest, "m"), si(range.longest, "m"),
                  range.tip_limits ? "what the tip leaves" : "4 pixels",
                  with_tip || range.tip_limits ? "" : "; --tip-radius judges a probing tip"));
}

std::string text_of(const Request& request, const Scan& scan, const Curves& curves) {
  Facts facts;
  describe(scan, facts);
  if (curves.spectra) describe(*curves.spectra, facts);
  describe(curves.trusted, request.tip_radius.has_value(), facts);
  if (curves.acf) {
    const auto lengths = topography::correlation_lengths(*curves.acf);
    const auto aspect = lengths.texture_aspect();
    facts.fact("autocorrelation",
               fmt::format("Sal {}, Str {}", si(lengths.shortest, "m"),
                           aspect ? plain(*aspect) : "< " + plain(lengths.texture_bound())));
  }
  Table table({"curve", "Hurst exponent", "fitted over", "bins", "rms height", "points"});
  if (curves.spectra) {
    table.row(row_of("C1D along x", curves.spectra->x));
    table.row(row_of("C1D along y", curves.spectra->y));
    table.row(row_of("C2D radial", curves.spectra->radial));
  }
  if (curves.hdf) {
    table.row(row_of("differences along x", curves.hdf->x, curves.mean_square));
    table.row(row_of("differences along y", curves.hdf->y, curves.mean_square));
    table.row(row_of("differences, radial", curves.hdf->radial, curves.mean_square));
  }
  return facts.text() + (curves.spectra || curves.hdf ? '\n' + table.text() : "");
}

/// "m^3" -> "m3", for names of columns.
std::string in_a_name(std::string unit) {
  std::erase(unit, '^');
  return unit;
}

void add_columns(std::vector<Curve>& columns, const std::string& name, const Spectrum& spectrum) {
  columns.push_back({"q_" + name + "_rad_per_m", "rad/m", "wavevector, " + name, spectrum.q});
  columns.push_back({"psd_" + name + "_" + in_a_name(spectrum.unit), spectrum.unit,
                     "power spectral density, " + name, spectrum.density});
}

void add_columns(std::vector<Curve>& columns, const std::string& name,
                 const HeightDifference& difference) {
  columns.push_back({"lag_hdf_" + name + "_m", "m", "lag, " + name, difference.lag});
  columns.push_back({"hdf_" + name + "_m2", "m^2", "mean square height difference, " + name,
                     difference.mean_square});
}

std::vector<Curve> columns_of(const Curves& curves) {
  std::vector<Curve> columns;
  if (curves.spectra) {
    add_columns(columns, "x", curves.spectra->x);
    add_columns(columns, "y", curves.spectra->y);
    add_columns(columns, "radial", curves.spectra->radial);
  }
  if (curves.hdf) {
    add_columns(columns, "x", curves.hdf->x);
    add_columns(columns, "y", curves.hdf->y);
    add_columns(columns, "radial", curves.hdf->radial);
  }
  if (curves.acf) {
    const Grid& grid = curves.acf->grid();
    columns.push_back({"lag_acf_x_m", "m", "lag, x", lags(grid.nx, grid.dx())});
    columns.push_back({"acf_x", "1", "autocorrelation, x", profile(*curves.acf, true)});
    columns.push_back({"lag_acf_y_m", "m", "lag, y", lags(grid.ny, grid.dy())});
    columns.push_back({"acf_y", "1", "autocorrelation, y", profile(*curves.acf, false)});
  }
  return columns;
}

topography::PsdOptions options_of(const Request& request) {
  return {.convention = *topography::psd_convention_from(request.convention),
          .window = topography::psd_window_from(request.window),
          .fit_q_min = request.fit_min,
          .fit_q_max = request.fit_max};
}

Curves compute(const Request& request, const Scan& scan, Context& context) {
  const topography::Topography& surface = scan.surface;
  const bool holes = topography::count_holes(surface) > 0;
  if (!request.acf && !request.hdf) require_no_holes(scan);
  Curves curves;
  curves.trusted = topography::trusted_range(surface.height, surface.grid, request.tip_radius);
  if (holes) {
    context.warn("no power spectra: they need every height (--fill harmonic)");
  } else {
    curves.spectra = topography::power_spectra(surface, options_of(request));
  }
  if (request.acf) curves.acf = topography::autocorrelation(surface.height, surface.grid);
  if (request.hdf) {
    curves.hdf = topography::height_differences(surface.height, surface.grid, context.observer());
    const double rms = topography::rms_height(surface);
    curves.mean_square = rms * rms;
  }
  return curves;
}

void add_spectra(io::Json& object, const PowerSpectra& spectra) {
  object["convention"] = name_of(spectra.convention);
  object["window"] = name_of(spectra.window);
  object["window_gain"] = spectra.window_gain;
  object["x"] = json_of(spectra.x, "c1d_m3");
  object["y"] = json_of(spectra.y, "c1d_m3");
  object["radial"] = json_of(spectra.radial, spectra.radial.unit == "m^3" ? "w_m3" : "c2d_m4");
  object["rms_height_m"] = spectra.rms_height;
  object["rms_slope"] = spectra.rms_slope;
}

int show(const Request& request, Context& context) {
  if (request.output) check_curves_file(*request.output);
  const Scan scan = load_scan(request.scan, context);
  const Curves curves = compute(request, scan, context);
  warn_if_not_levelled(scan, context);
  io::Json object = json_head(context, scan);
  if (curves.spectra) add_spectra(object, *curves.spectra);
  object["trusted"] = json_of(curves.trusted);
  if (curves.acf) object["acf"] = json_of(*curves.acf);
  if (curves.hdf) {
    object["hdf"] = {{"x", json_of(curves.hdf->x, curves.mean_square)},
                     {"y", json_of(curves.hdf->y, curves.mean_square)},
                     {"radial", json_of(curves.hdf->radial, curves.mean_square)}};
  }
  std::string text = text_of(request, scan, curves);
  if (request.output) {
    write_curves(columns_of(curves), *request.output, context);
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
  set.text("--output", "OUT", "write all curves as columns of a .csv or datasets of an .h5 file",
           request.output)
      .short_flag = "-o";
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
