#pragma once

#include <string>
#include <string_view>

// Makes a consistent system of units, such as "mm,s,t", for codes whose numbers have none.
namespace tabor::forming {

/// Unit of a deck.
struct DeckUnit {
  std::string name;  ///< "MPa"
  double si = 1;     ///< one of it in SI

  /// Converts an SI value to this unit.
  double of(double quantity) const { return quantity / si; }
};

/// Units of a deck whose numbers have none: all follow from its length, time and mass.
struct UnitSystem {
  std::string words;       ///< as it was asked for: "mm,s,t"
  DeckUnit pressure;       ///< "MPa"
  DeckUnit speed;          ///< "mm/s"
  DeckUnit areal_density;  ///< "t/mm^2"
};

/// Returns the units that follow from three words in any order: a length (m, cm, mm, um, in, ft), a
/// time (s, ms, us) and a mass (kg, g, mg, t, lb, slug) or the force (N, kN, mN, lbf) that the mass
/// follows from by Newton's law: "mm,s,t" and "mm,s,N" are the same. Throws InputError for anything
/// else.
UnitSystem unit_system(std::string_view words);

}  // namespace tabor::forming
