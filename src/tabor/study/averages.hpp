#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tabor/analysis/records.hpp"
#include "tabor/core/column.hpp"
#include "tabor/core/mean.hpp"

namespace tabor::study {

struct Row;

using tabor::Mean;
using tabor::mean_of;

/// Means of what only a film that flows has.
struct FluidAverage {
  double sliding_speed = 0;  ///< [m/s]
  Mean load_share;
  Mean friction_viscous;
  Mean friction_mixed;
};

/// One row of averages.csv: the scans of one group under one pressure and density, and at one speed
/// where the oil flows.
struct Average {
  std::string group;
  double mean_pressure = 0;      ///< [Pa]
  double lubricant_density = 0;  ///< [kg/m^2]
  std::size_t n = 0;
  Mean friction_dry;
  Mean friction_lubricated;
  std::optional<FluidAverage> fluid;
};

/// Groups, pressures, densities and speeds in the order of their first row. Rows that failed or did
/// not converge do not count: n says how many did.
std::vector<Average> averages(const std::vector<Row>& rows);

/// Columns of what mean_columns() calls "_mean", "_std" and "_sem", behind a name.
const Columns<Mean>& mean_columns();
template <typename Record>
void add_mean(const std::string& name, Mean Record::*mean, Columns<Record>& columns) {
  for (Column<Record>& column : within(mean_columns(), mean)) {
    column.key = name + column.key;
    columns.push_back(column);
  }
}

/// Of averages.csv, results.h5 and JSON, with or without those of a film that flows.
Columns<Average> average_columns(bool oil_flows);

}  // namespace tabor::study
