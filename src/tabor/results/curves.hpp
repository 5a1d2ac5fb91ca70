#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tabor/results/fields_file.hpp"

// Writes tables of curves, such as power spectra, as CSV or HDF5.
namespace tabor::results {

/// One column of a table of curves. Curves of one table may have different lengths.
struct Curve {
  std::string name;       ///< with its unit: "c1d_x_m3"
  std::string unit;       ///< "m^3"
  std::string long_name;  ///< for people
  std::vector<double> values;
  std::vector<std::pair<std::string, double>> attributes = {};  ///< of the dataset: "hurst", ...
};

/// Curves of one scan or of one group of scans.
struct CurveSet {
  std::string place = "/curves";  ///< group of an HDF5 file: "/scans/0000"
  std::string heading = {};       ///< before the names of columns: "a.x3p"; "" where there is one
  std::vector<std::pair<std::string, std::vector<std::string>>> attributes =
      {};  ///< of the place: "file", ...
  std::vector<Curve> curves = {};
};

/// Returns all curves side by side; short ones end in empty cells.
std::string csv_of(const std::vector<CurveSet>& sets);

/// Writes them as CSV or, with this head and these warnings, as datasets of an HDF5 file, by the
/// extension: .csv or another.
void write_curves(const std::vector<CurveSet>& sets, const std::filesystem::path& file,
                  const ResultHead& head, const std::vector<Finding>& warnings);

}  // namespace tabor::results
