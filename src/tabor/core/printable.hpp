#pragma once

#include <string>
#include <string_view>

namespace tabor {

/// The text as a terminal may get it. Damaged and hostile files put anything into names and quoted
/// words. Control characters, which could write to a terminal whatever they like, and bytes that
/// are not UTF-8 become \x1b and so on; characters that turn the direction of writing or take no
/// room, which make one name look like another, become \u{202e} and so on; texts of more than 8 KiB
/// lose their middle. A text that has been through is left as it is.
std::string printable(std::string_view text);

/// The same for a text of many lines, none of which is cut.
std::string printable_lines(std::string_view text);

/// JSON with the same content, in which such characters are spelt \u202e.
std::string printable_json(std::string_view text);

}  // namespace tabor
