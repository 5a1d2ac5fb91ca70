#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tabor/cases/settings.hpp"
#include "tabor/cases/slide/slide.hpp"
#include "tabor/core/names.hpp"
#include "tabor/scan/file.hpp"
#include "tabor/study/experiment.hpp"
#include "tabor/topography/treatment.hpp"

// Defines a study (scans x pressures x densities x speeds) and reads it from its TOML file.
namespace tabor::study {

/// Deformation of the contacts of a scan: elastic, or limited by the saturation pressure.
enum class Deformation { elastic, saturated };
inline constexpr auto kDeformations = names<Deformation>("elastic", "saturated");

/// Settings of a scan that override those of its study; absent ones are the study's.
struct OwnSettings {
  std::optional<std::vector<double>> mean_pressures = {};       ///< [Pa]
  std::optional<std::vector<double>> lubricant_densities = {};  ///< [kg/m^2]
  std::optional<topography::Treatment> treatment = {};
  std::optional<Deformation> deformation = {};
  std::optional<deposition::Reading> reading = {};
};

/// Surface of a study. A file may stand in several groups, to compare settings.
struct Scan {
  std::filesystem::path file;  ///< where it is
  std::string label;           ///< how the study calls it: its path relative to the study file
  std::string group;           ///< averages are taken over the scans of a group
  scan::ReadOptions read;
  OwnSettings own = {};
};

/// Density and speed under which a contact is repeated, as positions in the lists of a study.
struct Condition {
  std::size_t density = 0;
  std::size_t speed = 0;
};

/// Study: scans x pressures x densities x speeds and all that they share. A value; SI throughout.
struct Study {
  std::string title;
  std::filesystem::path file;  ///< the study file
  topography::Treatment treatment;
  std::optional<topography::Edges> edges =
      {};                        ///< of surfaces whose treatment says nothing of them
  cases::CaseSettings settings;  ///< of scans without their own; speed: each of sliding_speeds
  std::vector<double> sliding_speeds;         ///< [m/s]; empty unless the oil flows
  std::optional<cases::SlideSettings> slide;  ///< absent: nothing slides
  std::vector<Scan> scans;
  std::optional<Experiment> experiment;

  /// True where the friction of the flowing oil is computed, at each of sliding_speeds.
  bool flows() const { return settings.fluid.flows(); }
  /// Returns the study of this scan alone, whose settings are the scan's own.
  Study of(const Scan& scan) const;
  /// Returns the number of cases: pressures times conditions, of all scans.
  std::size_t n_cases() const;
  /// Returns the densities, and for each all speeds, in the order of the study.
  std::vector<Condition> conditions() const;
  double lubricant_density(const Condition& condition) const;             ///< [kg/m^2]
  cases::FluidSettings fluid_settings(const Condition& condition) const;  ///< at its speed
  /// Returns the settings of one slide: this pressure and density alone, without oil for none.
  cases::CaseSettings slide_settings(double mean_pressure, double lubricant_density) const;
};

/// Value that replaces that of a study file: "contact.tolerance", "1e-8".
struct Change {
  std::string key;
  std::string value;
};

/// Reads a study file, changed. File names in it, which may be patterns ("before_*.x3p"), are
/// relative to its own folder. Throws InputError with file, line and key for anything unknown,
/// missing, without its unit or out of range, and for scans that are not there.
Study read_study(const std::filesystem::path& file, const std::vector<Change>& changes = {});

/// Reads a study from a text, as if it stood in this file.
Study parse_study(const std::string& text, const std::filesystem::path& file);

/// Returns a study file to start from, with every key; optional keys are commented out.
std::string study_template();

/// Returns all keys, dotted: "sweep.mean_pressure", "scan[].file".
const std::vector<std::string>& known_keys();

/// Returns every setting in force, defaults included, as a study file that gives the same study
/// again.
std::string to_toml(const Study& study);

}  // namespace tabor::study
