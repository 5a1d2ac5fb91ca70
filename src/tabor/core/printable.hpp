#pragma once

#include <string>
#include <string_view>

// Makes text of unknown origin safe to print on a terminal or in JSON.
namespace tabor {

/// Returns a text that is safe on a terminal. Damaged and hostile files put anything into names and
/// quoted words. Control characters, which could command the terminal, and bytes that are not UTF-8
/// become \x1b and so on; characters that change the direction of writing or have no width, which
/// make one name look like another, become \u{202e} and so on; texts of more than 8 KiB lose their
/// middle. A text that is already printable stays as it is.
std::string printable(std::string_view text);

/// Returns a printable text of many lines, none of which is cut.
std::string printable_lines(std::string_view text);

/// Returns JSON with the same content, in which such characters are spelt \u202e.
std::string printable_json(std::string_view text);

}  // namespace tabor
