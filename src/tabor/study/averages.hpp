#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tabor/cases/records.hpp"
#include "tabor/core/column.hpp"
#include "tabor/core/mean.hpp"

// Averages the friction of a study over the scans of each group.
namespace tabor::study {

struct Row;

using tabor::Mean;
using tabor::mean_of;

/// Means of the numbers that only a flowing film has.
struct FluidAverage {
  double sliding_speed = 0;  ///< [m/s]
  Mean load_share;
  Mean friction_viscous;
  Mean friction_mixed;
};

/// Row of averages.csv: the scans of one group under one pressure and density, and at one speed
/// where the oil flows.
struct Average {
  std::string group;
  double mean_pressure = 0;      ///< [Pa]
  double lubricant_density = 0;  ///< [kg/m^2]
  std::size_t n = 0;
  Mean friction_dry;
  Mean friction_lubricated;
  std::optional<Mean> liquid_load_share;         ///< where oil is trapped
  std::optional<cases::ToolSpread> tool_spread;  ///< over the places of a tool, mean of the scans
  std::optional<FluidAverage> fluid;
  std::string
      left_out;  ///< why a friction table leaves it out (friction_table.hpp); "" if it does not
};

/// Averages the rows; groups, pressures, densities and speeds in the order of their first row. Rows
/// that failed or did not converge do not count: n is the number of those that do.
std::vector<Average> averages(const std::vector<Row>& rows);

/// Returns the columns "_mean", "_std" and "_sem"; add_mean() puts the name of a number before
/// them.
const Columns<Mean>& mean_columns();
template <typename Record, typename OfRecord>
void add_mean(const std::string& name, OfRecord Record::*mean, Columns<Record>& columns) {
  for (Column<Record>& column : within(mean_columns(), mean)) {
    column.key = name + column.key;
    columns.push_back(column);
  }
}

/// Returns the columns of averages.csv, results.h5 and JSON, with those of trapped oil, of the
/// places of a tool and of a flowing film where there are some.
Columns<Average> average_columns(const cases::FrictionParts& parts);

}  // namespace tabor::study
