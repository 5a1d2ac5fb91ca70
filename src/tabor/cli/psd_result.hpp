#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tabor/cli/psd_curves.hpp"
#include "tabor/cli/scan.hpp"
#include "tabor/io/json.hpp"
#include "tabor/metrology/correlation.hpp"
#include "tabor/metrology/height_differences.hpp"
#include "tabor/metrology/mean_spectrum.hpp"
#include "tabor/metrology/psd.hpp"
#include "tabor/metrology/reliability.hpp"

// Prints the spectra and correlations of `tabor psd`, of one scan or averaged over groups.
namespace tabor::cli {

/// Results of one scan, as far as they were asked for; a scan with holes has no spectra.
struct PsdCurves {
  std::optional<metrology::PowerSpectra> spectra;
  std::optional<metrology::Autocorrelation> acf;
  std::optional<metrology::HeightDifferences> hdf;
  double mean_square = 0;  ///< [m^2], of the valid heights about their mean
  metrology::TrustedRange trusted;
  bool with_tip = false;  ///< a tip radius was given
};

/// Adds all curves with their numbers to the JSON object of the verb.
void add_curves(io::Json& object, const PsdCurves& curves);

/// Returns facts and a table, as text.
std::string text_of(const Scan& scan, const PsdCurves& curves);

/// Returns the columns of an output file.
std::vector<Curve> columns_of(const PsdCurves& curves);

/// Means of one group of scans. Profiles have only one of x and y, and no radial one.
struct GroupSpectra {
  std::string name;
  std::vector<std::string> scans;
  std::optional<metrology::MeanSpectrum> x, y, radial;
  Mean rms_height;  ///< [m]
};

/// Averages the spectra of a group. Throws InputError for a scan without spectra.
GroupSpectra mean_of(const std::string& name, const std::vector<std::string>& scans,
                     const std::vector<const PsdCurves*>& curves);
std::vector<Curve> columns_of(const GroupSpectra& group);
/// Returns {"group", "scans", "rms_height_m": {..}, "x": {"q_rad_per_m", "mean", "std", "n",
/// "unit"}, ..}
io::Json json_of(const GroupSpectra& group);
/// Returns one row per group.
std::string text_of(const std::vector<GroupSpectra>& groups);

}  // namespace tabor::cli
