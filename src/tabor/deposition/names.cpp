#include "tabor/deposition/deposition.hpp"

namespace tabor::deposition {

std::string_view name(Model model) { return kModels.of(model); }
std::string_view name(Reading reading) { return kReadings.of(reading); }
std::string_view name(Edge edge) { return kEdges.of(edge); }

Model parse_model(std::string_view text) { return kModels.parse(text, "deposition model"); }
Reading parse_reading(std::string_view text) {
  return kReadings.parse(text, "reading of the droplet rule");
}
Edge parse_edge(std::string_view text) { return kEdges.parse(text, "edge of the lubricated map"); }

}  // namespace tabor::deposition
