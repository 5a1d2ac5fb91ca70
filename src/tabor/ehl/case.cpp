#include "tabor/ehl/case.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/material/lubricant_mixture.hpp"
#include "tabor/material/solid.hpp"

namespace tabor::ehl {

namespace {

material::Solid read_solid(const io::Config& config, const std::string& prefix) {
  material::Solid solid;
  solid.youngs_modulus = positive_quantity(config, prefix + "youngs_modulus", dimension::pressure);
  solid.poissons_ratio = config.number(prefix + "poissons_ratio");
  return solid;
}

}  // namespace

std::filesystem::path named_file(const io::Config& config, std::string_view key) {
  return std::filesystem::path(config.name()).parent_path() / config.text(key);
}

const SurfaceSource& with_source(const io::Config& config, std::string_view key,
                                 const CaseSetting& setting) {
  if (setting.surfaces.read && setting.surfaces.generate) return setting.surfaces;
  throw InputError(config.place(key), "nothing that makes surfaces", "CaseSetting::surfaces",
                   "analysis::ehl_surfaces() reads scans and generates finishes");
}

double positive_quantity(const io::Config& config, std::string_view key, Dimension dimension) {
  const double value = config.quantity(key, dimension);
  if (!(value > 0) || !std::isfinite(value)) {
    throw InputError(config.place(key), fmt::format("{}", value), "a value above zero", "");
  }
  return value;
}

double positive_quantity_or(const io::Config& config, std::string_view key, Dimension dimension,
                            double otherwise) {
  return config.has(key) ? positive_quantity(config, key, dimension) : otherwise;
}

std::string text_or(const io::Config& config, std::string_view key, const std::string& otherwise) {
  return config.has(key) ? config.text(key) : otherwise;
}

std::int64_t integer_or(const io::Config& config, std::string_view key, std::int64_t otherwise) {
  return config.has(key) ? config.integer(key) : otherwise;
}

bool flag_or(const io::Config& config, std::string_view key, bool otherwise) {
  return config.has(key) ? config.flag(key) : otherwise;
}

double read_effective_modulus(const io::Config& config) {
  const bool has_modulus = config.has("solids.youngs_modulus");
  if (config.has("solids.e_prime")) {
    if (has_modulus) {
      throw InputError(config.place("solids.e_prime"), "beside youngs_modulus", "one of the two",
                       "e_prime is 2/[(1 - nu1^2)/E1 + (1 - nu2^2)/E2]");
    }
    return positive_quantity(config, "solids.e_prime", dimension::pressure) / 2;
  }
  return at_key(config, "solids", [&] {
    const material::Solid solid = read_solid(config, "solids.");
    if (!config.has("solids.counter_youngs_modulus")) return material::effective_modulus(solid);
    return material::effective_modulus(solid, read_solid(config, "solids.counter_"));
  });
}

const CaseKeys& solids_keys() {
  static const CaseKeys keys = {
      {"solids.e_prime", "Pa", "of the moduli below",
       "E' = 2 E* = 2/[(1 - nu1^2)/E1 + (1 - nu2^2)/E2]; this or youngs_modulus"},
      {"solids.youngs_modulus", "Pa", "", "E1 of the deforming body"},
      {"solids.poissons_ratio", "", "required beside it", "nu1"},
      {"solids.counter_youngs_modulus", "Pa", "a rigid counter body", "E2 of the counter body"},
      {"solids.counter_poissons_ratio", "", "required beside it", "nu2"}};
  return keys;
}

namespace {

constexpr double kIcePoint = 273.15;  // K

/// "24 degC" or a quantity in kelvin. Degrees Celsius are no unit like the others: two of them do
/// not make twice the temperature.
double read_temperature(const io::Config& config, std::string_view key) {
  const std::string text = config.text(key);
  for (const std::string_view unit : {"degC", "°C"}) {
    if (!text.ends_with(unit)) continue;
    const auto celsius = parse_number(trim(text.substr(0, text.size() - unit.size())));
    if (celsius) return *celsius + kIcePoint;
  }
  return positive_quantity(config, key, dimension::temperature);
}

/// [Pa s]: as given, or of the glycerol-water mixture that is.
double read_ambient_viscosity(const io::Config& config) {
  const bool is_mixture = config.has("lubricant.glycerol_fraction");
  if (is_mixture && config.has("lubricant.viscosity")) {
    throw InputError(config.place("lubricant.glycerol_fraction"), "beside viscosity",
                     "one of the two", "glycerol_fraction and temperature give the viscosity");
  }
  if (!is_mixture) {
    if (config.has("lubricant.temperature")) {
      throw InputError(config.place("lubricant.temperature"), "without glycerol_fraction",
                       "both or none", "a given viscosity is taken as it is");
    }
    return positive_quantity(config, "lubricant.viscosity", dimension::viscosity);
  }
  const double kelvin = read_temperature(config, "lubricant.temperature");
  return at_key(config, "lubricant.glycerol_fraction", [&] {
    return material::glycerol_water_viscosity(config.number("lubricant.glycerol_fraction"), kelvin);
  });
}

}  // namespace

material::Lubricant read_lubricant(const io::Config& config, const std::string& usual_law) {
  material::Lubricant lubricant;
  const double ambient = read_ambient_viscosity(config);
  const auto law = at_key(config, "lubricant.viscosity_law", [&] {
    return material::parse_viscosity_law(text_or(config, "lubricant.viscosity_law", usual_law));
  });
  const double coefficient =
      law == material::ViscosityLaw::constant
          ? 0.0
          : config.quantity("lubricant.pressure_viscosity", dimension::per_pressure);
  lubricant.viscosity = at_key(config, "lubricant.viscosity",
                               [&] { return material::make_viscosity(law, ambient, coefficient); });
  lubricant.density = at_key(config, "lubricant.density_law", [&] {
    return material::relative_density(
        material::parse_density_law(text_or(config, "lubricant.density_law", "constant")));
  });
  return lubricant;
}

CaseKeys viscosity_keys(const std::string& usual_law) {
  return {{"lubricant.viscosity", "Pa s", "of the next two", "eta0, at ambient pressure"},
          {"lubricant.glycerol_fraction", "", "", "mass fraction of glycerol in water, 0 to 1"},
          {"lubricant.temperature", "K", "", "of glycerol-water, 0 to 100 degC (\"24 degC\")"},
          {"lubricant.viscosity_law", "", usual_law, "constant, barus or roelands"},
          {"lubricant.pressure_viscosity", "1/Pa", "required, unless the law is constant",
           "alpha, by how much viscosity grows with pressure"}};
}

CaseKeys lubricant_keys(const std::string& usual_law) {
  return joined(viscosity_keys(usual_law),
                {{{"lubricant.density_law", "", "constant",
                   "constant, dowson-higginson or rounded-dowson-higginson"}}});
}

material::Shear read_shear(const io::Config& config) {
  const bool is_limited = config.has("lubricant.limiting_stress");
  if (config.has("lubricant.eyring_stress")) {
    if (is_limited) {
      throw InputError(config.place("lubricant.limiting_stress"), "beside eyring_stress",
                       "one of the two", "");
    }
    return material::ree_eyring_shear(
        positive_quantity(config, "lubricant.eyring_stress", dimension::pressure));
  }
  if (is_limited) {
    return at_key(config, "lubricant.limiting_coefficient", [&] {
      return material::limiting_shear(
          positive_quantity(config, "lubricant.limiting_stress", dimension::pressure),
          config.has("lubricant.limiting_coefficient")
              ? config.number("lubricant.limiting_coefficient")
              : 0.0);
    });
  }
  if (config.has("lubricant.limiting_coefficient")) {
    throw InputError(config.place("lubricant.limiting_coefficient"), "without limiting_stress",
                     "both or none", "");
  }
  return material::NewtonianShear{};
}

const CaseKeys& shear_keys() {
  static const CaseKeys keys = {
      {"lubricant.eyring_stress", "Pa", "Newtonian", "tau_E of Ree and Eyring"},
      {"lubricant.limiting_stress", "Pa", "Newtonian",
       "tau_0 of tau_L = tau_0 + zeta p, instead of eyring_stress"},
      {"lubricant.limiting_coefficient", "", "0", "zeta, beside limiting_stress"}};
  return keys;
}

Asperities read_asperities(const io::Config& config, double usual_film) {
  Asperities asperities;
  asperities.boundary_film =
      positive_quantity_or(config, "asperities.boundary_film", dimension::length, usual_film);
  const bool has_coefficient = config.has("asperities.friction_coefficient");
  if (has_coefficient && config.has("asperities.shear_strength")) {
    throw InputError(config.place("asperities.shear_strength"), "beside friction_coefficient",
                     "one of the two", "");
  }
  if (has_coefficient) {
    asperities.friction_coefficient = config.number("asperities.friction_coefficient");
  }
  if (config.has("asperities.shear_strength")) {
    asperities.shear_strength =
        positive_quantity(config, "asperities.shear_strength", dimension::pressure);
  }
  return asperities;
}

CaseKeys asperity_keys(const std::string& usual_film) {
  return {{"asperities.boundary_film", "m", usual_film,
           "h_b: solids touch where no more film than this is left"},
          {"asperities.friction_coefficient", "", "not known",
           "mu_b of what solids carry where they touch without flowing; 0: frictionless"},
          {"asperities.shear_strength", "Pa", "not known",
           "tau_b of the area where they so touch, instead of friction_coefficient"}};
}

}  // namespace tabor::ehl
