#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

// Defines a table of friction coefficients over what a forming simulation knows at a contact: the
// mean pressure, the areal density of the lubricant and the sliding speed. docs/friction_tables.md
// explains it.
namespace tabor::forming {

/// Pressure, density and speed of a number; no speed where friction does not depend on it.
struct Condition {
  double mean_pressure = 0;                  ///< [Pa]
  double lubricant_density = 0;              ///< [kg/m^2]; 0: dry
  std::optional<double> sliding_speed = {};  ///< [m/s]

  bool operator==(const Condition&) const = default;
};

/// One friction coefficient: the mean over scans.
struct FrictionEntry {
  Condition at = {};
  double friction = 0;
  double standard_deviation = std::numeric_limits<double>::quiet_NaN();  ///< NaN for one scan
  std::size_t n = 1;                                                     ///< scans that count
};

/// Number that is not in the table, or scans that do not count in it.
struct LeftOut {
  Condition at = {};
  std::string code = {};  ///< why: a code of docs/warnings.md, "failed" or "incomplete"
  std::vector<std::string> scans = {};  ///< that it is about; none where there is one alone
  bool whole = true;  ///< false: the number is there, as the mean over other scans
};

/// Friction coefficients with what is left out and where they come from.
struct FrictionTable {
  std::vector<FrictionEntry> entries;  ///< by density, then pressure, then speed, all rising
  std::vector<LeftOut> left_out;       ///< in the same order
  std::string group;                   ///< of scans; "" where there are none
  std::vector<std::string> origin;     ///< lines for the head of a deck: command, files

  /// True where its numbers depend on the sliding speed.
  bool has_speeds() const { return !entries.empty() && entries.front().at.sliding_speed; }
};

/// Numbers under one pressure, speeds rising.
struct PressureRow {
  double mean_pressure = 0;  ///< [Pa]
  std::vector<FrictionEntry> entries;
};
/// Numbers at one density, pressures rising.
struct DensityLayer {
  double lubricant_density = 0;  ///< [kg/m^2]
  std::vector<PressureRow> rows;
};
/// Returns the same table in layers.
std::vector<DensityLayer> layers_of(const FrictionTable& table);

/// Returns the number of missing entries.
std::size_t n_left_out(const FrictionTable& table);

/// Returns "flood 2, not-converged 1", with how many numbers each reason took; "" if it took none.
std::string reasons_of(const FrictionTable& table);
/// Returns the same for the numbers that are there, as means over fewer scans.
std::string reasons_for_fewer_scans(const FrictionTable& table);

/// Removes pressures at which, for the same density, not all speeds are there: they move to
/// `left_out`, as "incomplete".
FrictionTable complete_rows(FrictionTable table);

/// Throw InputError unless there are two pressures or more at this density, or at each: one gives
/// no table over pressure. `left_out` says why others are not in it.
void require_two_pressures(const DensityLayer& layer, const std::string& left_out = "");
void require_two_pressures(const FrictionTable& table);

}  // namespace tabor::forming
