#pragma once

#include <string>
#include <vector>

#include "tabor/analysis/density_curve.hpp"
#include "tabor/core/column.hpp"
#include "tabor/study/averages.hpp"
#include "tabor/study/study.hpp"

// Friction against the areal density of the lubricant, of all scans of a study.
namespace tabor::study {

/// The curve of one scan under one pressure.
struct ScanCurve {
  std::string scan;
  std::string group;
  analysis::DensityCurve curve;
};

/// The mean over the scans of one group under one pressure, up to the density that all of them
/// reach.
struct GroupCurve {
  std::string group;
  std::size_t n = 0;                      ///< scans
  analysis::DensityCurve curve;           ///< means
  std::vector<Mean> lubricated_shares;    ///< one per density, with deviations
  std::vector<Mean> friction_lubricated;  ///< the same
  std::vector<double> asked;              ///< densities [kg/m^2] of its scans in the study
};
std::vector<GroupCurve> average_curves(const Study& study, const std::vector<ScanCurve>& curves);

/// "side A at 7 MPa: the pockets under the contacts are full from ...".
std::string answer_of(const GroupCurve& curve);

/// One point of a curve, and of a mean curve: a row of the tables.
struct CurvePoint {
  std::string scan;
  std::string group;
  double mean_pressure = 0;      ///< [Pa]
  double lubricant_density = 0;  ///< [kg/m^2]
  double lubricated_share = 0;
  double friction_lubricated = 0;
};
/// The same over the scans of a group.
struct AveragePoint {
  std::string group;
  double mean_pressure = 0;      ///< [Pa]
  double lubricant_density = 0;  ///< [kg/m^2]
  std::size_t n = 0;
  Mean lubricated_share;
  Mean friction_lubricated;
};
std::vector<CurvePoint> points_of(const std::vector<ScanCurve>& curves);
std::vector<AveragePoint> points_of(const std::vector<GroupCurve>& curves);
const Columns<CurvePoint>& curve_columns();
const Columns<AveragePoint>& average_curve_columns();

}  // namespace tabor::study
