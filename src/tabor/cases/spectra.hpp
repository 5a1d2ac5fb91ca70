#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tabor/cases/warning.hpp"
#include "tabor/core/convergence.hpp"
#include "tabor/core/mean.hpp"
#include "tabor/metrology/spectra/correlation.hpp"
#include "tabor/metrology/spectra/height_differences.hpp"
#include "tabor/metrology/spectra/mean_spectrum.hpp"
#include "tabor/metrology/spectra/psd.hpp"
#include "tabor/metrology/spectra/reliability.hpp"
#include "tabor/topography/topography.hpp"

// Computes the spectra and correlations of a surface and averages the spectra of several.
namespace tabor::cases {

/// What is computed of a surface beside its power spectra.
struct SpectraSettings {
  metrology::PsdOptions psd;
  std::optional<double> tip_radius = {};  ///< of a probing tip [m]
  bool autocorrelation = false;
  bool height_differences = false;
};

/// Spectra and correlations of one surface, as far as they were asked for.
struct SpectraRecord {
  std::optional<metrology::PowerSpectra> spectra;  ///< none of a surface with holes
  std::optional<metrology::Autocorrelation> acf;
  std::optional<metrology::HeightDifferences> hdf;
  double mean_square = 0;  ///< [m^2], of the valid heights about their mean
  metrology::TrustedRange trusted;
  bool with_tip = false;                ///< a tip radius was given
  Warnings warnings;                    ///< of the exponents
  std::vector<std::string> references;  ///< to cite
};

/// Computes them. A surface with holes has no spectra where autocorrelation or height differences
/// are asked for; else it throws InputError, as metrology::power_spectra() does.
SpectraRecord spectra_of(const topography::Topography& surface, const SpectraSettings& settings,
                         const Observer& observer = {});

/// Means of one group of scans. Profiles have only one of x and y, and no radial one.
struct GroupSpectra {
  std::string name;
  std::vector<std::string> scans;
  std::optional<metrology::MeanSpectrum> x, y, radial;
  Mean rms_height;  ///< [m]
};

/// Averages the spectra of a group. Throws InputError for a scan without spectra.
GroupSpectra mean_of(const std::string& name, const std::vector<std::string>& scans,
                     const std::vector<const SpectraRecord*>& records);

}  // namespace tabor::cases
