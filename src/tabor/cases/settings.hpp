#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tabor/cases/tool.hpp"
#include "tabor/contact/contact.hpp"
#include "tabor/core/names.hpp"
#include "tabor/deposition/deposition.hpp"
#include "tabor/friction/mixed_friction.hpp"
#include "tabor/record/parameter.hpp"
#include "tabor/topography/edges.hpp"

// Defines the settings of a contact, a film and the friction of both: the same structs serve the
// options of the command line, study files and programs.
namespace tabor::cases {

/// Surface beyond the edges of the scan.
enum class Boundary {
  periodic,  ///< it repeats
  free       ///< nothing: it is loaded on the scan only
};
inline constexpr auto kBoundaries = names<Boundary>("periodic", "free");
inline constexpr auto kSolvers = names<contact::Solver>("fast", "polonsky-keer");

/// Settings for the contact of a rough body with a flat or a rough tool.
struct ContactSettings {
  std::string material = {};  ///< name in the library, "" if it is not from there
  double youngs_modulus = 0;  ///< of the rough body [Pa]
  double poissons_ratio = 0;
  std::optional<double> counter_youngs_modulus = {};  ///< [Pa], absent: rigid
  std::optional<double> counter_poissons_ratio = {};
  std::optional<double> saturation_pressure = {};  ///< p_sat [Pa], absent: elastic
  std::optional<Boundary> boundary = {};           ///< absent: as the edges of the surface say
  contact::Solver solver = contact::Solver::fast;
  double tolerance = 1e-6;  ///< on the certificate
  bool load_path = false;   ///< the next state starts with the plastic indentation of this one
  bool statistics = false;  ///< stiffness and histograms, too
  ToolSettings tool = {};   ///< in place of the flat

  /// Returns the boundary in force: the surface repeats unless something else is set.
  Boundary boundary_in_force() const { return boundary.value_or(Boundary::periodic); }
  /// True where the surface repeats.
  bool is_periodic() const { return boundary_in_force() == Boundary::periodic; }
  /// Takes the boundary from the known edges of the surface, unless one is set.
  void take_edges(const std::optional<topography::Edges>& edges);
  double effective_modulus() const;  ///< E* [Pa]; throws InputError for solids that do not exist
  double pressure_cap() const { return saturation_pressure.value_or(contact::kNoSaturation); }
};

/// Settings for the oil on a surface.
struct FilmSettings {
  std::vector<double> lubricant_densities = {};  ///< areal, as dosed [kg/m^2]
  double oil_density = 900;                      ///< [kg/m^3]
  double droplet_height = 1e-7;                  ///< droplet volume / pixel area [m]
  deposition::Model model = deposition::Model::droplets;
  deposition::Reading reading = deposition::Reading::conserving;
  deposition::Edge edge = deposition::Edge::closed;
  std::uint64_t seed = 1;
};

/// Model of the oil: it only separates wet contacts (none), or it flows and carries part of the
/// load.
enum class Fluid { none, reynolds };
inline constexpr auto kFluids = names<Fluid>("none", "reynolds");

/// Settings for the flow of the oil while the flat slides.
struct FluidSettings {
  Fluid fluid = Fluid::none;
  std::optional<double> sliding_speed = {};       ///< [m/s], along +x
  std::optional<double> viscosity = {};           ///< [Pa s]
  std::optional<double> pressure_viscosity = {};  ///< of Roelands' law [1/Pa], absent: constant
  std::optional<double> eyring_stress = {};       ///< [Pa], absent: Newtonian

  /// True where the oil flows and carries part of the load.
  bool flows() const { return fluid != Fluid::none; }
  /// Returns what the film solver needs of the oil; a viscosity that is not given counts as 0.
  friction::FlowingOil oil() const;
};

/// Settings for the oil in closed pockets of the gap: it only separates wet contacts, or it is
/// squeezed and carries part of the load.
struct TrappedSettings {
  bool trapped = false;
  double bulk_modulus = kOilBulkModulus;  ///< K of the oil [Pa]; infinite: incompressible

  /// True where trapped oil carries load.
  bool is_asked() const { return trapped; }
  static constexpr double kOilBulkModulus = 1.5e9;  ///< of mineral oil [Pa]
};

/// Settings that turn contact into friction.
struct FrictionSettings {
  double shear_strength = 0;                           ///< tau_y [Pa]
  std::optional<double> boundary_shear_strength = {};  ///< tau_b of wet contact [Pa]
  std::optional<double> boundary_shear_share = {};     ///< the same over tau_y
  std::optional<friction::Area> area = {};             ///< absent: as area_of() chooses
  double dry_below = 0;                                ///< a film no thicker is no film [m]

  /// Returns the area that friction is computed with. Default: counted pixels with a saturation
  /// pressure, as Costagliola et al. 2021 count, since the corrected area is bounded by P / p_sat
  /// there and mostly lies on that bound; the corrected area of elastic contact.
  friction::Area area_of(const ContactSettings& contact) const {
    return area.value_or(contact.saturation_pressure ? friction::Area::pixels
                                                     : friction::Area::corrected);
  }
  /// Returns tau_b [Pa] of the boundary film on wet contact; 0 unless given: it slips freely.
  double boundary_strength() const {
    return boundary_shear_strength.value_or(boundary_shear_share.value_or(0) * shear_strength);
  }
};

/// Settings for the friction of one surface under every pressure with every density.
struct CaseSettings {
  std::vector<double> mean_pressures = {};  ///< [Pa]
  std::vector<double> separations = {};     ///< of the flat, in place of pressures [m]
  std::vector<double> forces = {};          ///< on the whole surface, in place of pressures [N]
  ContactSettings contact = {};
  FilmSettings film = {};
  TrappedSettings trapped = {};
  FluidSettings fluid = {};
  FrictionSettings friction = {};
};

/// Returns what the contacts are solved under: the list that is given.
std::vector<contact::Control> controls_of(const CaseSettings& settings);

/// Takes the known values of a solid from the library; the other settings stay as they are. Throws
/// InputError for an unknown name.
void take_material(std::string_view name, CaseSettings& settings);

using tabor::Objection;

/// Maps a setting to the caller's spelling: "--pressure" for "mean_pressure".
using Spelling = std::function<std::string(std::string_view setting)>;

/// Returns the first objection to the settings, if any: a value out of its bounds (parameters.hpp),
/// or settings that exclude each other. Throws InputError for values that only the laws of a
/// material can reject.
std::optional<Objection> objection(const ContactSettings& settings,
                                   const std::vector<double>& mean_pressures,
                                   const Spelling& spelling);
/// Returns an objection unless exactly one of pressures, separations and forces is given, or to one
/// of their values. `boundary_is_known`: the surface has been asked for its edges.
std::optional<Objection> objection_to_controls(const CaseSettings& settings, bool boundary_is_known,
                                               const Spelling& spelling);
/// Returns an objection to a boundary that contradicts the known edges of the surface.
std::optional<Objection> objection(const ContactSettings& settings,
                                   const std::optional<topography::Edges>& edges);
std::optional<Objection> objection(const FilmSettings& settings);
std::optional<Objection> objection(const FluidSettings& settings, const ContactSettings& contact,
                                   const Spelling& spelling);
/// Returns an objection to the settings of trapped oil, or to others that exclude it.
std::optional<Objection> objection_to_trapped(const CaseSettings& settings,
                                              const Spelling& spelling);
/// `material` names the solid of the library that the settings were taken from, if any; the
/// objection names it where it has no shear strength.
std::optional<Objection> objection(const FrictionSettings& settings, const Spelling& spelling,
                                   std::string_view material = {});

}  // namespace tabor::cases
