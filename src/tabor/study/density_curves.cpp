#include "tabor/study/density_curves.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "tabor/core/units.hpp"
#include "tabor/study/curves_file.hpp"
#include "tabor/study/record.hpp"

namespace tabor::study {
namespace {

/// One density that several curves have, and its place in each.
struct CommonDensity {
  double lubricant_density = 0;  ///< [kg/m^2]
  std::vector<std::size_t> places;
};

std::optional<std::size_t> place_in(const std::vector<double>& densities, double density) {
  const auto at =
      std::lower_bound(densities.begin(), densities.end(), density, [](double one, double sought) {
        return one < sought && !cases::are_same_density(one, sought);
      });
  if (at == densities.end() || !cases::are_same_density(*at, density)) return std::nullopt;
  return static_cast<std::size_t>(at - densities.begin());
}

/// The densities that all of these curves have: the round ones, up to what drowns the first of the
/// surfaces, and what was asked of all.
std::vector<CommonDensity> common_densities(const std::vector<const ScanCurve*>& curves) {
  std::vector<CommonDensity> all;
  for (const double density : curves.front()->curve.lubricant_densities) {
    CommonDensity common{density, {}};
    for (const ScanCurve* one : curves) {
      const auto place = place_in(one->curve.lubricant_densities, density);
      if (place) common.places.push_back(*place);
    }
    if (common.places.size() == curves.size()) all.push_back(std::move(common));
  }
  return all;
}

/// At one density, over the scans.
Mean mean_at(const std::vector<const ScanCurve*>& curves, const CommonDensity& density,
             std::vector<double> cases::DensityCurve::*values) {
  std::vector<double> all;
  all.reserve(curves.size());
  for (std::size_t i = 0; i < curves.size(); ++i) {
    all.push_back((curves[i]->curve.*values)[density.places[i]]);
  }
  return mean_of(all);
}

/// The mean wet shares of the rows that averages() counts, by rising density.
std::vector<results::AskedDensity> asked_in(const std::vector<Row>& rows, const std::string& group,
                                            double mean_pressure) {
  std::map<double, std::vector<double>> shares;
  for (const Row& row : rows) {
    if (row.group != group || row.mean_pressure != mean_pressure || row.failed() ||
        !row.converged || !(row.lubricant_density > 0)) {
      continue;
    }
    shares[row.lubricant_density].push_back(row.lubricated_share);
  }
  std::vector<results::AskedDensity> asked;
  asked.reserve(shares.size());
  for (const auto& [density, of_rows] : shares) asked.push_back({density, mean_of(of_rows).mean});
  return asked;
}

GroupCurve average_of(const std::vector<const ScanCurve*>& curves) {
  using Curve = cases::DensityCurve;
  GroupCurve average;
  average.group = curves.front()->group;
  average.n = curves.size();
  cases::DensityCurve& mean = average.curve;
  mean.mean_pressure = curves.front()->curve.mean_pressure;
  for (const CommonDensity& density : common_densities(curves)) {
    mean.lubricant_densities.push_back(density.lubricant_density);
    average.lubricated_shares.push_back(mean_at(curves, density, &Curve::lubricated_shares));
    average.friction_lubricated.push_back(mean_at(curves, density, &Curve::friction_lubricated));
    mean.lubricated_shares.push_back(average.lubricated_shares.back().mean);
    mean.friction_lubricated.push_back(average.friction_lubricated.back().mean);
  }
  std::vector<double> dry;
  dry.reserve(curves.size());
  for (const ScanCurve* one : curves) dry.push_back(one->curve.friction_dry);
  mean.friction_dry = mean_of(dry).mean;
  mean.plateau = cases::plateau_of(mean);
  return average;
}

double density_in_grams(const CurvePoint& point) { return in_g_per_m2(point.lubricant_density); }
double average_density_in_grams(const AveragePoint& point) {
  return in_g_per_m2(point.lubricant_density);
}

double in_grams(std::optional<double> density) {
  return density ? in_g_per_m2(*density) : std::nan("");
}

using cases::Plateau;
double plateau_number(const GroupCurve& curve, double Plateau::*density) {
  const auto& plateau = curve.curve.plateau;
  return plateau ? in_g_per_m2((*plateau).*density) : std::nan("");
}

}  // namespace

std::vector<GroupCurve> average_curves(const std::vector<ScanCurve>& curves,
                                       const std::vector<Row>& rows) {
  std::vector<std::pair<std::string, double>> keys;  // group and pressure, each once
  for (const ScanCurve& one : curves) {
    const std::pair key(one.group, one.curve.mean_pressure);
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
  }
  std::vector<GroupCurve> averages;
  for (const auto& [group, pressure] : keys) {
    std::vector<const ScanCurve*> members;
    for (const ScanCurve& one : curves) {
      if (one.group == group && one.curve.mean_pressure == pressure) members.push_back(&one);
    }
    averages.push_back(average_of(members));
    averages.back().asked = asked_in(rows, group, pressure);
  }
  return averages;
}

std::string answer_of(const GroupCurve& curve) {
  const std::string at = "at " + format_si(curve.curve.mean_pressure, "Pa");
  return (curve.group.empty() ? at : curve.group + " " + at) + ": " +
         results::sentence_of(curve.curve, curve.asked);
}

std::vector<CurvePoint> points_of(const std::vector<ScanCurve>& curves) {
  std::vector<CurvePoint> points;
  for (const ScanCurve& one : curves) {
    const cases::DensityCurve& curve = one.curve;
    for (std::size_t i = 0; i < curve.lubricant_densities.size(); ++i) {
      points.push_back({one.scan, one.group, curve.mean_pressure, curve.lubricant_densities[i],
                        curve.lubricated_shares[i], curve.friction_lubricated[i]});
    }
  }
  return points;
}

std::vector<AveragePoint> points_of(const std::vector<GroupCurve>& curves) {
  std::vector<AveragePoint> points;
  for (const GroupCurve& one : curves) {
    for (std::size_t i = 0; i < one.curve.lubricant_densities.size(); ++i) {
      points.push_back({one.group, one.curve.mean_pressure, one.curve.lubricant_densities[i], one.n,
                        one.lubricated_shares[i], one.friction_lubricated[i]});
    }
  }
  return points;
}

std::vector<PlacePoint> places_of(const std::vector<GroupCurve>& curves) {
  std::vector<PlacePoint> points;
  for (const GroupCurve& one : curves) {
    for (const results::AskedDensity& asked : one.asked) {
      const auto place = results::place_of(one.curve, asked.lubricated_share);
      points.push_back({one.group, one.curve.mean_pressure, asked.lubricant_density,
                        asked.lubricated_share,
                        place ? std::string(results::kPlaces.of(*place)) : std::string()});
    }
  }
  return points;
}

void write_curves(const std::vector<cases::DensityCurve>& curves, const std::string& scan,
                  const std::vector<cases::FrictionRecord>& records, results::FieldsFile& file) {
  if (curves.empty()) return;
  std::vector<ScanCurve> of_scan;
  std::vector<GroupCurve> alone;
  std::vector<std::string> answers;
  of_scan.reserve(curves.size());
  alone.reserve(curves.size());
  answers.reserve(curves.size());
  for (const cases::DensityCurve& curve : curves) {
    of_scan.push_back({scan, "", curve});
    alone.push_back({"", 1, curve, {}, {}, results::asked_at(curve.mean_pressure, records)});
    answers.push_back(answer_of(alone.back()));
  }
  file.add_table("/density_curves", curve_columns(), points_of(of_scan));
  file.add_table("/density_plateaus", plateau_columns(), alone);
  file.add_table("/density_places", place_columns(), places_of(alone));
  file.add_answers(answers);
}

const Columns<CurvePoint>& curve_columns() {
  static const Columns<CurvePoint> all = {
      {"scan", "", "", &CurvePoint::scan},
      {"group", "", "", &CurvePoint::group},
      {"mean_pressure_Pa", "Pa", "", &CurvePoint::mean_pressure},
      {"lubricant_density_g_per_m2", "g/m²", "", density_in_grams},
      {"lubricated_share", "", "", &CurvePoint::lubricated_share},
      {"friction_lubricated", "", "", &CurvePoint::friction_lubricated}};
  return all;
}

const Columns<GroupCurve>& plateau_columns() {
  using results::beside_plateau;
  static const Columns<GroupCurve> all = {
      {"group", "", "", &GroupCurve::group},
      {"mean_pressure_Pa", "Pa", "", [](const GroupCurve& one) { return one.curve.mean_pressure; }},
      {"below_plateau_g_per_m2", "g/m²", "",
       [](const GroupCurve& one) { return in_grams(beside_plateau(one.curve).below); }},
      {"plateau_from_g_per_m2", "g/m²", "",
       [](const GroupCurve& one) { return plateau_number(one, &Plateau::first); }},
      {"plateau_to_g_per_m2", "g/m²", "",
       [](const GroupCurve& one) { return plateau_number(one, &Plateau::last); }},
      {"beyond_plateau_g_per_m2", "g/m²", "",
       [](const GroupCurve& one) { return in_grams(beside_plateau(one.curve).beyond); }},
      {"lubricated_share", "", "", [](const GroupCurve& one) {
         return one.curve.plateau ? 1 - one.curve.plateau->value : std::nan("");
       }}};
  return all;
}

const Columns<PlacePoint>& place_columns() {
  static const Columns<PlacePoint> all = {
      {"group", "", "", &PlacePoint::group},
      {"mean_pressure_Pa", "Pa", "", &PlacePoint::mean_pressure},
      {"lubricant_density_g_per_m2", "g/m²", "",
       [](const PlacePoint& point) { return in_g_per_m2(point.lubricant_density); }},
      {"lubricated_share", "", "", &PlacePoint::lubricated_share},
      {"place", "", "", &PlacePoint::place}};
  return all;
}

const Columns<AveragePoint>& average_curve_columns() {
  static const Columns<AveragePoint> all = [] {
    Columns<AveragePoint> columns = {
        {"group", "", "", &AveragePoint::group},
        {"mean_pressure_Pa", "Pa", "", &AveragePoint::mean_pressure},
        {"lubricant_density_g_per_m2", "g/m²", "", average_density_in_grams},
        {"n", "", "", &AveragePoint::n}};
    add_mean("lubricated_share", &AveragePoint::lubricated_share, columns);
    add_mean("friction_lubricated", &AveragePoint::friction_lubricated, columns);
    return columns;
  }();
  return all;
}

}  // namespace tabor::study
