#pragma once

#include <string_view>

namespace tabor {

/// Whether a pattern of the shell fits the whole text: * stands for any characters, ? for one.
bool fits(std::string_view text, std::string_view pattern);

}  // namespace tabor
