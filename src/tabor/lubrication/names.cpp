#include <array>
#include <string>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/lubrication/deposition.hpp"

namespace tabor::lubrication {
namespace {

using Names = std::vector<std::string>;  // in the order of the enumerators

const Names& model_names() {
  static const Names names{"droplets", "limit", "bottom-fill", "uniform"};
  return names;
}

const Names& reading_names() {
  static const Names names{"conserving", "literal"};
  return names;
}

const Names& edge_names() {
  static const Names names{"closed", "periodic", "open"};
  return names;
}

template <class Enum>
Enum parse(std::string_view text, const char* what, const Names& names) {
  std::string expected;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == text) {
      return static_cast<Enum>(i);
    }
    expected += (i == 0 ? "" : ", ") + names[i];
  }
  throw InputError(what, "'" + std::string(text) + "'" + suggestion(text, names), expected, "");
}

}  // namespace

std::string_view name(Model model) { return model_names()[static_cast<std::size_t>(model)]; }
std::string_view name(Reading reading) {
  return reading_names()[static_cast<std::size_t>(reading)];
}
std::string_view name(Edge edge) { return edge_names()[static_cast<std::size_t>(edge)]; }

Model parse_model(std::string_view text) {
  return parse<Model>(text, "deposition model", model_names());
}
Reading parse_reading(std::string_view text) {
  return parse<Reading>(text, "reading of the droplet rule", reading_names());
}
Edge parse_edge(std::string_view text) {
  return parse<Edge>(text, "edge of the lubricated map", edge_names());
}

}  // namespace tabor::lubrication
