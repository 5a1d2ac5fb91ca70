#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"

namespace tabor::material::detail {

/// The enumerator at the place of `text` among `names`, which stand in the order of the
/// enumerators. Throws InputError with all names and the nearest one.
template <class Enum>
Enum parse_name(std::string_view text, const std::string& what,
                const std::vector<std::string>& names) {
  std::string expected;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == text) {
      return static_cast<Enum>(i);
    }
    expected += (i == 0 ? "" : ", ") + names[i];
  }
  throw InputError(what, "'" + std::string(text) + "'" + suggestion(text, names), expected, "");
}

}  // namespace tabor::material::detail
