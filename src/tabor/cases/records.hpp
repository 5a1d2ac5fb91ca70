#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tabor/cases/warning.hpp"
#include "tabor/contact/contact.hpp"
#include "tabor/contact/distributions.hpp"
#include "tabor/contact/stiffness.hpp"
#include "tabor/contact/trapped_liquid.hpp"
#include "tabor/core/column.hpp"
#include "tabor/deposition/deposition.hpp"
#include "tabor/friction/bowden_tabor.hpp"
#include "tabor/friction/fluid_film.hpp"
#include "tabor/friction/mixed_friction.hpp"

// Defines the results of a contact, a film and the friction of both: numbers, maps, warnings,
// references. The columns of each record define the names of its numbers.
namespace tabor::cases {

inline constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

/// Outputs in which a column appears.
namespace media {
inline constexpr Media kObject =
    1;                              ///< the JSON object of a verb and the attributes of its -o file
inline constexpr Media kStore = 2;  ///< what a study stores
inline constexpr Media kCsv = 4;    ///< results.csv, whose columns are agreed
inline constexpr Media kTable = 8;  ///< /table of results.h5
inline constexpr Media kObjectAndStore = kObject | kStore;
inline constexpr Media kRow = kStore | kCsv | kTable;
}  // namespace media

/// Contact stiffness and histograms.
struct ContactStatistics {
  contact::Stiffness stiffness;
  contact::Histogram pressure;
  contact::Histogram gap;
  contact::Histogram patch_area;
};

/// Place of a tool over the surface.
struct ToolPlace {
  double x = 0;  ///< [m]
};

/// One solved contact.
struct ContactRecord {
  /// topography::digest_of() the pressed surface; 0 where it is not known, as in a record that was
  /// read from a store, where the name of its file tells surfaces apart. The other records use it
  /// in the same way.
  std::uint64_t surface = 0;
  contact::Summary summary;
  Convergence convergence;
  double fft_seconds = 0;
  double seconds = 0;
  std::size_t peak_memory = 0;  ///< of the program so far [bytes]
  std::optional<ContactStatistics> statistics;
  Warnings warnings;                         ///< of its surface and its own
  std::vector<std::string> references;       ///< to cite: keys of references.bib; not stored
  std::optional<ToolPlace> tool_place = {};  ///< absent under a flat
  std::shared_ptr<const Field> tool = {};    ///< heights of the tool [m]; null under a flat
  contact::State state;                      ///< maps; empty in a record that was read from a store
};
const Columns<ContactRecord>& contact_columns();

/// One film as it was laid down.
struct FilmRecord {
  std::uint64_t surface = 0;            ///< digest of the surface below it
  double lubricant_density = 0;         ///< [kg/m^2]
  deposition::Film film;                ///< its place in the settings is film.request
  std::size_t peak_memory = 0;          ///< of the program so far [bytes]
  Warnings warnings;                    ///< its own
  std::vector<std::string> references;  ///< to cite; not stored

  /// Returns the mean film [m] without what has run off open edges.
  double mean_film_left() const {
    const double dosed = film.deposited_volume + film.lost_volume;
    return film.lost_volume > 0 ? film.mean_film * (film.deposited_volume / dosed) : film.mean_film;
  }
};
/// Columns of one film.
const Columns<FilmRecord>& film_columns();

/// One film in one contact, whose closed pockets carry load.
struct TrappedRecord {
  std::uint64_t surface = 0;      ///< digest of the surface below it
  contact::Summary solids;        ///< of the solids alone
  contact::LiquidSummary liquid;  ///< of the pockets
  double lubricated_share = 0;    ///< of the solid contact
  Convergence convergence;
  Warnings warnings;
  std::vector<std::string> references;  ///< to cite; not stored
  contact::TrappedState state;          ///< maps; empty in a record that was read from a store

