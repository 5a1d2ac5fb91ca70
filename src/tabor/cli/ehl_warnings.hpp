#pragma once

#include <string>
#include <vector>

#include "tabor/cli/ehl.hpp"

/// What the cases of a sweep warn of, said once.
namespace tabor::cli {

/// How the cases of a series are told apart: "motion.speed", and for each "1 mm/s".
struct EhlCaseNames {
  std::string key;
  std::vector<std::string> values;
};

/// Warnings of the cases of a series. Those that differ in their numbers only are one.
struct EhlWarnings {
  /// "[a] 3 of 9 cases (motion.speed = 1 mm/s, 3 mm/s, 10 mm/s), the first: ..."
  std::vector<std::string> lines;
  std::vector<std::string> marks;  ///< of each case: "a b", "" without any
};

EhlWarnings gather_warnings(const std::vector<EhlAnswer>& answers, const EhlCaseNames& names);

/// A text without its numbers and their units: the same for warnings of one kind.
std::string without_numbers(const std::string& text);

}  // namespace tabor::cli
