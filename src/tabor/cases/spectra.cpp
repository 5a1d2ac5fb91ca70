#include "tabor/cases/spectra.hpp"

#include <algorithm>

#include "tabor/cases/warnings.hpp"
#include "tabor/core/error.hpp"
#include "tabor/metrology/areal/parameters.hpp"
#include "tabor/spectral/fft.hpp"
#include "tabor/topography/geometry.hpp"

namespace tabor::cases {

using metrology::PowerSpectra;
using metrology::Spectrum;

namespace {

/// The mean of one of the spectra; nullopt where none of the scans has it.
std::optional<metrology::MeanSpectrum> mean_over(const std::vector<const SpectraRecord*>& records,
                                                 Spectrum PowerSpectra::*which) {
  std::vector<Spectrum> spectra;
  spectra.reserve(records.size());
  for (const SpectraRecord* one : records) spectra.push_back(*one->spectra.*which);
  const bool is_absent = std::all_of(spectra.begin(), spectra.end(),
                                     [](const Spectrum& one) { return one.q.empty(); });
  if (is_absent) return std::nullopt;
  return metrology::mean_spectrum(spectra);
}

}  // namespace

SpectraRecord spectra_of(const topography::Topography& surface, const SpectraSettings& settings,
                         const Observer& observer) {
  SpectraRecord record;
  const std::optional<topography::Topography> scan = topography::scan_of_images(surface);
  const topography::Topography& measured = scan ? *scan : surface;  // images know no longer waves
  record.trusted = metrology::trusted_range(measured.height, measured.grid, settings.tip_radius);
  record.with_tip = settings.tip_radius.has_value();
  const bool needs_spectra = !settings.autocorrelation && !settings.height_differences;
  if (needs_spectra || topography::count_holes(surface) == 0) {
    record.spectra = metrology::power_spectra(surface, settings.psd);
    record.warnings = of_spectra(*record.spectra);
    record.references = {"jacobs2017", spectral::transform_reference()};
  }
  if (record.with_tip) record.references.emplace_back("sanner2022");
  if (settings.autocorrelation) {
    record.acf = metrology::autocorrelation(surface.height, surface.grid);
  }
  if (settings.height_differences) {
    record.hdf = metrology::height_differences(surface.height, surface.grid, observer);
    const double rms = metrology::rms_height(surface);
    record.mean_square = rms * rms;
  }
  return record;
}

GroupSpectra mean_of(const std::string& name, const std::vector<std::string>& scans,
                     const std::vector<const SpectraRecord*>& records) {
  std::vector<double> heights;
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (!records[i]->spectra) {
      throw InputError("group " + name, scans[i] + " without a spectrum", "scans without holes",
                       "<fill=harmonic> fills the holes");
    }
    heights.push_back(records[i]->spectra->rms_height);
  }
  return {.name = name,
          .scans = scans,
          .x = mean_over(records, &PowerSpectra::x),
          .y = mean_over(records, &PowerSpectra::y),
          .radial = mean_over(records, &PowerSpectra::radial),
          .rms_height = tabor::mean_of(heights)};
}

}  // namespace tabor::cases
