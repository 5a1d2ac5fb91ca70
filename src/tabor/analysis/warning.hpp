#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tabor::analysis {

/// One reason to doubt a number. It belongs to the number: whoever shows the number shows it too.
struct Warning {
  std::string code;   ///< names the reason, for scripts and in docs/warnings.md
  std::string text;   ///< one sentence: what, where, and what to do
  double weight = 0;  ///< the worse the larger: of several cases the worst one's text is shown

  bool operator==(const Warning&) const = default;
};
/// Those of one number.
using Warnings = std::vector<Warning>;

/// What a warning is about: it is the same for all cases that have this in common.
enum class About { surface, contact, film, friction, flow };

/// Every code there is, with what it is about.
struct CodeEntry {
  std::string_view code;
  About about;
};
/// In the order in which warnings are shown.
const std::vector<CodeEntry>& all_codes();

/// Of a code in that list; a surface's for any other.
About about(std::string_view code);

/// Appends those whose code and text are not in the list yet.
void add(const Warnings& more, Warnings& list);

/// The codes alone, each once.
std::vector<std::string> codes_of(const Warnings& warnings);

}  // namespace tabor::analysis
