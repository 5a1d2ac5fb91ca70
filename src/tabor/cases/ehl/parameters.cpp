#include "tabor/cases/ehl/parameters.hpp"

#include "tabor/cases/ehl/case.hpp"
#include "tabor/material/lubricant_mixture.hpp"
#include "tabor/material/solid.hpp"

namespace tabor::ehl {

namespace {

const Bounds kPoissonsRatio{
    .least = -1, .most = 0.5, .least_is_out = true, .text = "above -1 and at most 0.5"};
const Bounds kFraction{.least = 0, .most = 1, .text = "0 to 1; 95 % is written 0.95"};
const Bounds kLiquidWater{
    .least = 273.15, .most = 373.15, .text = "0 to 100 degC, where the formula was fitted"};

}  // namespace

const Parameters<SolidSettings>& solid_parameters() {
  using Settings = SolidSettings;
  using One = Parameter<Settings>;
  static const Parameters<Settings> all{
      One({.name = "solids.e_prime",
           .help = "E' = 2 E* = 2/[(1 - nu1^2)/E1 + (1 - nu2^2)/E2]; this or youngs_modulus",
           .example = "230 GPa",
           .dimension = dimension::pressure,
           .bounds = kAboveZero,
           .absent = "from the moduli below"},
          &Settings::e_prime),
      One({.name = "solids.youngs_modulus",
           .help = "E1 of the deforming body",
           .example = "210 GPa",
           .dimension = dimension::pressure,
           .bounds = kAboveZero},
          &Settings::youngs_modulus),
      One({.name = "solids.poissons_ratio",
           .help = "nu1",
           .example = "0.3",
           .bounds = kPoissonsRatio,
           .absent = "required beside it"},
          &Settings::poissons_ratio),
      One({.name = "solids.counter_youngs_modulus",
           .help = "E2 of the counter body",
           .example = "210 GPa",
           .dimension = dimension::pressure,
           .bounds = kAboveZero,
           .absent = "a rigid counter body"},
          &Settings::counter_youngs_modulus),
      One({.name = "solids.counter_poissons_ratio",
           .help = "nu2",
           .example = "0.3",
           .bounds = kPoissonsRatio,
           .absent = "required beside it"},
          &Settings::counter_poissons_ratio)};
  return all;
}

double effective_modulus(const SolidSettings& settings, const io::Config& file) {
  if (settings.e_prime) {
    if (settings.youngs_modulus) {
      reject_beside(file, "solids.e_prime", "youngs_modulus",
                    "e_prime is 2/[(1 - nu1^2)/E1 + (1 - nu2^2)/E2]");
    }
    return *settings.e_prime / 2;
  }
  const material::Solid solid{
      .youngs_modulus = required(settings.youngs_modulus, file, "solids.youngs_modulus"),
      .poissons_ratio = required(settings.poissons_ratio, file, "solids.poissons_ratio")};
  if (!settings.counter_youngs_modulus) return material::effective_modulus(solid);
  const material::Solid counter{.youngs_modulus = *settings.counter_youngs_modulus,
                                .poissons_ratio = required(settings.counter_poissons_ratio, file,
                                                           "solids.counter_poissons_ratio")};
  return material::effective_modulus(solid, counter);
}

namespace {

/// `laws`: those that can be chosen, and why no others.
template <typename Names>
Parameters<LubricantSettings> viscosity_parameters(const Names& laws, const std::string& why = "") {
  using Settings = LubricantSettings;
  using One = Parameter<Settings>;
  return {One({.name = "lubricant.viscosity",
               .help = "eta0, at ambient pressure",
               .example = "0.1 Pa s",
               .dimension = dimension::viscosity,
               .bounds = kAboveZero,
               .absent = "from the next two"},
              &Settings::viscosity),
          One({.name = "lubricant.glycerol_fraction",
               .help = "mass fraction of glycerol in water, 0 to 1",
               .example = "0.95",
               .bounds = kFraction},
              &Settings::glycerol_fraction),
          One({.name = "lubricant.temperature",
               .help = "of glycerol-water, 0 to 100 degC (\"24 degC\")",
               .example = "24 degC",
               .dimension = dimension::temperature,
               .bounds = kLiquidWater},
              &Settings::temperature),
          One({.name = "lubricant.viscosity_law", .help = why}, &Settings::viscosity_law, laws),
          One({.name = "lubricant.pressure_viscosity",
               .help = "alpha, by how much viscosity grows with pressure",
               .example = "2e-8 1/Pa",
               .dimension = dimension::per_pressure,
               .bounds = bounds::zero_or_more,
               .absent = "required, unless the law is constant"},
              &Settings::pressure_viscosity)};
}

}  // namespace

const Parameters<LubricantSettings>& lubricant_parameters() {
  static const Parameters<LubricantSettings> all = joined(
      viscosity_parameters(material::kViscosityLaws),
      {{{{.name = "lubricant.density_law", .example = "dowson-higginson", .absent = "constant"},
         &LubricantSettings::density_law,
         material::kDensityLaws}}});
  return all;
}

const Parameters<LubricantSettings>& closed_form_parameters() {
  static const Parameters<LubricantSettings> all =
      viscosity_parameters(names<material::ViscosityLaw>("constant", "barus"),
                           "constant or barus: under no other the film is known in closed form");
  return all;
}

namespace {

/// [Pa s]: as given, or of the glycerol-water mixture that is.
double ambient_viscosity(const LubricantSettings& settings, const io::Config& file) {
  if (!settings.glycerol_fraction) {
    if (settings.temperature) {
      reject_without(file, "lubricant.temperature", "glycerol_fraction",
                     "a given viscosity is taken as it is");
    }
    return required(settings.viscosity, file, "lubricant.viscosity");
  }
  if (settings.viscosity) {
    reject_beside(file, "lubricant.glycerol_fraction", "viscosity",
                  "glycerol_fraction and temperature give the viscosity");
  }
  const double kelvin = required(settings.temperature, file, "lubricant.temperature");
  return material::glycerol_water_viscosity(*settings.glycerol_fraction, kelvin);
}

}  // namespace

material::Lubricant lubricant_of(const LubricantSettings& settings, const io::Config& file) {
  material::Lubricant lubricant;
  const double ambient = ambient_viscosity(settings, file);
  const bool is_constant = settings.viscosity_law == material::ViscosityLaw::constant;
  const double coefficient =
      is_constant ? 0.0
                  : required(settings.pressure_viscosity, file, "lubricant.pressure_viscosity");
  lubricant.viscosity = at_key(file, "lubricant.viscosity", [&] {
    return material::make_viscosity(settings.viscosity_law, ambient, coefficient);
  });
  lubricant.density =
      material::relative_density(settings.density_law.value_or(material::DensityLaw::constant));
  return lubricant;
}

const Parameters<ShearSettings>& shear_parameters() {
  using Settings = ShearSettings;
  using One = Parameter<Settings>;
  static const Parameters<Settings> all{
      One({.name = "lubricant.eyring_stress",
           .help = "tau_E of Ree and Eyring",
           .example = "5 MPa",
           .dimension = dimension::pressure,
           .bounds = kAboveZero,
           .absent = "Newtonian"},
          &Settings::eyring_stress),
      One({.name = "lubricant.limiting_stress",
           .help = "tau_0 of tau_L = tau_0 + zeta p, instead of eyring_stress",
           .example = "50 MPa",
           .dimension = dimension::pressure,
           .bounds = kAboveZero,
           .absent = "Newtonian"},
          &Settings::limiting_stress),
      One({.name = "lubricant.limiting_coefficient",
           .help = "zeta, beside limiting_stress",
           .example = "0.05",
           .bounds = bounds::zero_or_more,
           .absent = "0"},
          &Settings::limiting_coefficient)};
  return all;
}

material::Shear shear_of(const ShearSettings& settings, const io::Config& file) {
  if (settings.limiting_coefficient && !settings.limiting_stress) {
    reject_without(file, "lubricant.limiting_coefficient", "limiting_stress");
  }
  if (settings.eyring_stress) {
    if (settings.limiting_stress) reject_beside(file, "lubricant.limiting_stress", "eyring_stress");
    return material::ree_eyring_shear(*settings.eyring_stress);
  }
  if (settings.limiting_stress) {
    return material::limiting_shear(*settings.limiting_stress,
                                    settings.limiting_coefficient.value_or(0));
  }
  return material::NewtonianShear{};
}

const Parameters<AsperitySettings>& asperity_parameters() {
  using Settings = AsperitySettings;
  using One = Parameter<Settings>;
  static const Parameters<Settings> all{
      One({.name = "asperities.boundary_film",
           .help = "h_b: solids touch where no more film than this is left",
           .example = "10 nm",
           .dimension = dimension::length,
           .bounds = kAboveZero,
           .absent = "nothing touches"},  // in a line contact; that of a point has a default
          &Settings::boundary_film),
      One({.name = "asperities.friction_coefficient",
           .help = "mu_b of what solids carry where they touch without flowing; 0: frictionless",
           .example = "0.1",
           .bounds = bounds::zero_or_more,
           .absent = "not known"},
          &Settings::friction_coefficient),
      One({.name = "asperities.shear_strength",
           .help = "tau_b of the area where they so touch, instead of friction_coefficient",
           .example = "50 MPa",
           .dimension = dimension::pressure,
           .bounds = kAboveZero,
           .absent = "not known"},
          &Settings::shear_strength)};
  return all;
}

Asperities asperities_of(const AsperitySettings& settings, const io::Config& file) {
  if (settings.friction_coefficient && settings.shear_strength) {
    reject_beside(file, "asperities.shear_strength", "friction_coefficient");
  }
  return {.boundary_film = settings.boundary_film.value_or(0),
          .friction_coefficient = settings.friction_coefficient,
          .shear_strength = settings.shear_strength};
}

}  // namespace tabor::ehl
