#include "tabor/results/spectra_curves.hpp"

#include <cmath>
#include <optional>
#include <utility>

namespace tabor::results {

using cases::GroupSpectra;
using cases::SpectraRecord;
using metrology::Autocorrelation;
using metrology::HeightDifference;
using metrology::PowerSpectra;
using metrology::Spectrum;

namespace {

io::Json numbers_json(const std::vector<double>& numbers) {
  io::Json list = io::Json::array();
  for (const double one : numbers) list.push_back(io::number(one));
  return list;
}

// Keys name SI units; the unit of the chosen convention stands beside them.
io::Json spectrum_json(const Spectrum& spectrum, const std::string& density_key) {
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

io::Json acf_json(const Autocorrelation& acf) {
  const metrology::CorrelationLengths lengths = metrology::correlation_lengths(acf);
  const auto aspect = lengths.texture_aspect();
  const bool has_bound = !aspect && !topography::is_profile(acf.grid());
  return {{"lag_x_m", lags(acf.grid().nx, acf.grid().dx())},
          {"acf_x", numbers_json(profile(acf, true))},
          {"lag_y_m", lags(acf.grid().ny, acf.grid().dy())},
          {"acf_y", numbers_json(profile(acf, false))},
          {"mean_square_m2", acf.mean_square()},
          {"sal_m", io::number(lengths.shortest)},
          {"str", aspect ? io::Json(*aspect) : io::Json()},
          {"str_below", has_bound ? io::Json(lengths.texture_bound()) : io::Json()}};
}

io::Json differences_json(const HeightDifference& difference, double mean_square) {
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

io::Json trusted_json(const metrology::TrustedRange& range) {
  return {{"shortest_wavelength_m", range.shortest},
          {"longest_wavelength_m", range.longest},
          {"shortest_is_limited_by", range.tip_limits ? "tip" : "pixel"}};
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

void add_curves(std::vector<Curve>& columns, const std::string& name, const Spectrum& spectrum) {
  if (spectrum.q.empty()) return;
  columns.push_back({"q_" + name + "_rad_per_m", "rad/m", "wavevector, " + name, spectrum.q});
  columns.push_back({"psd_" + name + "_" + in_a_name(spectrum.unit), spectrum.unit,
                     "power spectral density, " + name, spectrum.density,
                     attributes_of(spectrum.hurst)});
}

void add_curves(std::vector<Curve>& columns, const std::string& name,
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
  object["x"] = spectrum_json(spectra.x, "c1d_m3");
  object["y"] = spectrum_json(spectra.y, "c1d_m3");
  object["radial"] =
      spectrum_json(spectra.radial, spectra.radial.unit == "m^3" ? "w_m3" : "c2d_m4");
  object["rms_height_m"] = spectra.rms_height;
  object["rms_slope"] = spectra.rms_slope;
}

/// One of the numbers of a mean at each wavevector.
template <typename Number>
std::vector<double> numbers_of(const metrology::MeanSpectrum& mean, Number Mean::*which) {
  std::vector<double> numbers;
  for (const Mean& one : mean.density) numbers.push_back(static_cast<double>(one.*which));
  return numbers;
}

io::Json statistics_json(const Mean& mean) {
  return {{"mean", io::number(mean.mean)},
          {"std", io::number(mean.standard_deviation)},
          {"sem", io::number(mean.standard_error)},
          {"n", mean.n}};
}

io::Json mean_json(const std::optional<metrology::MeanSpectrum>& mean) {
  if (!mean) return nullptr;
  return {{"q_rad_per_m", mean->q},
          {"mean", numbers_json(numbers_of(*mean, &Mean::mean))},
          {"std", numbers_json(numbers_of(*mean, &Mean::standard_deviation))},
          {"n", mean->density.front().n},
          {"unit", mean->unit}};
}

void add_curves(std::vector<Curve>& columns, const std::string& name,
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

io::Json json_of(const SpectraRecord& record) {
  io::Json object = io::Json::object();
  if (record.spectra) add_spectra(object, *record.spectra);
  object["trusted"] = trusted_json(record.trusted);
  if (record.acf) object["acf"] = acf_json(*record.acf);
  if (record.hdf) {
    object["hdf"] = {{"x", differences_json(record.hdf->x, record.mean_square)},
                     {"y", differences_json(record.hdf->y, record.mean_square)},
                     {"radial", differences_json(record.hdf->radial, record.mean_square)}};
  }
  return object;
}

std::vector<Curve> curves_of(const SpectraRecord& record) {
  std::vector<Curve> curves;
  if (record.spectra) {
    add_curves(curves, "x", record.spectra->x);
    add_curves(curves, "y", record.spectra->y);
    add_curves(curves, "radial", record.spectra->radial);
  }
  if (record.hdf) {
    add_curves(curves, "x", record.hdf->x);
    add_curves(curves, "y", record.hdf->y);
    add_curves(curves, "radial", record.hdf->radial);
  }
  if (record.acf) {
    const Grid& grid = record.acf->grid();
    curves.push_back({"lag_acf_x_m", "m", "lag, x", lags(grid.nx, grid.dx())});
    curves.push_back({"acf_x", "1", "autocorrelation, x", profile(*record.acf, true)});
    curves.push_back({"lag_acf_y_m", "m", "lag, y", lags(grid.ny, grid.dy())});
    curves.push_back({"acf_y", "1", "autocorrelation, y", profile(*record.acf, false)});
  }
  return curves;
}

std::vector<Curve> curves_of(const GroupSpectra& group) {
  std::vector<Curve> curves;
  add_curves(curves, "x", group.x);
  add_curves(curves, "y", group.y);
  add_curves(curves, "radial", group.radial);
  return curves;
}

io::Json json_of(const GroupSpectra& group) {
  return {{"group", group.name},
          {"scans", group.scans},
          {"rms_height_m", statistics_json(group.rms_height)},
          {"x", mean_json(group.x)},
          {"y", mean_json(group.y)},
          {"radial", mean_json(group.radial)}};
}

}  // namespace tabor::results
