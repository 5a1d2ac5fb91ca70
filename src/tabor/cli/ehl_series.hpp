#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tabor/cli/ehl.hpp"
#include "tabor/cli/ehl_sweep.hpp"

/// Many cases of one elastohydrodynamic program: sweeps over values of a case, and studies.
namespace tabor::cli {

/// What all cases of a series share.
struct EhlSeries {
  const EhlProgram& program;
  io::Config config;
  std::string file;                   ///< of the case
  std::optional<std::string> output;  ///< HDF5
};

/// A table, or a JSON object with `results`, of all combinations of the values on the axes; with
/// limits where three grids were swept. Returns the exit code.
int show_sweep(const EhlSeries& series, const std::vector<SweepAxis>& axes, Context& context);

/// The case repeated with other values of one key, and the limit they tend to. Throws UsageError
/// for a study that the program does not know.
int show_study(const EhlSeries& series, const std::string& name, Context& context);

}  // namespace tabor::cli
