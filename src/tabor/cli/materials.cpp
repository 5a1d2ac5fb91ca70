#include <fmt/format.h>

#include <optional>

#include "tabor/cli/result.hpp"
#include "tabor/cli/table.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/material/library.hpp"

namespace tabor::cli {

namespace {

using material::NamedSolid;
using material::Sourced;

io::Json json_of(const std::optional<Sourced>& number) {
  if (!number) return {};
  return {{"value", number->value}, {"source", number->source}};
}

std::string cell(const std::optional<Sourced>& number, const char* unit) {
  return number ? si(number->value, unit) : "-";
}

/// Each source once, with what it is the source of.
void add_sources(const NamedSolid& solid, Facts& facts) {
  std::vector<std::pair<std::string, std::string>> sources;  // source, symbols
  const auto add = [&](const char* symbol, const std::optional<Sourced>& number) {
    if (!number) return;
    for (auto& [source, symbols] : sources) {
      if (source != number->source) continue;
      symbols += fmt::format(", {}", symbol);
      return;
    }
    sources.emplace_back(number->source, symbol);
  };
  add("E", solid.youngs_modulus);
  add("nu", solid.poissons_ratio);
  add("p_sat", solid.saturation_pressure);
  add("tau_y", solid.shear_strength);
  std::string text = solid.description;
  for (const auto& [source, symbols] : sources) text += fmt::format("; {}: {}", symbols, source);
  facts.fact(solid.name, text);
}

int list_materials(Context& context) {
  io::Json object = json_head(context);
  object["materials"] = io::Json::array();
  Table table({"name", "E", "nu", "p_sat", "tau_y"});
  Facts facts;
  for (const NamedSolid& solid : material::solids()) {
    object["materials"].push_back({{"name", solid.name},
                                   {"description", solid.description},
                                   {"youngs_modulus_Pa", json_of(solid.youngs_modulus)},
                                   {"poissons_ratio", json_of(solid.poissons_ratio)},
                                   {"saturation_pressure_Pa", json_of(solid.saturation_pressure)},
                                   {"shear_strength_Pa", json_of(solid.shear_strength)}});
    table.row({solid.name, si(solid.youngs_modulus.value, "Pa"), plain(solid.poissons_ratio.value),
               cell(solid.saturation_pressure, "Pa"), cell(solid.shear_strength, "Pa")});
    add_sources(solid, facts);
  }
  return finish(context, object, table.text() + '\n' + facts.text());
}

}  // namespace

Verb materials_verb() {
  return {.name = "materials",
          .arguments = "[options]",
          .summary = "list the materials of --material, with their sources",
          .details =
              "The table gives Young's modulus E and Poisson's ratio nu. It gives the saturation "
              "pressure p_sat and the shear strength tau_y of dry contacts where one number "
              "describes the material. Values of your own sheet are better, and every option "
              "overrides the library.",
          .examples = {"tabor materials", "tabor materials --json"},
          .declare = [](OptionSet&) { return list_materials; }};
}

}  // namespace tabor::cli
