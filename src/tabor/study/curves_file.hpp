#pragma once

#include <string>
#include <vector>

#include "tabor/cases/density_curve.hpp"
#include "tabor/results/fields_file.hpp"

namespace tabor::study {

/// Adds the curves of one scan, and the answers of each for the densities of the records, to its
/// result file; nothing without curves.
void write_curves(const std::vector<cases::DensityCurve>& curves, const std::string& scan,
                  const std::vector<cases::FrictionRecord>& records, results::FieldsFile& file);

}  // namespace tabor::study
