#include "tabor/cli/psd_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tabor/cli/result.hpp"
#include "tabor/cli/table.hpp"
#include "tabor/core/error.hpp"

namespace tabor::cli {

namespace {

using metrology::Autocorrelation;
using metrology::HeightDifference;
using metrology::PowerSpectra;
using metrology::Spectrum;

// Keys name SI units; the unit of the chosen convention stands beside them.
io::Json json_of(const Spectrum& spectrum, const std::string& density_key) {
  if (spectrum.q.empty()) return nullptr;  // a profile has no other direction
  return {{"q_rad_per_m", spectrum.q},
          {density_key, spectrum.density},
          {"unit", spectrum.unit},
          {"hurst", io::number(spectrum.hurst.hurst)},
          {"hurst_standard_error", io::number(spectrum.hurst.standard_error)},
          {"fit_q_min_rad_per_m", spectrum.hurst.q_min},
          {"fit_q_max_rad_per_m", spectrum.hurst.q_max},
          {"fit_bins", spectrum.hurst.n_bins}};
}

/// A Hurst exponent with its error; "-" where no range of scales is long enough for one.
std::string exponent(const metrology::HurstFit& fit) {
  if (!std::isfinite(fit.hurst)) return "-";
  return plain(fit.hurst, 3) + " ± " + plain(fit.standard_error, 1);
}

/// The same with the error that is a lower bound.
std::string exponent(const metrology::DifferenceHurst& fit) {
  if (!std::isfinite(fit.hurst)) return "-";
  return plain(fit.hurst, 3) + " ± " + plain(fit.standard_error, 1) + " or more";
}

/// The range of a fit; "no range" where there is none.
template <typename Fit>
std::string range_of(const Fit& fit, const std::string& range) {
  return std::isfinite(fit.hurst) ? range : "no range";
}

void add_row(const std::string& name, const Spectrum& spectrum, Table& table) {
  if (spectrum.q.empty()) return;
  const metrology::HurstFit& fit = spectrum.hurst;
  table.row({name, exponent(fit),
             range_of(fit, fmt::format("{:.3g} to {:.3g} rad/m", fit.q_min, fit.q_max)),
             fmt::format("{}", fit.n_bins), si(spectrum.rms_height, "m"),
             fmt::format("{} [{}]", spectrum.density.size(), spectrum.unit)});
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
  const metrology::CorrelationLengths lengths = metrology::correlation_lengths(acf);
  const auto aspect = lengths.texture_aspect();
  const bool has_bound = !aspect && !topography::is_profile(acf.grid());
  return {{"lag_x_m", lags(acf.grid().nx, acf.grid().dx())},
          {"acf_x", numbers(profile(acf, true))},
          {"lag_y_m", lags(acf.grid().ny, acf.grid().dy())},
          {"acf_y", numbers(profile(acf, false))},
          {"mean_square_m2", acf.mean_square()},
          {"sal_m", io::number(lengths.shortest)},
          {"str", aspect ? io::Json(*aspect) : io::Json()},
          {"str_below", has_bound ? io::Json(lengths.texture_bound()) : io::Json()}};
}

io::Json json_of(const HeightDifference& difference, double mean_square) {
  if (difference.lag.empty()) return nullptr;
  const metrology::DifferenceHurst fit = metrology::fit_hurst(difference, mean_square);
  return {{"lag_m", difference.lag},
          {"mean_square_m2", difference.mean_square},
          {"pairs", difference.pairs},
          {"hurst", io::number(fit.hurst)},
          {"hurst_standard_error", io::number(fit.standard_error)},
          {"hurst_standard_error_is_lower_bound", true},
          {"fit_lag_min_m", fit.lag_min},
          {"fit_lag_max_m", fit.lag_max},
          {"fit_bins", fit.n_bins}};
}

io::Json json_of(const metrology::TrustedRange& range) {
  return {{"shortest_wavelength_m", range.shortest},
          {"longest_wavelength_m", range.longest},
          {"shortest_is_limited_by", range.tip_limits ? "tip" : "pixel"}};
}

void add_row(const std::string& name, const HeightDifference& difference, double mean_square,
             Table& table) {
  if (difference.lag.empty()) return;
  const metrology::DifferenceHurst fit = metrology::fit_hurst(difference, mean_square);
  table.row({name, exponent(fit),
             range_of(fit, fmt::format("{} to {}", si(fit.lag_min, "m"), si(fit.lag_max, "m"))),
             fmt::format("{}", fit.n_bins), "-", fmt::format("{} [m^2]", difference.lag.size())});
}

void describe(const PowerSpectra& spectra, Facts& facts) {
  facts.fact("convention", std::string(name_of(spectra.convention)));
  facts.fact("window",
             std::string(name_of(spectra.window)) +
                 fmt::format(" (changes the variance {:.3g} times)", spectra.window_gain));
  facts.fact("rms height", si(spectra.rms_height, "m"));
  facts.fact("rms slope", plain(spectra.rms_slope));
}

void describe(const metrology::TrustedRange& range, bool with_tip, Facts& facts) {
  const std::string from = range.tip_limits ? "what the tip leaves" : "4 pixels";
  facts.fact("trust", range.shortest < range.longest
                          ? fmt::format("wavelengths {} to {} (rule of thumb: {} to a quarter of "
                                        "the side{})",
                                        si(range.shortest, "m"), si(range.longest, "m"), from,
                                        with_tip ? "" : "; --tip-radius judges a probing tip")
                          : fmt::format("no wavelength: from {} ({}) would be above {}, a quarter "
                                        "of the side",
                                        si(range.shortest, "m"), from, si(range.longest, "m")));
}

/// "m^3" -> "m3", for names of columns.
std::string in_a_name(std::string unit) {
  std::erase(unit, '^');
  return unit;
}

/// The exponent of a density, beside it in a file.
std::vector<std::pair<std::string, double>> attributes_of(const metrology::HurstFit& fit) {
  if (!std::isfinite(fit.hurst)) return {};
  return {{"hurst", fit.hurst},
          {"hurst_standard_error", fit.standard_error},
          {"fit_min_rad_per_m", fit.q_min},
          {"fit_max_rad_per_m", fit.q_max}};
}

void add_columns(std::vector<Curve>& columns, const std::string& name, const Spectrum& spectrum) {
  if (spectrum.q.empty()) return;
  columns.push_back({"q_" + name + "_rad_per_m", "rad/m", "wavevector, " + name, spectrum.q});
  columns.push_back({"psd_" + name + "_" + in_a_name(spectrum.unit), spectrum.unit,
                     "power spectral density, " + name, spectrum.density,
                     attributes_of(spectrum.hurst)});
}

void add_columns(std::vector<Curve>& columns, const std::string& name,
                 const HeightDifference& difference) {
  if (difference.lag.empty()) return;
  columns.push_back({"lag_hdf_" + name + "_m", "m", "lag, " + name, difference.lag});
  columns.push_back({"hdf_" + name + "_m2", "m^2", "mean square height difference, " + name,
                     difference.mean_square});
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

}  // namespace

void add_curves(io::Json& object, const PsdCurves& curves) {
  if (curves.spectra) add_spectra(object, *curves.spectra);
  object["trusted"] = json_of(curves.trusted);
  if (curves.acf) object["acf"] = json_of(*curves.acf);
  if (curves.hdf) {
    object["hdf"] = {{"x", json_of(curves.hdf->x, curves.mean_square)},
                     {"y", json_of(curves.hdf->y, curves.mean_square)},
                     {"radial", json_of(curves.hdf->radial, curves.mean_square)}};
  }
}

std::string text_of(const Scan& scan, const PsdCurves& curves) {
  Facts facts;
  describe(scan, facts);
  if (curves.spectra) describe(*curves.spectra, facts);
  describe(curves.trusted, curves.with_tip, facts);
  if (curves.acf) {
    const auto lengths = metrology::correlation_lengths(*curves.acf);
    const auto aspect = lengths.texture_aspect();
    const std::string texture =
        topography::is_profile(curves.acf->grid())
            ? ""
            : ", Str " + (aspect ? plain(*aspect) : "< " + plain(lengths.texture_bound()));
    facts.fact("autocorrelation", "Sal " + si(lengths.shortest, "m") + texture);
  }
  Table table({"curve", "Hurst exponent", "fitted over", "bins", "rms height", "points"});
  if (curves.spectra) {
    add_row("C1D along x", curves.spectra->x, table);
    add_row("C1D along y", curves.spectra->y, table);
    add_row("C2D radial", curves.spectra->radial, table);
  }
  if (curves.hdf) {
    add_row("differences along x", curves.hdf->x, curves.mean_square, table);
    add_row("differences along y", curves.hdf->y, curves.mean_square, table);
    add_row("differences, radial", curves.hdf->radial, curves.mean_square, table);
  }
  return facts.text() + (curves.spectra || curves.hdf ? '\n' + table.text() : "");
}

std::vector<Curve> columns_of(const PsdCurves& curves) {
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

namespace {

/// The mean of one of the spectra; nullopt where none of the scans has it.
std::optional<metrology::MeanSpectrum> mean_over(const std::vector<const PsdCurves*>& curves,
                                                 Spectrum PowerSpectra::*which) {
  std::vector<Spectrum> spectra;
  spectra.reserve(curves.size());
  for (const PsdCurves* one : curves) spectra.push_back(*one->spectra.*which);
  const bool is_absent = std::all_of(spectra.begin(), spectra.end(),
                                     [](const Spectrum& one) { return one.q.empty(); });
  if (is_absent) return std::nullopt;
  return metrology::mean_spectrum(spectra);
}

/// One of the numbers of a mean at each wavevector.
template <typename Number>
std::vector<double> numbers_of(const metrology::MeanSpectrum& mean, Number Mean::*which) {
  std::vector<double> numbers;
  for (const Mean& one : mean.density) numbers.push_back(static_cast<double>(one.*which));
  return numbers;
}

io::Json json_of(const Mean& mean) {
  return {{"mean", io::number(mean.mean)},
          {"std", io::number(mean.standard_deviation)},
          {"sem", io::number(mean.standard_error)},
          {"n", mean.n}};
}

io::Json numbers_json(const std::vector<double>& numbers) {
  io::Json list = io::Json::array();
  for (const double one : numbers) list.push_back(io::number(one));
  return list;
}

io::Json json_of(const std::optional<metrology::MeanSpectrum>& mean) {
  if (!mean) return nullptr;
  return {{"q_rad_per_m", mean->q},
          {"mean", numbers_json(numbers_of(*mean, &Mean::mean))},
          {"std", numbers_json(numbers_of(*mean, &Mean::standard_deviation))},
          {"n", mean->density.front().n},
          {"unit", mean->unit}};
}

void add_columns(std::vector<Curve>& columns, const std::string& name,
                 const std::optional<metrology::MeanSpectrum>& mean) {
  if (!mean) return;
  const std::string key = "psd_" + name + "_" + in_a_name(mean->unit);
  columns.push_back({"q_" + name + "_rad_per_m", "rad/m", "wavevector, " + name, mean->q});
  columns.push_back({key + "_mean", mean->unit, "mean power spectral density, " + name,
                     numbers_of(*mean, &Mean::mean)});
  columns.push_back({key + "_std", mean->unit, "its standard deviation, " + name,
                     numbers_of(*mean, &Mean::standard_deviation)});
}

}  // namespace

GroupSpectra mean_of(const std::string& name, const std::vector<std::string>& scans,
                     const std::vector<const PsdCurves*>& curves) {
  std::vector<double> heights;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (!curves[i]->spectra) {
      throw InputError("group " + name, scans[i] + " without a spectrum", "scans without holes",
                       "add --fill harmonic");
    }
    heights.push_back(curves[i]->spectra->rms_height);
  }
  return {.name = name,
          .scans = scans,
          .x = mean_over(curves, &PowerSpectra::x),
          .y = mean_over(curves, &PowerSpectra::y),
          .radial = mean_over(curves, &PowerSpectra::radial),
          .rms_height = tabor::mean_of(heights)};
}

std::vector<Curve> columns_of(const GroupSpectra& group) {
  std::vector<Curve> columns;
  add_columns(columns, "x", group.x);
  add_columns(columns, "y", group.y);
  add_columns(columns, "radial", group.radial);
  return columns;
}

io::Json json_of(const GroupSpectra& group) {
  return {
      {"group", group.name},   {"scans", group.scans},  {"rms_height_m", json_of(group.rms_height)},
      {"x", json_of(group.x)}, {"y", json_of(group.y)}, {"radial", json_of(group.radial)}};
}

std::string text_of(const std::vector<GroupSpectra>& groups) {
  Table table({"group", "scans", "rms height, mean", "standard deviation", "points, x y radial"});
  const auto points = [](const std::optional<metrology::MeanSpectrum>& mean) {
    return mean ? fmt::format("{}", mean->q.size()) : std::string("-");
  };
  for (const GroupSpectra& group : groups) {
    table.row({group.name, fmt::format("{}", group.scans.size()), si(group.rms_height.mean, "m"),
               std::isnan(group.rms_height.standard_deviation)
                   ? "-"
                   : si(group.rms_height.standard_deviation, "m"),
               fmt::format("{} {} {}", points(group.x), points(group.y), points(group.radial))});
  }
  return table.text();
}

}  // namespace tabor::cli
