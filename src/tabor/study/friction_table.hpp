#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tabor/forming/friction_table.hpp"

// Friction of a study, or of one scan, as a table for forming codes (docs/friction_tables.md).
namespace tabor::study {

/// What a result says of one scan under one condition.
struct FrictionNumber {
  std::string scan = {};
  std::string group = {};  ///< "" where there are none
  forming::Condition at = {};
  double friction_dry = 0;
  double friction = 0;  ///< with the oil: mixed where it flows, else lubricated
  bool converged = true;
  bool failed = false;                  ///< it has no numbers
  std::vector<std::string> codes = {};  ///< of its warnings
};

/// All that a result holds.
struct FrictionNumbers {
  std::vector<FrictionNumber> numbers;
  std::vector<std::string> origin;  ///< which file, made by which command and version
  std::filesystem::path file;       ///< that was read
};

/// Reads a folder of `tabor sweep` or its results.h5, or a file of `tabor friction -o`. Throws
/// InputError for what is no such result and for one without friction.
FrictionNumbers read_friction(const std::filesystem::path& results);

/// Which numbers a table is of.
struct FrictionTableChoice {
  std::optional<std::string> group = {};  ///< needed where the result has several
  /// [kg/m^2]; none: those of the result. 0 is dry friction, which every result has.
  std::vector<double> lubricant_densities = {};
  std::vector<std::string> kept_codes = {};  ///< warnings whose numbers stay in
};

/// Codes of warnings whose numbers cannot be trusted: not-converged, flood, frictionless,
/// implausible-friction, fluid-film. Of dry friction the first and the fourth count alone.
const std::vector<std::string>& untrusted_codes();

/// Means over the scans of a group. Scans that failed or did not converge do not count in a mean,
/// as in averages.csv; a number with any other untrusted warning is left out whole, as the mean
/// over the rest would be that of drier scans. Throws InputError for a group or a density that is
/// not there, for a code that is none of untrusted_codes(), and if nothing remains.
forming::FrictionTable friction_table(const FrictionNumbers& numbers,
                                      const FrictionTableChoice& choice = {});

}  // namespace tabor::study
