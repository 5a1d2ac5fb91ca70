#pragma once

#include <string_view>
#include <vector>

#include "tabor/core/warning.hpp"

// Lists the codes of warnings: the quantity each is about, and its class.
namespace tabor::cases {

/// What a warning is about: it is the same for all cases that have this in common.
enum class About { surface, contact, film, friction, flow, ehl };

/// Class of a warning: `doubt` changes the number; `information` says what was asked for and done.
enum class Class { doubt, information };

/// Every code there is, with what it is about.
struct CodeEntry {
  std::string_view code;
  About about;
  Class kind;
};
/// In the order in which warnings are shown.
const std::vector<CodeEntry>& all_codes();

/// Returns what a code of that list is about; the surface for any other.
About about(std::string_view code);

/// Returns the class of a code of that list; `doubt` for any other.
Class class_of(std::string_view code);

/// "doubt" or "information"
const char* name_of(Class kind);

}  // namespace tabor::cases
