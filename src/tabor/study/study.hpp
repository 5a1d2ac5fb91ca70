#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tabor/analysis/settings.hpp"
#include "tabor/contact/contact.hpp"
#include "tabor/deposition/deposition.hpp"
#include "tabor/friction/mixed_friction.hpp"
#include "tabor/material/solid.hpp"
#include "tabor/scan/file.hpp"
#include "tabor/study/experiment.hpp"
#include "tabor/topography/treatment.hpp"

namespace tabor::study {

/// One surface of a study.
struct Scan {
  std::filesystem::path file;  ///< where it is
  std::string label;           ///< how the study calls it: its path relative to the study file
  std::string group;           ///< averages are taken over the scans of a group
  scan::ReadOptions read;
};

/// How every contact of a study is solved.
struct ContactSettings {
  bool periodic = true;
  contact::Solver solver = contact::Solver::fast;
  double tolerance = 1e-6;
};

/// How every film of a study is laid down.
struct LubricantSettings {
  double oil_density = 900;  ///< [kg/m^3]
  deposition::Model model = deposition::Model::droplets;
  deposition::Reading reading = deposition::Reading::conserving;
  deposition::Edge edge = deposition::Edge::closed;
  double droplet_height = 1e-7;  ///< [m]
  std::uint64_t seed = 1;
  std::optional<friction::FlowingOil> flowing;  ///< absent: oil only keeps contact from rubbing
};

/// Under what each contact is repeated: positions in the lists of a study.
struct Condition {
  std::size_t density = 0;
  std::size_t speed = 0;
};

/// Scans x pressures x densities x speeds and everything they share. A value; SI throughout.
struct Study {
  std::string title;
  std::filesystem::path file;  ///< the study file
  double shear_strength = 0;   ///< tau_y [Pa]
  friction::Area area = friction::Area::corrected;
  material::Solid solid;
  std::optional<material::Solid> counter_solid;  ///< rigid if absent
  double saturation_pressure = contact::kNoSaturation;
  topography::Treatment treatment;
  ContactSettings contact;
  LubricantSettings lubricant;
  std::vector<double> mean_pressures;       ///< [Pa]
  std::vector<double> lubricant_densities;  ///< [kg/m^2]
  std::vector<double> sliding_speeds;       ///< [m/s]; empty unless the oil flows
  std::vector<Scan> scans;
  std::optional<Experiment> experiment;

  double effective_modulus() const;  ///< E* [Pa]
  bool flows() const { return lubricant.flowing.has_value(); }
  std::size_t n_cases() const { return scans.size() * mean_pressures.size() * conditions().size(); }
  /// Densities, and for each all speeds, in the order of the study.
  std::vector<Condition> conditions() const;

  /// What analysis is asked for; `condition` says how fast the oil flows.
  analysis::ContactSettings contact_settings() const;
  analysis::FilmSettings film_settings() const;
  analysis::FluidSettings fluid_settings(const Condition& condition) const;
};

/// Reads a study file. File names in it, which may be patterns ("before_*.x3p"), are relative to
/// its own folder. Throws InputError with file, line and key for anything unknown, missing, without
/// its unit or out of range, and for scans that are not there.
Study read_study(const std::filesystem::path& file);

/// Every setting in force, defaults included, as a study file that gives the same study again.
std::string to_toml(const Study& study);

}  // namespace tabor::study
