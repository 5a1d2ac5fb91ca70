#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tabor/cases/warning.hpp"
#include "tabor/core/advice.hpp"

// Groups the warnings of many numbers by their codes and writes each group as one line.
namespace tabor::results {

/// One number, or one row of numbers, with its warnings. Parts that all cases share, or that do not
/// exist, are left empty.
struct Case {
  std::string surface = {};
  std::string pressure = {};
  std::string density = {};
  std::string speed = {};
  std::string name = {};  ///< of a film under load: "motion.speed 1 m/s"
  Warnings warnings = {};
};

/// One warning of several numbers, said once.
struct Finding {
  std::string code;
  std::string text;                ///< of the worst case, or the first
  std::vector<std::string> cases;  ///< names what it is about, each once; none where all share it
  std::size_t n_cases = 0;         ///< numbers it belongs to
  std::size_t n_all = 0;           ///< numbers there are
  bool texts_differ = false;       ///< other cases have other numbers in it
  bool is_worst = false;           ///< the text's case; else it is the first, none being worse

  /// The class of its code.
  cases::Class kind() const { return cases::class_of(code); }
};

/// Characters of a line of a warning with "warning: " before it, and without.
inline constexpr std::size_t kLineWidth = 160;
inline constexpr std::size_t kLineLimit = kLineWidth - 9;

/// Groups warnings of the same kind: class `doubt` before `information`, and of each those
/// about surfaces first, then contacts, films, friction, in the order in which they are met. The
/// worst case is named first.
std::vector<Finding> findings_of(const std::vector<Case>& cases);

/// Puts the class `doubt` first, in which is what has no code; else the order stays.
void put_doubts_first(std::vector<Finding>& findings);

/// Spells the settings in their texts.
void spell(const AdviceSpelling& spelling, std::vector<Finding>& findings);

/// The text alone where there is no code; else
/// "TEXT (2 of 8 cases, the worst shown: 7 MPa, 2 MPa) [code]"
/// of kLineLimit characters at most: with fewer names of cases, and at last a shortened text.
std::string line_of(const Finding& finding);
/// The same line without its code.
std::string statement_of(const Finding& finding);

/// Joins the codes of the warnings of one number for a cell of a table: "coarse-grid short-inlet".
std::string codes_text(const Warnings& warnings);

/// The text, whose paths lose folders where it is longer than that, and which then loses words.
std::string fitted(const std::string& text, std::size_t limit);

/// The text, of which words are left out at the end where it is longer than that.
std::string shortened(const std::string& text, std::size_t limit);

/// Surfaces that are named by their paths lose the folders that do not tell two of them apart.
void shorten_paths(std::vector<Case>& cases);

}  // namespace tabor::results
