#include "tabor/forming/deck.hpp"

namespace tabor::forming {

std::string deck_for(Program program, const FrictionTable& table, const UnitSystem& units,
                     int first_id) {
  switch (program) {
    case Program::abaqus:
      return abaqus_deck(table, units);
    case Program::lsdyna:
      return lsdyna_deck(table, units, first_id);
    case Program::ansys:
      return ansys_deck(table, units, first_id);
    case Program::openradioss:
      return openradioss_deck(table, units, first_id);
    case Program::csv:
      break;
  }
  return table_csv(table, units);
}

}  // namespace tabor::forming
