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

namespace tabor::cli {

/// Everything that was asked for; without filled holes there are no spectra.
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

/// Facts and a table for people.
std::string text_of(const Scan& scan, const PsdCurves& curves);

/// The columns of an output file.
std::vector<Curve> columns_of(const PsdCurves& curves);

/// The means of one group of scans; of profiles there is one of x and y, and no radial one.
struct GroupSpectra {
  std::string name;
  std::vector<std::string> scans;
  std::optional<metrology::MeanSpectrum> x, y, radial;
  Mean rms_height;  ///< [m]
};

/// Throws InputError for a scan without spectra.
GroupSpectra mean_of(const std::string& name, const std::vector<std::string>& scans,
                     const std::vector<const PsdCurves*>& curves);
std::vector<Curve> columns_of(const GroupSpectra& group);
/// {"group", "scans", "rms_height_m": {..}, "x": {"q_rad_per_m", "mean", "std", "n", "unit"}, ..}
io::Json json_of(const GroupSpectra& group);
/// One row per group.
std::string text_of(const std::vector<GroupSpectra>& groups);

}  // namespace tabor::cli
