#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Lists named solids with their elastic constants and strengths, each with its source.
namespace tabor::material {

/// Number with its source.
struct Sourced {
  double value = 0;
  std::string source;
};

/// Solid of the library. Values that depend more on its manufacture than on its name are absent.
struct NamedSolid {
  std::string name;                            ///< "aluminium-6016"
  std::string description;                     ///< what exactly, in a few words
  Sourced youngs_modulus;                      ///< E [Pa]
  Sourced poissons_ratio;                      ///< nu
  std::optional<Sourced> saturation_pressure;  ///< p_sat [Pa]: the pressure it flows at
  std::optional<Sourced> shear_strength;       ///< tau_y [Pa] of its dry contacts
};

/// Returns all solids, ordered by name.
const std::vector<NamedSolid>& solids();

/// Returns a solid by its name, or by the part before the hyphen where only one solid has it:
/// "aluminium". Throws InputError with all names and the nearest one.
const NamedSolid& find_solid(std::string_view name);

}  // namespace tabor::material
