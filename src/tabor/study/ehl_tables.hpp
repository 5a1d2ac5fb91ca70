#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tabor/analysis/fields_file.hpp"
#include "tabor/core/column.hpp"
#include "tabor/ehl/program.hpp"
#include "tabor/study/axis.hpp"

// The numbers of many elastohydrodynamic cases as files.
namespace tabor::study {

/// What tells cases apart: keys with their units, and their values in each case.
struct EhlRows {
  std::vector<std::string> keys;
  std::vector<std::vector<Cell>> values;
};

/// The values of all combinations, in SI where they are no words.
EhlRows rows_of(const std::vector<SweepAxis>& axes);

/// "motion.speed [m/s]"
std::string with_unit(const std::string& key, const std::string& unit);

/// A row of numbers per case behind what tells it apart, as CSV.
std::string csv_of(const ehl::Program& program, const EhlRows& rows,
                   const std::vector<ehl::CaseResult>& results);

/// A finished sweep.
struct EhlSweep {
  const ehl::Program& program;
  const std::vector<SweepAxis>& axes;
  const std::vector<ehl::CaseResult>& results;  ///< of all combinations, the last axis fastest
  const std::vector<std::string>& marks;        ///< EhlWarnings::marks
};

/// Its result file (docs/ehl.md): the head, /sweep with the axes and an array per column, and the
/// warnings. Throws OutputError.
void write_sweep(const std::filesystem::path& file, const analysis::ResultHead& head,
                 const EhlSweep& sweep, const std::vector<analysis::Finding>& warnings);

}  // namespace tabor::study
