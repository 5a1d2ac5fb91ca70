#pragma once

#include <string>
#include <vector>

#include "tabor/cli/table.hpp"
#include "tabor/io/text/json.hpp"
#include "tabor/results/density_answer.hpp"
#include "tabor/study/density_curves.hpp"

// Prints curves of friction against the density of the lubricant, as JSON and as text.
namespace tabor::cli {

/// Returns the object `density_curve` of `tabor friction --json`.
io::Json json_of(const cases::DensityCurve& curve, const std::vector<results::AskedDensity>& asked);

/// Adds the line "density at 7 MPa", "the pockets under the contacts are full from ...".
void describe(const cases::DensityCurve& curve, const std::vector<results::AskedDensity>& asked,
              Facts& facts);

/// Returns the table of a study, one column per pressure: where the plateau of each group begins
/// and ends, and for each density whether it lies below, on or beyond it, with the wet share. Empty
/// without curves.
std::string places_text(const std::vector<study::GroupCurve>& curves);

}  // namespace tabor::cli
