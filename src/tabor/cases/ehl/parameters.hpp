#pragma once

#include <optional>

#include "tabor/ehl/asperities.hpp"
#include "tabor/io/text/toml.hpp"
#include "tabor/material/lubricant.hpp"
#include "tabor/record/parameter.hpp"

// What the cases of all elastohydrodynamic programs may say: the tables [solids], [lubricant] and
// [asperities]. Each part is a struct of settings with its table of parameters, and a function that
// makes of it what a problem needs; that throws InputError, with file, line and key, for settings
// that do not go together.
namespace tabor::ehl {

/// The bounds of bounds::above_zero, as messages of cases always called them.
inline const Bounds kAboveZero{.least = 0, .least_is_out = true, .text = "a value above zero"};

/// Two elastic solids.
struct SolidSettings {
  std::optional<double> e_prime = {};                 ///< E' = 2 E* [Pa], instead of the others
  std::optional<double> youngs_modulus = {};          ///< E1 [Pa]
  std::optional<double> poissons_ratio = {};          ///< nu1
  std::optional<double> counter_youngs_modulus = {};  ///< E2 [Pa], absent: rigid
  std::optional<double> counter_poissons_ratio = {};  ///< nu2
};
const Parameters<SolidSettings>& solid_parameters();
/// E* [Pa].
double effective_modulus(const SolidSettings& settings, const io::Config& file);

/// A liquid.
struct LubricantSettings {
  std::optional<double> viscosity = {};          ///< eta0 [Pa s], or of the next two
  std::optional<double> glycerol_fraction = {};  ///< mass fraction in water
  std::optional<double> temperature = {};        ///< [K] of glycerol-water
  material::ViscosityLaw viscosity_law = material::ViscosityLaw::barus;
  std::optional<double> pressure_viscosity = {};         ///< alpha [1/Pa]
  std::optional<material::DensityLaw> density_law = {};  ///< absent: constant
};
const Parameters<LubricantSettings>& lubricant_parameters();
/// Without a density law, and with the viscosity laws under which a rigid film is known in closed
/// form.
const Parameters<LubricantSettings>& closed_form_parameters();
/// Its viscosity and density; its shear is Newtonian.
material::Lubricant lubricant_of(const LubricantSettings& settings, const io::Config& file);

/// How a liquid shears: Newtonian unless it has a stress.
struct ShearSettings {
  std::optional<double> eyring_stress = {};         ///< tau_E [Pa]
  std::optional<double> limiting_stress = {};       ///< tau_0 [Pa]
  std::optional<double> limiting_coefficient = {};  ///< zeta
};
const Parameters<ShearSettings>& shear_parameters();
material::Shear shear_of(const ShearSettings& settings, const io::Config& file);

/// Solids that touch.
struct AsperitySettings {
  std::optional<double> boundary_film = {};         ///< h_b [m]
  std::optional<double> friction_coefficient = {};  ///< mu_b
  std::optional<double> shear_strength = {};        ///< tau_b [Pa]
};
const Parameters<AsperitySettings>& asperity_parameters();
/// Without a boundary film, one of 0.
Asperities asperities_of(const AsperitySettings& settings, const io::Config& file);

}  // namespace tabor::ehl
