#include <fmt/format.h>

#include "tabor/core/error.hpp"
#include "tabor/forming/comments.hpp"
#include "tabor/forming/deck.hpp"

namespace tabor::forming {
namespace {

constexpr int kLargestId = 99999999;  // the manual's limit of eight digits

std::string point(double speed, double friction) {
  return fmt::format("{:>20}{:>20}\n", digits(speed), digits(friction));
}

/// Friction over the speed. It begins at rest, where no speed was computed with the friction of the
/// lowest speed; where there is no speed but rest it is flat.
std::string curve(const PressureRow& row, const UnitSystem& units, int id) {
  std::string card = fmt::format("*DEFINE_CURVE\n$     lcid\n{:>10}\n", id);
  card += "$     sliding speed                  mu\n";
  const FrictionEntry& first = row.entries.front();
  if (row.entries.back().at.sliding_speed.value_or(0) == 0) {
    return card + point(0, first.friction) + point(units.speed.of(1), first.friction);
  }
  if (*first.at.sliding_speed > 0) card += point(0, first.friction);
  for (const FrictionEntry& entry : row.entries) {
    card += point(units.speed.of(*entry.at.sliding_speed), entry.friction);
  }
  return card;
}

void require_same_speeds(const DensityLayer& layer) {
  const auto speeds = [](const PressureRow& row) {
    std::vector<std::optional<double>> all;
    for (const FrictionEntry& entry : row.entries) all.push_back(entry.at.sliding_speed);
    return all;
  };
  for (const PressureRow& row : layer.rows) {
    if (speeds(row) == speeds(layer.rows.front())) continue;
    throw InputError("friction table", "other speeds at other pressures",
                     "the same for all curves of a *DEFINE_TABLE", "complete_rows()");
  }
}

/// The table of one density and its curves; `id` is the next free number.
std::string table_card(const DensityLayer& layer, const UnitSystem& units, int& id) {
  require_same_speeds(layer);
  std::string card = comments("$", {"at " + density_text(layer.lubricant_density, units),
                                    fmt::format("in the contact card: FS = 2, FD = {}", id)});
  card += fmt::format("*DEFINE_TABLE\n$     tbid\n{:>10}\n$          pressure\n", id++);
  for (const PressureRow& row : layer.rows) {
    card += fmt::format("{:>20}\n", digits(units.pressure.of(row.mean_pressure)));
  }
  for (const PressureRow& row : layer.rows) card += curve(row, units, id++);
  return card;
}

}  // namespace

std::string lsdyna_deck(const FrictionTable& table, const UnitSystem& units, int first_id) {
  require_two_pressures(table);
  const std::vector<DensityLayer> layers = layers_of(table);
  std::size_t n_ids = layers.size();
  for (const DensityLayer& layer : layers) n_ids += layer.rows.size();
  if (first_id < 1 || n_ids > static_cast<std::size_t>(kLargestId - first_id)) {
    throw InputError("<id>", std::to_string(first_id), "a number from 1 to eight digits", "");
  }
  std::vector<std::string> head = head_of(table, units, "LS-DYNA");
  head.emplace_back(
      "the values of *DEFINE_TABLE are pressures, the curves are friction over sliding speed; FS = "
      "2 works for *CONTACT_SURFACE_TO_SURFACE and _ONE_WAY_SURFACE_TO_SURFACE with the thickness "
      "offset");
  if (layers.size() > 1) {
    head.emplace_back("LS-DYNA knows no lubricant density: each has a table of its own");
  }
  head.emplace_back(table.has_speeds() ? "from rest to the lowest speed computed friction is flat"
                                       : "friction does not depend on the sliding speed");
  std::string deck = comments("$", head) + "*KEYWORD\n";
  int id = first_id;
  for (const DensityLayer& layer : layers) deck += table_card(layer, units, id);
  return deck + "*END\n";
}

}  // namespace tabor::forming
