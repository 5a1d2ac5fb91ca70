#pragma once

#include <string>
#include <string_view>
#include <vector>

// Looks up what docs/warnings.md says about the code of a warning; the page is compiled in.
namespace tabor::results {

/// Entry of docs/warnings.md about one code.
struct Explanation {
  std::string code;
  std::string about;  ///< heading of its table: "About the contact"
  std::string when;
  std::string what_to_do;  ///< "" where there is nothing to do
};

/// Returns the content of docs/warnings.md, which is compiled in.
std::string_view warnings_text();

/// Returns the entries of docs/warnings.md, in their order.
const std::vector<Explanation>& explanations();

/// Returns the entry of a code; null for a code without an entry.
const Explanation* explanation_of(std::string_view code);

}  // namespace tabor::results
