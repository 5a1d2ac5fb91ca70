#pragma once

#include <string>
#include <vector>

#include "tabor/core/column.hpp"
#include "tabor/results/density_answer.hpp"
#include "tabor/study/averages.hpp"
#include "tabor/study/study.hpp"

// Averages curves of friction against the density of the lubricant over the scans of a study.
namespace tabor::study {

/// Curve of one scan under one pressure.
struct ScanCurve {
  std::string scan;
  std::string group;
  cases::DensityCurve curve;
};

/// Mean curve over the scans of one group under one pressure, at the densities that all of them
/// have.
struct GroupCurve {
  std::string group;
  std::size_t n = 0;                         ///< scans
  cases::DensityCurve curve;                 ///< means
  std::vector<Mean> lubricated_shares;       ///< one per density, with deviations
  std::vector<Mean> friction_lubricated;     ///< the same
  std::vector<results::AskedDensity> asked;  ///< of its scans, with the mean wet share of the rows
};
std::vector<GroupCurve> average_curves(const std::vector<ScanCurve>& curves,
                                       const std::vector<Row>& rows);

/// Returns the answer of a curve: "side A at 7 MPa: the pockets under the contacts are full from
/// ...".
std::string answer_of(const GroupCurve& curve);

/// Point of a curve: a row of a table.
struct CurvePoint {
  std::string scan;
  std::string group;
  double mean_pressure = 0;      ///< [Pa]
  double lubricant_density = 0;  ///< [kg/m^2]
  double lubricated_share = 0;
  double friction_lubricated = 0;
};
/// Point of a mean curve over the scans of a group: a row of a table.
struct AveragePoint {
  std::string group;
  double mean_pressure = 0;      ///< [Pa]
  double lubricant_density = 0;  ///< [kg/m^2]
  std::size_t n = 0;
  Mean lubricated_share;
  Mean friction_lubricated;
};
/// Position of one density of the study on the mean curve.
struct PlacePoint {
  std::string group;
  double mean_pressure = 0;      ///< [Pa]
  double lubricant_density = 0;  ///< [kg/m^2]
  double lubricated_share = 0;   ///< mean over the rows
  std::string place;  ///< "below", "plateau", "beyond", or empty for a curve without a plateau
};
std::vector<PlacePoint> places_of(const std::vector<GroupCurve>& curves);
std::vector<CurvePoint> points_of(const std::vector<ScanCurve>& curves);
std::vector<AveragePoint> points_of(const std::vector<GroupCurve>& curves);
const Columns<CurvePoint>& curve_columns();
const Columns<AveragePoint>& average_curve_columns();
const Columns<GroupCurve>& plateau_columns();  ///< NaN where there is none
const Columns<PlacePoint>& place_columns();

}  // namespace tabor::study
