#pragma once

#include <string>
#include <string_view>

namespace tabor::forming {

/// A unit as a deck has it.
struct DeckUnit {
  std::string name;  ///< "MPa"
  double si = 1;     ///< one of it in SI

  /// An SI value in this unit.
  double of(double quantity) const { return quantity / si; }
};

/// The units of a deck whose numbers have none: everything is made of its length, time and mass.
struct UnitSystem {
  std::string words;       ///< as it was asked for: "mm,s,t"
  DeckUnit pressure;       ///< "MPa"
  DeckUnit speed;          ///< "mm/s"
  DeckUnit areal_density;  ///< "t/mm^2"
};

/// The units that follow from three words in any order: a length (m, cm, mm, um, in, ft), a time
/// (s, ms, us) and a mass (kg, g, mg, t, lb, slug) or the force (N, kN, mN, lbf) that the mass
/// follows from by Newton's law: "mm,s,t" and "mm,s,N" are the same. Throws InputError for anything
/// else.
UnitSystem unit_system(std::string_view words);

}  // namespace tabor::forming