  /// True for the pressures of contact and pockets, and the seals between them.
  bool converged() const { return convergence.converged() && liquid.seals_settled; }
};
/// Columns for the store alone: a user sees these numbers as numbers of friction.
const Columns<TrappedRecord>& trapped_columns();

/// One film that flows between the surfaces of one contact.
struct FluidRecord {
  std::uint64_t surface = 0;  ///< digest of the surface below it
  double sliding_speed = 0;   ///< [m/s]
  friction::FluidSummary summary;
  Warnings warnings;
  std::vector<std::string> references;  ///< to cite; not stored
  friction::FluidFilmState state;       ///< maps; empty in a record that was read from a store
};
/// Columns for the store alone: a user sees these numbers as numbers of friction.
const Columns<FluidRecord>& fluid_columns();

/// A film in a contact, and what it does there beside wetting; null: it does not.
struct Oil {
  const FilmRecord& film;
  const TrappedRecord* trapped = nullptr;
  const FluidRecord* fluid = nullptr;
};

/// Numbers that a flowing film adds to the friction of a contact.
struct FlowingFriction {
  double sliding_speed = 0;                 ///< [m/s]
  double load_share = kNoValue;             ///< of the load, that the oil carries
  double max_pressure = kNoValue;           ///< of the oil [Pa]
  double contact_area_fraction = kNoValue;  ///< while sliding
  double mean_gap = kNoValue;               ///< while sliding [m]
  double full_fraction = kNoValue;          ///< share of the pixels whose gap is full
  double outside_film = kNoValue;  ///< oil that the gap cannot hold, over the nominal area [m]
  double friction_solid = kNoValue;
  double friction_viscous = kNoValue;
  double friction_mixed = kNoValue;
  double load_error = kNoValue;
  double gap_error = kNoValue;
  double pressure_error = kNoValue;
  int evaluations = 0;
  int iterations = 0;
  bool converged = false;  ///< film and load balance
};

/// Numbers that trapped oil adds to the friction of a contact.
struct TrappedFriction {
  double load_share = kNoValue;             ///< of the load, that the oil carries
  double max_pressure = kNoValue;           ///< of the oil [Pa]
  Index n_pockets = 0;                      ///< closed, with oil
  Index n_squeezed = 0;                     ///< of these, with pressure
  Index n_at_seal = 0;                      ///< of these, leaking through their seals
  double leaked_fraction = kNoValue;        ///< of the oil in pockets
  double contact_area_fraction = kNoValue;  ///< of the solids, that friction is computed with
  double lubricated_share = kNoValue;       ///< of that contact
  double mean_gap = kNoValue;               ///< [m]
  double friction_solid = kNoValue;         ///< of dry contact
  double friction_boundary = kNoValue;      ///< of wet contact
  double certificate = kNoValue;
  bool converged = false;
};

/// Columns of these numbers, beside those of a friction or of a slide.
const Columns<TrappedFriction>& trapped_friction_columns();

/// Standard deviations of a friction over the places of a tool.
struct ToolSpread {
  double area_fraction = 0;  ///< of the area that friction is computed with
  double friction_dry = 0;
  double friction_lubricated = 0;
};

/// What a rough tool adds to the friction of a contact: its place, or the spread over its places.
struct ToolFriction {
  std::uint64_t n_places = 1;
  std::optional<ToolPlace> place = {};    ///< absent for a mean over several places
  std::optional<ToolSpread> spread = {};  ///< absent for one place
};

/// The friction of one contact with one film. Numbers are NaN where there are none.
struct FrictionRecord {
  double mean_pressure = 0;      ///< [Pa]
  double lubricant_density = 0;  ///< [kg/m^2]
  double contact_area_fraction = kNoValue;
  double contact_area_fraction_pixels = kNoValue;
  double saturated_area_fraction = kNoValue;
  double mean_gap = kNoValue;    ///< [m]
  double separation = kNoValue;  ///< [m]
  double mean_film = kNoValue;   ///< [m]
  double lubricated_share = kNoValue;
  double spill_over_fraction = kNoValue;
  double trapped_fraction = kNoValue;   ///< of the liquid, in closed pockets
  double escaping_fraction = kNoValue;  ///< of the liquid, with a path out through the gap
  friction::Area area = friction::Area::corrected;
  double boundary_shear_strength = 0;        ///< of wet contact [Pa]
  double friction_area_fraction = kNoValue;  ///< that friction was computed with
  bool dry_at_bound = false;                 ///< dry friction is tau_y / p_sat
  double friction_dry = kNoValue;
  double friction_lubricated = kNoValue;
  double certificate = kNoValue;
  double contact_gap_error = kNoValue;     ///< [m]
  bool converged = false;                  ///< contact, and film if it flows
  std::optional<TrappedFriction> trapped;  ///< absent where trapped oil carries nothing
  std::optional<FlowingFriction> fluid;    ///< absent where the oil does not flow
  std::optional<ToolFriction> tool;        ///< absent under a flat
  Warnings warnings;                       ///< of its surface, contact, film and friction
  std::vector<std::string> references;     ///< of all of them, to cite; not stored
};
/// Columns for tables on the terminal: the area that friction was computed with, under the name of
/// its count, so that a table has one of the two areas and says which.
const Columns<FrictionRecord>& friction_area_columns();
struct CaseSettings;

/// Parts of a friction that not every case has, and their columns.
struct FrictionParts {
  bool trapped = true;  ///< trapped oil carries load
  bool fluid = true;    ///< the oil flows
  bool tool = true;     ///< a rough tool presses
};
FrictionParts parts_of(const CaseSettings& settings);
FrictionParts parts_of(const FrictionRecord& record);
Columns<FrictionRecord> friction_columns(const FrictionParts& parts = {});

}  // namespace tabor::cases
