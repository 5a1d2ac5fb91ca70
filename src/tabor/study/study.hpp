#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tabor/analysis/settings.hpp"
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

/// Under what each contact is repeated: positions in the lists of a study.
struct Condition {
  std::size_t density = 0;
  std::size_t speed = 0;
};

/// Scans x pressures x densities x speeds and everything they share. A value; SI throughout.
struct Study {
  std::string title;
  std::filesystem::path file;  ///< the study file
  topography::Treatment treatment;
  analysis::CaseSettings settings;     ///< of every scan; its speed is each of sliding_speeds
  std::vector<double> sliding_speeds;  ///< [m/s]; empty unless the oil flows
  std::vector<Scan> scans;
  std::optional<Experiment> experiment;

  /// Whether the friction of the flowing oil is computed, at each of sliding_speeds.
  bool flows() const { return settings.fluid.flows(); }
  /// Scans times pressures times conditions.
  std::size_t n_cases() const {
    return scans.size() * settings.mean_pressures.size() * conditions().size();
  }
  /// Densities, and for each all speeds, in the order of the study.
  std::vector<Condition> conditions() const;
  double lubricant_density(const Condition& condition) const;                ///< [kg/m^2]
  analysis::FluidSettings fluid_settings(const Condition& condition) const;  ///< at its speed
};

/// Reads a study file. File names in it, which may be patterns ("before_*.x3p"), are relative to
/// its own folder. Throws InputError with file, line and key for anything unknown, missing, without
/// its unit or out of range, and for scans that are not there.
Study read_study(const std::filesystem::path& file);

/// Every setting in force, defaults included, as a study file that gives the same study again.
std::string to_toml(const Study& study);

}  // namespace tabor::study
