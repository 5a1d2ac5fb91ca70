#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"

// Gives the enumerators of an enumeration their names and parses the names.
namespace tabor {

/// Names of an enumeration, in the order of its enumerators, which count up from zero.
template <typename Enum, std::size_t N>
class Names {
 public:
  /// One name for each enumerator.
  constexpr explicit Names(const std::array<std::string_view, N>& names) : names_(names) {}

  /// Returns the name of an enumerator.
  constexpr std::string_view of(Enum value) const {
    return names_[static_cast<std::size_t>(value)];
  }

  /// Returns all names, in the order of the enumerators.
  std::vector<std::string> all() const { return {names_.begin(), names_.end()}; }

  /// Returns the enumerator of a name; nullopt if there is none.
  constexpr std::optional<Enum> find(std::string_view name) const {
    for (std::size_t i = 0; i < N; ++i) {
      if (names_[i] == name) return static_cast<Enum>(i);
    }
    return std::nullopt;
  }

  /// Returns the enumerator of a name. Throws InputError with all names and the nearest one; `what`
  /// says what is named.
  Enum parse(std::string_view name, const std::string& what) const {
    if (const auto value = find(name)) return *value;
    std::string expected;
    for (const std::string_view known : names_) {
      expected += (expected.empty() ? "" : ", ") + std::string(known);
    }
    throw InputError(what, "'" + std::string(name) + "'" + suggestion(name, all()), expected, "");
  }

 private:
  std::array<std::string_view, N> names_;
};

/// Makes the names of an enumeration: names<Edge>("closed", "periodic", "open").
template <typename Enum, typename... Texts>
constexpr auto names(Texts... texts) {
  return Names<Enum, sizeof...(Texts)>({std::string_view(texts)...});
}

}  // namespace tabor
