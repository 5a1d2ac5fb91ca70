#pragma once

#include <filesystem>
#include <string>
#include <vector>

// Reads measured friction from a CSV file, to compare a study with.
namespace tabor::study {

/// Measured friction, one entry per row of its CSV file.
struct Experiment {
  std::filesystem::path file;
  std::vector<double> mean_pressure;      ///< [Pa]
  std::vector<double> friction;           ///< coefficient
  std::vector<double> error;              ///< of the coefficient, NaN if not given
  std::vector<double> lubricant_density;  ///< [kg/m^2], NaN if not given
};

/// Columns: `mean_pressure_Pa`, `mean_pressure_MPa`, or `mean_pressure` whose cells carry their
/// unit
/// ("2 MPa"); `friction`; optionally `error`; optionally `lubricant_density_g_per_m2` or
/// `lubricant_density` with units. Throws InputError with line and column.
Experiment read_experiment(const std::filesystem::path& file);

}  // namespace tabor::study
