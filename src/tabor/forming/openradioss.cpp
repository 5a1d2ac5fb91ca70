#include <fmt/format.h>

#include "tabor/forming/comments.hpp"
#include "tabor/forming/darmstad.hpp"
#include "tabor/forming/deck.hpp"

namespace tabor::forming {
namespace {

/// Twelve digits: the fit's error is that of these numbers.
std::string field(double value) { return fmt::format("{:>20}", fmt::format("{:.12g}", value)); }

std::string card(const DarmstadLaw& law, const UnitSystem& units, int id) {
  const double pressure = units.pressure.si;
  const double speed = units.speed.si;
  std::string text = fmt::format("/FRICTION/{}\nfriction by tabor\n", id);
  text += "#   I_fric   I_filtr              X_freq    I_form\n";
  text += fmt::format("{:>10}{:>10}{:>20}{:>10}\n", 2, 0, 0, 0);
  text +=
      "#                 C1                  C2                  C3                  C4"
      "                  C5\n";
  text += field(law.c1 * pressure * pressure) + field(law.c2 * speed) + field(law.c3 * pressure) +
          field(law.c4 * speed) + field(law.c5) + '\n';
  text += "#                 C6                FRIC               VIS_F\n";
  return text + field(law.c6 * speed) + field(law.constant) + field(0) + '\n';
}

}  // namespace

std::string openradioss_deck(const FrictionTable& table, const UnitSystem& units, int first_id) {
  std::vector<std::string> head = head_of(table, units, "OpenRadioss");
  head.emplace_back(
      "Ifric = 2: mu = Fric + C1 e^(C2 V) p^2 + C3 e^(C4 V) p + C5 e^(C6 V), fitted to the numbers "
      "by least squares; it does not hold outside their range");
  const std::vector<DarmstadFit> fits = fit_darmstad(table);
  if (fits.size() > 1) {
    head.emplace_back("/FRICTION knows no lubricant density: each has a card of its own");
  }
  std::string deck = comments("#", head);
  int id = first_id;
  for (const DarmstadFit& fit : fits) {
    deck += comments("#", {"at " + density_text(fit.lubricant_density, units),
                           fmt::format("largest error of the fit: {:.3g}", fit.largest_error)});
    deck += card(fit.law, units, id++);
  }
  return deck;
}

}  // namespace tabor::forming
