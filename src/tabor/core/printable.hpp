#pragma once

#include <string>
#include <string_view>

namespace tabor {

/// The text as a terminal may get it. Damaged and hostile files put anything into names and quoted
/// words: control characters, which could write to a terminal whatever they like, become \x1b and
/// so on; texts of more than 8 KiB lose their middle.
std::string printable(std::string_view text);

}  // namespace tabor
