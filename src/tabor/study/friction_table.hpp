#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tabor/forming/friction_table.hpp"

// Makes a friction table for forming codes from the result of a study or of one scan
// (docs/friction_tables.md).
namespace tabor::study {

/// Friction of one scan under one condition.
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

/// All friction numbers of a result.
struct FrictionNumbers {
  std::vector<FrictionNumber> numbers;
  std::vector<std::string> origin;  ///< which file, made by which command and version
  std::filesystem::path file;       ///< that was read
  std::string incomplete = {};      ///< says which part of its study is done; "" if all of it is
};

/// Reads a folder of `tabor sweep` or its results.h5, or a file of `tabor friction -o`. Throws
/// InputError for what is no such result and for one without friction.
FrictionNumbers read_friction(const std::filesystem::path& results);

/// Choice of the numbers of a table.
struct FrictionTableChoice {
  std::optional<std::string> group = {};  ///< needed where the result has several
  /// [kg/m^2]; none: those of the result. 0 is dry friction, which every result has.
  std::vector<double> lubricant_densities = {};
  std::vector<std::string> kept_codes = {};  ///< warnings whose numbers stay in
};

/// Returns the codes of warnings whose numbers cannot be trusted: not-converged, flood,
/// frictionless, implausible-friction, and those of a film that flows. For dry friction only the
/// first and the fourth count.
const std::vector<std::string>& untrusted_codes();

/// Heading of a column of refusal_of() in tables.
inline constexpr const char* kLeftOutHeading = "'tabor table' leaves out";

/// Returns why a friction table leaves out the friction of one state with these warnings: the
/// gravest reason, or "" if it includes it.
std::string refusal_of(const std::vector<std::string>& codes, bool converged);
/// Returns why a friction table leaves out the mean over the scans of a group under one condition.
std::string refusal_of(const std::vector<FrictionNumber>& numbers);

/// Makes the table of means over the scans of a group. Scans that failed or did not converge do not
/// count in a mean, as in averages.csv; a number with any other untrusted warning is left out
/// entirely, as the mean over the rest would be that of drier scans. Throws InputError for a group
/// or a density that does not exist, for a code that is none of untrusted_codes(), and if no number
/// remains.
forming::FrictionTable friction_table(const FrictionNumbers& numbers,
                                      const FrictionTableChoice& choice = {});

}  // namespace tabor::study
