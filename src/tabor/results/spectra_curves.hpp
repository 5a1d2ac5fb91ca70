#pragma once

#include <vector>

#include "tabor/cases/spectra.hpp"
#include "tabor/io/text/json.hpp"
#include "tabor/results/curves.hpp"

// Writes the spectra and correlations of one surface or of a group as curves and as JSON.
namespace tabor::results {

/// Returns the curves of an output file.
std::vector<Curve> curves_of(const cases::SpectraRecord& record);
std::vector<Curve> curves_of(const cases::GroupSpectra& group);

/// Returns all curves with their numbers: {"convention", ..., "x", "y", "radial", ..., "trusted",
/// "acf", "hdf"}, without those that were not asked for.
io::Json json_of(const cases::SpectraRecord& record);
/// Returns {"group", "scans", "rms_height_m": {..}, "x": {"q_rad_per_m", "mean", "std", "n",
/// "unit"}, ..}
io::Json json_of(const cases::GroupSpectra& group);

}  // namespace tabor::results
