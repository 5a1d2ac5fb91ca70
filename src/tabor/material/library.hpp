#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tabor::material {

/// A number and where it is from.
struct Sourced {
  double value = 0;
  std::string source;
};

/// A solid of the library. Values that depend more on its making than on its name are absent.
struct NamedSolid {
  std::string name;                            ///< "aluminium-6016"
  std::string description;                     ///< what exactly, in a few words
  Sourced youngs_modulus;                      ///< E [Pa]
  Sourced poissons_ratio;                      ///< nu
  std::optional<Sourced> saturation_pressure;  ///< p_sat [Pa]: the pressure it flows at
  std::optional<Sourced> shear_strength;       ///< tau_y [Pa] of its dry contacts
};

/// All there are, ordered by name.
const std::vector<NamedSolid>& solids();

/// By its name, or what stands before the hyphen where only one solid has it: "aluminium". Throws
/// InputError with all names and the nearest one.
const NamedSolid& find_solid(std::string_view name);

}  // namespace tabor::material
