#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tabor/cli/verb.hpp"

namespace tabor::cli {

/// One column of a table of curves. Curves are as long as they are.
struct Curve {
  std::string name;       ///< with its unit: "c1d_x_m3"
  std::string unit;       ///< "m^3"
  std::string long_name;  ///< for people
  std::vector<double> values;
};

/// Writes the curves side by side as CSV (short ones end in empty cells) or as datasets of an HDF5
/// file, by the extension: .csv or another. `methods` are keys of references.bib.
void write_curves(const std::vector<Curve>& curves, const std::filesystem::path& file,
                  const Context& context, const std::vector<std::string>& methods);

}  // namespace tabor::cli
