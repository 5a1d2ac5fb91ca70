#pragma once

#include <string>
#include <vector>

#include "tabor/analysis/density_curve.hpp"
#include "tabor/analysis/fields_file.hpp"

namespace tabor::study {

/// Adds the curves of one scan, and what each says of the densities that were asked for, to its
/// result file; nothing without curves.
void write_curves(const std::vector<analysis::DensityCurve>& curves, const std::string& scan,
                  const std::vector<double>& asked, analysis::FieldsFile& file);

}  // namespace tabor::study
