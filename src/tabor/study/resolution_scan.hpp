#pragma once

#include <string>
#include <vector>

#include "tabor/analysis/records.hpp"
#include "tabor/analysis/settings.hpp"
#include "tabor/study/run_options.hpp"
#include "tabor/topography/topography.hpp"

// How far wet share and friction depend on the pixel and on the finest wavelength of a surface.
namespace tabor::study {

/// Friction of the surface behind one more step of treatment.
struct ResolutionRecord {
  std::string step;    ///< "resample=256,256", "lowpass=gauss:5.36um"; "" as it is
  double pixel_x = 0;  ///< [m]
  analysis::FrictionRecord friction;
};
const Columns<ResolutionRecord>& resolution_columns();

/// The records of the surface as it is, and before them those of pixels four times and twice as
/// large (area averages), after them those behind Gaussian low-passes of 4, 8 and 16 pixels; all in
/// the order of `as_measured`. Where the wet share changes by more than a fifth from pixels twice
/// as large to its own, a record of `as_measured` gets a warning. Throws InputError for a surface
/// of less than 64 pixels along a side and for oil that flows, and as friction_of() does.
std::vector<ResolutionRecord> resolution_scan(const topography::Topography& surface,
                                              const analysis::CaseSettings& settings,
                                              std::vector<analysis::FrictionRecord>& as_measured,
                                              const RunOptions& options = {});

}  // namespace tabor::study
