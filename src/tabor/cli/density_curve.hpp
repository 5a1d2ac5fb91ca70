#pragma once

#include <string>
#include <vector>

#include "tabor/analysis/density_curve.hpp"
#include "tabor/cli/table.hpp"
#include "tabor/io/json.hpp"

namespace tabor::cli {

/// The keys of `density_curve` in `tabor friction --json`.
io::Json json_of(const analysis::DensityCurve& curve);

/// "density at 7 MPa", "the pockets under the contacts are full from ...".
void describe(const analysis::DensityCurve& curve, const std::vector<double>& asked,
              const std::string& group, Facts& facts);

}  // namespace tabor::cli
