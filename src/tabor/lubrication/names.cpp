#include "tabor/core/names.hpp"
#include "tabor/lubrication/deposition.hpp"

namespace tabor::lubrication {
namespace {

constexpr auto kModels = names<Model>("droplets", "limit", "bottom-fill", "uniform");
constexpr auto kReadings = names<Reading>("conserving", "literal");
constexpr auto kEdges = names<Edge>("closed", "periodic", "open");

}  // namespace

std::string_view name(Model model) { return kModels.of(model); }
std::string_view name(Reading reading) { return kReadings.of(reading); }
std::string_view name(Edge edge) { return kEdges.of(edge); }

Model parse_model(std::string_view text) { return kModels.parse(text, "deposition model"); }
Reading parse_reading(std::string_view text) {
  return kReadings.parse(text, "reading of the droplet rule");
}
Edge parse_edge(std::string_view text) { return kEdges.parse(text, "edge of the lubricated map"); }

}  // namespace tabor::lubrication
