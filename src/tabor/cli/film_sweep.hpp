#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tabor/cli/csv_output.hpp"
#include "tabor/cli/run_options.hpp"
#include "tabor/study/ehl_sweep.hpp"

// Many cases of `tabor ehl` as tables, JSON objects and files.
namespace tabor::cli {

/// A case and what is varied in it.
struct FilmSweep {
  const ehl::Program& program;
  std::string file;  ///< of the case
  io::Config config;
  std::vector<study::SweepAxis> axes;
  std::optional<std::string> output;  ///< HDF5
  RunRequest run;
  CsvRequest csv;

  /// Where a sweep with an output keeps its finished cases until all are done.
  std::filesystem::path folder() const { return *output + ".cases"; }
};

/// A table, or a JSON object with `results`, of all combinations of the values on the axes; with
/// limits where three grids were swept. Returns the exit code.
int show_sweep(const FilmSweep& sweep, study::EhlSeries& series, Context& context);

/// The case repeated with other values of one key, and the limit they tend to. Throws UsageError
/// for a study that the program does not know.
int show_study(const FilmSweep& sweep, const std::string& name, Context& context);

}  // namespace tabor::cli
