#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tabor/cases/ehl/program.hpp"
#include "tabor/numerics/grid_limit.hpp"
#include "tabor/results/fields_file.hpp"
#include "tabor/results/findings.hpp"
#include "tabor/study/axis.hpp"
#include "tabor/study/ehl_cases.hpp"

// The numbers of many elastohydrodynamic cases as files.
namespace tabor::study {

/// Many cases of one program, and what is made of them.
struct EhlSweep {
  const ehl::Program& program;
  std::vector<SweepAxis> axes;
  std::vector<ehl::CaseResult> results;  ///< of all combinations, the last axis fastest
  ehl::CaseColumns columns;
  std::vector<results::Finding> warnings;  ///< of all cases, each kind once
  std::vector<numerics::GridLimit>
      limits;  ///< of each column, where one grid was varied; else empty
};

/// A sweep without an axis is a case alone.
EhlSweep sweep_of(const ehl::Program& program, std::vector<SweepAxis> axes,
                  std::vector<ehl::CaseResult> results);

/// A row per case as CSV: its values on the axes, SI where they are no words, and its numbers.
std::string csv_of(const EhlSweep& sweep);

/// The result file of a sweep (docs/ehl.md): the head, /sweep with the axes and an array per
/// column, and the warnings. Throws OutputError.
void write_sweep(const std::filesystem::path& file, const results::ResultHead& head,
                 const EhlSweep& sweep, const std::vector<results::Finding>& warnings);

}  // namespace tabor::study
