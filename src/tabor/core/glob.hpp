#pragma once

#include <string_view>

namespace tabor {

/// True where a shell pattern matches the whole text: * stands for any characters, ? for one.
bool fits(std::string_view text, std::string_view pattern);

}  // namespace tabor
