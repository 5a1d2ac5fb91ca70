#pragma once

#include <string>
#include <vector>

#include "tabor/study/ehl_cases.hpp"

/// What the cases of a sweep warn of, said once.
namespace tabor::study {

/// Warnings of the cases of a series. Those that differ in their numbers only are one.
struct EhlWarnings {
  /// "[a] 3 of 9 cases (motion.speed = 1 mm/s, 3 mm/s, 10 mm/s), the first: ..."
  std::vector<std::string> lines;
  std::vector<std::string> marks;  ///< of each case: "a b", "" without any
};

EhlWarnings gather_warnings(const std::vector<ehl::CaseResult>& answers, const EhlCaseNames& names);

/// A text without its numbers and their units: the same for warnings of one kind.
std::string without_numbers(const std::string& text);

}  // namespace tabor::study
