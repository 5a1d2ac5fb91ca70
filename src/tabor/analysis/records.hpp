#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tabor/analysis/warning.hpp"
#include "tabor/contact/contact.hpp"
#include "tabor/contact/distributions.hpp"
#include "tabor/contact/stiffness.hpp"
#include "tabor/core/column.hpp"
#include "tabor/deposition/deposition.hpp"
#include "tabor/friction/bowden_tabor.hpp"
#include "tabor/friction/fluid_film.hpp"
#include "tabor/friction/mixed_friction.hpp"

// What was found out about a contact, a film and the friction of both: numbers, maps, warnings, and
// what to cite. The columns of each record say how its numbers are called.
namespace tabor::analysis {

inline constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

/// Where a column appears.
namespace media {
inline constexpr Media kObject =
    1;                              ///< the JSON object of a verb and the attributes of its -o file
inline constexpr Media kStore = 2;  ///< what a study keeps
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

/// One solved contact.
struct ContactRecord {
  contact::Summary summary;
  Convergence convergence;
  double fft_seconds = 0;
  double seconds = 0;
  std::size_t peak_memory = 0;  ///< of the program so far [bytes]
  std::optional<ContactStatistics> statistics;
  Warnings warnings;                    ///< of its surface and its own
  std::vector<std::string> references;  ///< to cite: keys of references.bib; not kept in a store
  contact::State state;                 ///< maps; empty in a record that was read from a store
};
const Columns<ContactRecord>& contact_columns();

/// One film as it was laid down.
struct FilmRecord {
  double lubricant_density = 0;         ///< [kg/m^2]
  deposition::Film film;                ///< its place in the settings is film.request
  std::size_t peak_memory = 0;          ///< of the program so far [bytes]
  Warnings warnings;                    ///< its own
  std::vector<std::string> references;  ///< to cite; not kept in a store
};
const Columns<FilmRecord>& film_columns();

/// One film that flows between the surfaces of one contact.
struct FluidRecord {
  double sliding_speed = 0;  ///< [m/s]
  friction::FluidSummary summary;
  Warnings warnings;
  std::vector<std::string> references;  ///< to cite; not kept in a store
  friction::FluidFilmState state;       ///< maps; empty in a record that was read from a store
};
/// Of the store alone: to a user they are numbers of friction.
const Columns<FluidRecord>& fluid_columns();

/// What a film that flows adds to the friction of a contact.
struct FlowingFriction {
  double sliding_speed = 0;                 ///< [m/s]
  double load_share = kNoValue;             ///< of the load, that the oil carries
  double max_pressure = kNoValue;           ///< of the oil [Pa]
  double contact_area_fraction = kNoValue;  ///< while sliding
  double mean_gap = kNoValue;               ///< while sliding [m]
  double full_fraction = kNoValue;          ///< share of the pixels whose gap is full
  double outside_film = kNoValue;           ///< oil without room, over the nominal area [m]
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
  double escaping_fraction = kNoValue;  ///< of the liquid, with a way out through the gap
  friction::Area area = friction::Area::corrected;
  double boundary_shear_strength = 0;        ///< of wet contact [Pa]
  double friction_area_fraction = kNoValue;  ///< that friction was computed with
  bool dry_at_bound = false;                 ///< dry friction is tau_y / p_sat
  double friction_dry = kNoValue;
  double friction_lubricated = kNoValue;
  double certificate = kNoValue;
  double contact_gap_error = kNoValue;   ///< [m]
  bool converged = false;                ///< contact, and film if it flows
  std::optional<FlowingFriction> fluid;  ///< absent where the oil does not flow
  Warnings warnings;                     ///< of its surface, contact, film and friction
  std::vector<std::string> references;   ///< of all of them, to cite; not kept in a store
};
/// With or without those of a film that flows.
Columns<FrictionRecord> friction_columns(bool oil_flows = true);

}  // namespace tabor::analysis
