#include "tabor/forming/comments.hpp"
#include "tabor/forming/deck.hpp"
#include "tabor/io/text/csv.hpp"

namespace tabor::forming {
namespace {

/// "t/mm^2" -> "t_per_mm2", as in the other tables of tabor.
std::string key_of(const std::string& unit) {
  std::string key;
  for (const char c : unit) {
    if (c == '/') key += "_per_";
    if (c == ' ') key += '_';
    if (std::string_view("/^ ()").find(c) == std::string_view::npos) key += c;
  }
  return key;
}

std::vector<std::string> columns_of(const FrictionTable& table, const UnitSystem& units) {
  std::vector<std::string> columns = {"mean_pressure_" + key_of(units.pressure.name),
                                      "lubricant_density_" + key_of(units.areal_density.name)};
  if (table.has_speeds()) columns.push_back("sliding_speed_" + key_of(units.speed.name));
  for (const char* column : {"friction_coefficient", "standard_deviation", "n"}) {
    columns.emplace_back(column);
  }
  return columns;
}

}  // namespace

std::string table_csv(const FrictionTable& table, const UnitSystem& units) {
  std::string text = comments("#", head_of(table, units, "any program"));
  text += io::csv_line(columns_of(table, units));
  for (const FrictionEntry& entry : table.entries) {
    const Condition& at = entry.at;
    std::vector<std::string> cells = {digits(units.pressure.of(at.mean_pressure)),
                                      digits(units.areal_density.of(at.lubricant_density))};
    if (at.sliding_speed) cells.push_back(digits(units.speed.of(*at.sliding_speed)));
    cells.push_back(io::csv_number(entry.friction));
    cells.push_back(io::csv_number(entry.standard_deviation));
    cells.push_back(std::to_string(entry.n));
    text += io::csv_line(cells);
  }
  return text;
}

}  // namespace tabor::forming
