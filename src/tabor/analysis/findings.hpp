#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tabor/analysis/warning.hpp"

namespace tabor::analysis {

/// One number, or one row of numbers, with its warnings. Parts that all cases share, or that do not
/// exist, are left empty.
struct Case {
  std::string surface = {};
  std::string pressure = {};
  std::string density = {};
  std::string speed = {};
  Warnings warnings = {};
};

/// One reason to doubt several numbers, said once.
struct Finding {
  std::string code;
  std::string text;                ///< of the worst case, or the first
  std::vector<std::string> cases;  ///< names what it is about, each once; none where all share it
  std::size_t n_cases = 0;         ///< numbers it belongs to
  std::size_t n_all = 0;           ///< numbers there are
  bool texts_differ = false;       ///< other cases have other numbers in it
  bool is_worst = false;           ///< the text's case; else it is the first, none being worse
};

/// Brings the warnings of the same kind together: those about surfaces first, then contacts, films,
/// friction, each in the order in which they are met.
std::vector<Finding> findings_of(const std::vector<Case>& cases);

/// The text alone where there is no code; else
/// "TEXT (2 of 8 cases, the worst shown: 2 MPa, 7 MPa) [code]"
std::string line_of(const Finding& finding);

}  // namespace tabor::analysis
