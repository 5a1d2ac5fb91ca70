#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/ehl/asperities.hpp"
#include "tabor/ehl/program.hpp"
#include "tabor/io/toml.hpp"
#include "tabor/material/lubricant.hpp"

/// What the cases of all elastohydrodynamic programs have in common.
namespace tabor::ehl {

/// Runs a reader of the modules below and says at which key its complaint arose.
template <typename Read>
auto at_key(const io::Config& config, std::string_view key, Read read) {
  try {
    return read();
  } catch (const InputError& error) {
    throw InputError(config.place(key) + ": " + error.what());
  }
}

/// Quantities of a case; a wrong one throws InputError with file, line and key.
double positive_quantity(const io::Config& config, std::string_view key, Dimension dimension);
double positive_quantity_or(const io::Config& config, std::string_view key, Dimension dimension,
                            double otherwise);
std::string text_or(const io::Config& config, std::string_view key, const std::string& otherwise);
std::int64_t integer_or(const io::Config& config, std::string_view key, std::int64_t otherwise);
bool flag_or(const io::Config& config, std::string_view key, bool otherwise);

/// [solids]: e_prime (2 E*), or youngs_modulus and poissons_ratio with those of the counter body
/// (rigid unless given). Returns E* [Pa].
double read_effective_modulus(const io::Config& config);
const CaseKeys& solids_keys();

/// [lubricant]: viscosity, or glycerol_fraction and temperature; viscosity_law, pressure_viscosity,
/// density_law. `usual_law` is the viscosity law where the case names none.
material::Lubricant read_lubricant(const io::Config& config, const std::string& usual_law);
CaseKeys lubricant_keys(const std::string& usual_law);
CaseKeys viscosity_keys(const std::string& usual_law);  ///< those without the density's

/// [lubricant]: eyring_stress, or limiting_stress with limiting_coefficient; Newtonian without.
material::Shear read_shear(const io::Config& config);
const CaseKeys& shear_keys();

/// [asperities]: boundary_film, unless given `usual_film` [m]; friction_coefficient or
/// shear_strength.
Asperities read_asperities(const io::Config& config, double usual_film);
CaseKeys asperity_keys(const std::string& usual_film);

/// The file that a key names, from where the case lies.
std::filesystem::path named_file(const io::Config& config, std::string_view key);

/// What makes the surface that a key asks for. Throws InputError where the setting has nothing.
const SurfaceSource& with_source(const io::Config& config, std::string_view key,
                                 const CaseSetting& setting);

}  // namespace tabor::ehl
