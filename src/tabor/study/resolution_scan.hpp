#pragma once

#include <string>
#include <vector>

#include "tabor/cases/records.hpp"
#include "tabor/cases/settings.hpp"
#include "tabor/engine/run_options.hpp"
#include "tabor/topography/topography.hpp"

// Computes wet share and friction on coarser pixels and behind low-passes, to show how far they
// depend on the resolution of the surface.
namespace tabor::study {

/// Friction of the surface after one more step of treatment.
struct ResolutionRecord {
  std::string step;    ///< "resample=256,256", "lowpass=gauss:5.36um"; "" as it is
  double pixel_x = 0;  ///< [m]
  cases::FrictionRecord friction;
};
const Columns<ResolutionRecord>& resolution_columns();

/// Returns the records of the surface as it is, and before them those of pixels four times and
/// twice as large (area averages), after them those behind Gaussian low-passes of 4, 8 and 16
/// pixels; all in the order of `as_measured`. Where the wet share changes by more than a fifth from
/// pixels twice as large to its own, a record of `as_measured` gets a warning. Throws InputError
/// for a surface of less than 64 pixels along a side and for oil that flows, and as friction_of()
/// does.
std::vector<ResolutionRecord> resolution_scan(const topography::Topography& surface,
                                              const cases::CaseSettings& settings,
                                              std::vector<cases::FrictionRecord>& as_measured,
                                              const engine::RunOptions& options = {});

}  // namespace tabor::study
