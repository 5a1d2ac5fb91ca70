#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tabor/analysis/warning.hpp"
#include "tabor/contact/contact.hpp"
#include "tabor/io/hdf5.hpp"
#include "tabor/lubrication/deposition.hpp"
#include "tabor/study/store.hpp"
#include "tabor/topography/psd.hpp"
#include "tabor/topography/topography.hpp"

// What the store's files hold and how they are written and read back (docs/results.md). Writing
// throws OutputError; reading a damaged file throws InputError.
namespace tabor::study {

inline constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

/// What a row holds of a film that flows. Numbers are NaN in a row that failed.
struct FluidRow {
  double sliding_speed = 0;                 ///< [m/s]
  double load_share = kNoValue;             ///< of the load, that the oil carries
  double contact_area_fraction = kNoValue;  ///< while sliding
  double mean_gap = kNoValue;               ///< while sliding [m]
  double friction_solid = kNoValue;
  double friction_viscous = kNoValue;
  double friction_mixed = kNoValue;
  double load_error = kNoValue;
  double gap_error = kNoValue;
  double pressure_error = kNoValue;
  bool converged = false;  ///< film and load balance
};

/// Its numbers with their names in rows and tables.
inline constexpr std::pair<const char*, double FluidRow::*> kFluidColumns[] = {
    {"sliding_speed_m_per_s", &FluidRow::sliding_speed},
    {"fluid_load_share", &FluidRow::load_share},
    {"fluid_contact_area_fraction", &FluidRow::contact_area_fraction},
    {"fluid_mean_gap_m", &FluidRow::mean_gap},
    {"friction_solid", &FluidRow::friction_solid},
    {"friction_viscous", &FluidRow::friction_viscous},
    {"friction_mixed", &FluidRow::friction_mixed},
    {"fluid_load_error", &FluidRow::load_error},
    {"fluid_gap_error", &FluidRow::gap_error},
    {"fluid_pressure_error", &FluidRow::pressure_error}};

/// One row of results.csv. Numbers are NaN in a row that failed.
struct Row {
  std::string case_id;
  std::string scan;
  std::string group;
  double mean_pressure = 0;      ///< [Pa]
  double lubricant_density = 0;  ///< [kg/m^2]
  double contact_area_fraction = kNoValue;
  double contact_area_fraction_pixels = kNoValue;
  double saturated_area_fraction = kNoValue;
  double mean_gap = kNoValue;  ///< [m]
  double lubricated_share = kNoValue;
  double spill_over_fraction = kNoValue;
  double trapped_fraction = kNoValue;   ///< of the liquid, in closed pockets
  double escaping_fraction = kNoValue;  ///< of the liquid, with a way out through the gap
  double friction_dry = kNoValue;
  double friction_lubricated = kNoValue;
  double certificate = kNoValue;
  bool converged = false;         ///< contact, and film if it flows
  std::optional<FluidRow> fluid;  ///< absent where the oil does not flow
  analysis::Warnings warnings;    ///< of its surface, contact, film and friction
  std::string error;              ///< why there are no numbers; empty if there are

  bool failed() const { return !error.empty(); }
};

void write_row(const Store& store, const Unit& unit, const Row& row);
Row read_row(const Store& store, const Unit& unit);

/// Attributes of /films/nnnn and keys of `tabor lubricate --json` with their values; the same for
/// contacts and `tabor contact --json`.
using Scalars = std::vector<std::pair<std::string, double>>;
Scalars scalars_of(const lubrication::Film& film, double lubricant_density);
Scalars scalars_of(const contact::Summary& summary, const Convergence& convergence);

void write_surface(const Store& store, const Unit& unit, const topography::Topography& topography,
                   const topography::PowerSpectra& spectra);

/// What a stored surface says about itself, for readers that look at no map.
struct SurfaceFacts {
  Index nx = 0;
  Index ny = 0;
  double pixel_x = 0;  ///< [m]
  double pixel_y = 0;  ///< [m]
  double rms_height = 0;
  double rms_slope = 0;
  std::vector<std::string> treatment;
  std::vector<std::string> doubts;
};
SurfaceFacts read_surface_facts(const Store& store, const Unit& unit);

/// What a row needs of a stored contact.
struct StoredContact {
  Mask contact;  ///< true where the solids touch
  Field gap;     ///< [m]
  Grid grid;
  contact::Summary summary;
  Convergence convergence;
  analysis::Warnings warnings;  ///< of the surface and the contact
};
struct Cost {
  double fft_seconds = 0;
  double seconds = 0;
};
void write_contact(const Store& store, const Unit& unit, const Grid& grid,
                   const contact::Problem& problem, const contact::State& state,
                   const contact::Summary& summary, const Cost& cost,
                   const analysis::Warnings& warnings = {});
StoredContact read_contact(const Store& store, const Unit& unit);

/// Films arrive one after the other, in any order; commit() when all are there.
class FilmFile {
 public:
  FilmFile(const Store& store, const Unit& unit, const Grid& grid);
  void add(const lubrication::Film& film, double lubricant_density,
           const analysis::Warnings& warnings);
  void commit();

 private:
  Grid grid_;
  io::Hdf5Writer writer_;
};
Field read_film(const Store& store, const Unit& unit, std::size_t density);
analysis::Warnings read_film_warnings(const Store& store, const Unit& unit, std::size_t density);

/// One state whose oil flows: numbers, and maps for the report.
struct StoredFluid {
  friction::FluidSummary summary;
  std::vector<std::string> doubts;
};
void write_fluid(const Store& store, const Unit& unit, const Grid& grid,
                 const friction::FluidFilmState& state, const StoredFluid& stored,
                 const Scalars& conditions);
StoredFluid read_fluid(const Store& store, const Unit& unit);

/// Empty if the file in the store has all its bytes as they were written and belongs to the unit,
/// otherwise what is wrong with it.
std::string defect(const Store& store, const Unit& unit);

/// "/films/0003"
std::string film_group(std::size_t density);

/// What every HDF5 file of tabor says about itself.
void write_root(io::Hdf5Writer& writer, const std::string& default_group);

}  // namespace tabor::study
