#include <fmt/format.h>

#include <cctype>

#include "tabor/forming/comments.hpp"
#include "tabor/forming/deck.hpp"

namespace tabor::forming {
namespace {

/// A label: letters, digits and underscores, at most 80 of them, a letter first.
std::string label_of(const std::string& group) {
  constexpr std::size_t kLongest = 80;
  std::string label = "TABOR";
  if (!group.empty()) label += '_';
  for (const char c : group) {
    const auto byte = static_cast<unsigned char>(c);
    label += std::isalnum(byte) != 0 && byte < 128 ? static_cast<char>(std::toupper(byte)) : '_';
  }
  return label.substr(0, kLongest);
}

/// "0.29, 10, 2, , 4.5e-13"
std::string data_line(const FrictionEntry& entry, const UnitSystem& units, bool with_field) {
  const Condition& at = entry.at;
  std::string line =
      fmt::format("{}, {}, {}", digits(entry.friction),
                  at.sliding_speed ? digits(units.speed.of(*at.sliding_speed)) : std::string(),
                  digits(units.pressure.of(at.mean_pressure)));
  if (with_field) line += ", , " + digits(units.areal_density.of(at.lubricant_density));
  return line + '\n';
}

}  // namespace

std::string abaqus_deck(const FrictionTable& table, const UnitSystem& units) {
  require_two_pressures(table);
  const std::vector<DensityLayer> layers = layers_of(table);
  const bool with_field = layers.size() > 1;
  std::vector<std::string> head = head_of(table, units, "Abaqus");
  head.push_back(with_field
                     ? "field variable 1 is the lubricant density: give it by *INITIAL CONDITIONS, "
                       "TYPE=FIELD or *FIELD"
                     : "at " + density_text(layers.front().lubricant_density, units));
  head.push_back("outside its range Abaqus keeps the last value");
  std::string deck = comments("**", head);
  deck += fmt::format("*SURFACE INTERACTION, NAME={}\n*FRICTION{}\n", label_of(table.group),
                      with_field ? ", DEPENDENCIES=1" : "");
  deck += comments("**", {with_field ? "mu, slip rate, pressure, temperature, density"
                                     : "mu, slip rate, pressure"});
  for (const FrictionEntry& entry : table.entries) deck += data_line(entry, units, with_field);
  return deck;
}

}  // namespace tabor::forming
