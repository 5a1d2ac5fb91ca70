#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tabor/analysis/settings.hpp"
#include "tabor/core/names.hpp"
#include "tabor/scan/file.hpp"
#include "tabor/study/experiment.hpp"
#include "tabor/topography/treatment.hpp"

namespace tabor::study {

/// Whether contacts of a scan saturate.
enum class Deformation { elastic, saturated };
inline constexpr auto kDeformations = names<Deformation>("elastic", "saturated");

/// What a scan is computed under in place of what its study says; what is absent is the study's.
struct OwnSettings {
  std::optional<std::vector<double>> mean_pressures = {};       ///< [Pa]
  std::optional<std::vector<double>> lubricant_densities = {};  ///< [kg/m^2]
  std::optional<topography::Treatment> treatment = {};
  std::optional<Deformation> deformation = {};
  std::optional<deposition::Reading> reading = {};
};

/// One surface of a study. A file may stand in several groups, to compare settings.
struct Scan {
  std::filesystem::path file;  ///< where it is
  std::string label;           ///< how the study calls it: its path relative to the study file
  std::string group;           ///< averages are taken over the scans of a group
  scan::ReadOptions read;
  OwnSettings own = {};
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
  analysis::CaseSettings settings;  ///< of scans without their own; speed: each of sliding_speeds
  std::vector<double> sliding_speeds;  ///< [m/s]; empty unless the oil flows
  std::vector<Scan> scans;
  std::optional<Experiment> experiment;

  /// Whether the friction of the flowing oil is computed, at each of sliding_speeds.
  bool flows() const { return settings.fluid.flows(); }
  /// The study of this scan alone, whose own settings are those of that study.
  Study of(const Scan& scan) const;
  /// Pressures times conditions, of all scans.
  std::size_t n_cases() const;
  /// Densities, and for each all speeds, in the order of the study.
  std::vector<Condition> conditions() const;
  double lubricant_density(const Condition& condition) const;                ///< [kg/m^2]
  analysis::FluidSettings fluid_settings(const Condition& condition) const;  ///< at its speed
};

/// Reads a study file. File names in it, which may be patterns ("before_*.x3p"), are relative to
/// its own folder. Throws InputError with file, line and key for anything unknown, missing, without
/// its unit or out of range, and for scans that are not there.
Study read_study(const std::filesystem::path& file);

/// The same of a text, as if it stood in this file.
Study parse_study(const std::string& text, const std::filesystem::path& file);

/// A study file to start from, with every key there is; those that need not be are commented out.
std::string study_template();

/// All of them, dotted: "sweep.mean_pressure", "scan[].file".
const std::vector<std::string>& known_keys();

/// Every setting in force, defaults included, as a study file that gives the same study again.
std::string to_toml(const Study& study);

}  // namespace tabor::study
