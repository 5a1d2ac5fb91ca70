#include <fmt/format.h>

#include "tabor/forming/comments.hpp"
#include "tabor/forming/deck.hpp"

namespace tabor::forming {
namespace {

std::string row_lines(const PressureRow& row, const UnitSystem& units) {
  std::string lines =
      fmt::format("TBFIELD,NPRES,{}\n", digits(units.pressure.of(row.mean_pressure)));
  for (const FrictionEntry& entry : row.entries) {
    if (entry.at.sliding_speed) {
      lines += fmt::format("TBFIELD,SLRV,{}\n", digits(units.speed.of(*entry.at.sliding_speed)));
    }
    lines += fmt::format("TBDATA,1,{}\n", digits(entry.friction));
  }
  return lines;
}

}  // namespace

std::string ansys_deck(const FrictionTable& table, const UnitSystem& units, int first_id) {
  require_two_pressures(table);
  const std::vector<DensityLayer> layers = layers_of(table);
  std::vector<std::string> head = head_of(table, units, "Ansys Mechanical APDL");
  head.emplace_back(table.has_speeds()
                        ? "NPRES is the normal pressure, SLRV the relative sliding velocity"
                        : "NPRES is the normal pressure; friction does not depend on the speed");
  if (layers.size() > 1) {
    head.emplace_back("TB,FRIC knows no lubricant density: each has a material of its own");
  }
  std::string deck = comments("!", head);
  int id = first_id;
  for (const DensityLayer& layer : layers) {
    deck += comments("!", {"at " + density_text(layer.lubricant_density, units)});
    deck += fmt::format("TB,FRIC,{},,,ISO\n", id++);
    for (const PressureRow& row : layer.rows) deck += row_lines(row, units);
  }
  return deck;
}

}  // namespace tabor::forming
