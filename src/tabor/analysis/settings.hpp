#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tabor/contact/contact.hpp"
#include "tabor/core/names.hpp"
#include "tabor/deposition/deposition.hpp"
#include "tabor/friction/mixed_friction.hpp"

// What is asked of a contact, a film and the friction of both: the same structs for the options of
// the command line, for study files and for programs.
namespace tabor::analysis {

/// What surrounds the scan.
enum class Boundary {
  periodic,  ///< it repeats
  free       ///< nothing: it is loaded on the scan only
};
inline constexpr auto kBoundaries = names<Boundary>("periodic", "free");
inline constexpr auto kSolvers = names<contact::Solver>("fast", "polonsky-keer");

/// How contacts of a rough body with a flat one are solved.
struct ContactSettings {
  std::string material = {};  ///< name in the library, "" if it is not from there
  double youngs_modulus = 0;  ///< of the rough body [Pa]
  double poissons_ratio = 0;
  std::optional<double> counter_youngs_modulus = {};  ///< [Pa], absent: rigid
  std::optional<double> counter_poissons_ratio = {};
  std::optional<double> saturation_pressure = {};  ///< p_sat [Pa], absent: elastic
  Boundary boundary = Boundary::periodic;
  contact::Solver solver = contact::Solver::fast;
  double tolerance = 1e-6;  ///< on the certificate
  bool load_path = false;   ///< the plastic indentation of a state is kept in the next
  bool statistics = false;  ///< stiffness and histograms, too

  /// The scan repeats.
  bool is_periodic() const { return boundary == Boundary::periodic; }
  double effective_modulus() const;  ///< E* [Pa]; throws InputError for solids that do not exist
  double pressure_cap() const { return saturation_pressure.value_or(contact::kNoSaturation); }
};

/// How oil is laid on a surface.
struct FilmSettings {
  std::vector<double> lubricant_densities = {};  ///< areal, as dosed [kg/m^2]
  double oil_density = 900;                      ///< [kg/m^3]
  double droplet_height = 1e-7;                  ///< droplet volume / pixel area [m]
  deposition::Model model = deposition::Model::droplets;
  deposition::Reading reading = deposition::Reading::conserving;
  deposition::Edge edge = deposition::Edge::closed;
  std::uint64_t seed = 1;
};

/// Whether the oil only keeps contact from rubbing, or flows and carries part of the load.
enum class Fluid { none, reynolds };
inline constexpr auto kFluids = names<Fluid>("none", "reynolds");

/// How the oil flows while the flat slides.
struct FluidSettings {
  Fluid fluid = Fluid::none;
  std::optional<double> sliding_speed = {};       ///< [m/s], along +x
  std::optional<double> viscosity = {};           ///< [Pa s]
  std::optional<double> pressure_viscosity = {};  ///< of Roelands' law [1/Pa], absent: constant
  std::optional<double> eyring_stress = {};       ///< [Pa], absent: Newtonian

  /// The oil flows and carries part of the load.
  bool flows() const { return fluid != Fluid::none; }
  /// What the film solver needs of the oil; a viscosity that is not given counts as 0.
  friction::FlowingOil oil() const;
};

/// What turns contact into friction.
struct FrictionSettings {
  double shear_strength = 0;                           ///< tau_y [Pa]
  std::optional<double> boundary_shear_strength = {};  ///< tau_b of wet contact [Pa]
  std::optional<double> boundary_shear_share = {};     ///< the same over tau_y
  std::optional<friction::Area> area = {};             ///< absent: as area_of() chooses

  /// The area that friction is computed with. Unless it is given: counted pixels with a saturation
  /// pressure, as Costagliola et al. 2021 count, since the corrected area is bounded by P / p_sat
  /// there and mostly lies on that bound; the corrected area of elastic contact.
  friction::Area area_of(const ContactSettings& contact) const {
    return area.value_or(contact.saturation_pressure ? friction::Area::pixels
                                                     : friction::Area::corrected);
  }
  /// tau_b [Pa] of the boundary film on wet contact; 0 unless given: it slips freely.
  double boundary_strength() const {
    return boundary_shear_strength.value_or(boundary_shear_share.value_or(0) * shear_strength);
  }
};

/// Friction of one surface under every pressure with every density.
struct CaseSettings {
  std::vector<double> mean_pressures = {};  ///< [Pa]
  ContactSettings contact = {};
  FilmSettings film = {};
  FluidSettings fluid = {};
  FrictionSettings friction = {};
};

/// Takes from the library what is known of a solid; what is not stays as it is. Throws InputError
/// for an unknown name.
void take_material(std::string_view name, CaseSettings& settings);

/// What is wrong with settings before anything is computed.
struct Objection {
  std::string setting;  ///< "saturation_pressure": whoever asked knows how he called it
  std::string got;
  std::string expected;
  std::string remedy = {};
  bool is_about_use = false;  ///< settings that do not go together, not a value out of range
};

/// How those who asked call a setting: "--pressure" for "mean_pressure".
using Spelling = std::function<std::string(std::string_view setting)>;

/// The first objection to what is asked, if any. What only the laws of a material can say is
/// thrown as InputError.
std::optional<Objection> objection(const ContactSettings& settings,
                                   const std::vector<double>& mean_pressures,
                                   const Spelling& spelling);
std::optional<Objection> objection(const FilmSettings& settings);
std::optional<Objection> objection(const FluidSettings& settings, const ContactSettings& contact,
                                   const Spelling& spelling);
std::optional<Objection> objection(const FrictionSettings& settings, const Spelling& spelling);

}  // namespace tabor::analysis
