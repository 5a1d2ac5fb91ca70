#pragma once

#include <string>
#include <vector>

// Defines the one kind of warning that numbers carry.
namespace tabor {

/// One reason not to trust a number, or what was done to it. It belongs to the number: whoever
/// shows the number shows it too.
struct Warning {
  std::string code;   ///< names the reason, for scripts and in docs/warnings.md
  std::string text;   ///< one sentence: what, where, and what to do (core/advice.hpp)
  double weight = 0;  ///< the worse the larger: of several cases the worst one's text is shown

  bool operator==(const Warning&) const = default;
};
/// Warnings of one number.
using Warnings = std::vector<Warning>;

/// Appends those whose code and text are not in the list yet.
void add(const Warnings& more, Warnings& list);

/// The sentences alone.
std::vector<std::string> texts_of(const Warnings& warnings);

/// The codes alone, each once.
std::vector<std::string> codes_of(const Warnings& warnings);

}  // namespace tabor
