#include "tabor/scan/formats/stated.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/scan/formats/bytes.hpp"

namespace tabor::scan::format {
namespace {

std::string value_of(const Remarks& remarks, const std::string& key) {
  const auto found = remarks.find(key);
  return found == remarks.end() ? "" : found->second;
}

std::optional<double> pixel(const Remarks& remarks, const std::string& key, Index n) {
  const auto factor = unit_factor(value_of(remarks, "XYUnit"), dimension::length);
  const auto side = stated_number(value_of(remarks, key));
  if (!factor || !side) return std::nullopt;
  return *side * *factor / static_cast<double>(n);
}

}  // namespace

Remarks remarks_of(const topography::Topography& topography) {
  return {{"Title", writable_text(topography.channel.empty() ? "height" : topography.channel)},
          {"XReal", fmt::format("{:.17g}", topography.grid.lx)},
          {"YReal", fmt::format("{:.17g}", topography.grid.ly)},
          {"XYUnit", "m"},
          {"ZUnit", "m"}};
}

void take_remarks(const Remarks& remarks, Layer& layer) {
  layer.pixel_x = pixel(remarks, "XReal", layer.nx);
  layer.pixel_y = pixel(remarks, "YReal", layer.ny);
  layer.said_x = "XReal = " + value_of(remarks, "XReal");
  layer.said_y = "YReal = " + value_of(remarks, "YReal");
  const std::string title = value_of(remarks, "Title");
  if (!title.empty()) layer.name = title;
  const std::string unit = value_of(remarks, "ZUnit");
  if (!unit_factor(unit, dimension::length)) return;
  layer.unit = unit;
  layer.is_count = false;
}

std::optional<CountRange> count_range(const Remarks& remarks) {
  const auto least = parse_number(value_of(remarks, "ZMin"));
  const auto most = parse_number(value_of(remarks, "ZMax"));
  const bool has_unit = unit_factor(value_of(remarks, "ZUnit"), dimension::length).has_value();
  if (!least || !most || !has_unit) return std::nullopt;
  if (!std::isfinite(*least) || !std::isfinite(*most)) return std::nullopt;
  return CountRange{.least = *least, .most = *most};
}

}  // namespace tabor::scan::format
