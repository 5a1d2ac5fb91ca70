#include "tabor/study/density_curves.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "tabor/analysis/plateau.hpp"
#include "tabor/core/units.hpp"
#include "tabor/study/curves_file.hpp"

namespace tabor::study {
namespace {

/// The densities that all of these curves have: they are the same doses, and only end earlier on a
/// surface that drowns earlier.
std::vector<double> common_densities(const std::vector<const ScanCurve*>& curves) {
  const auto shorter = [](const ScanCurve* a, const ScanCurve* b) {
    return a->curve.lubricant_densities.size() < b->curve.lubricant_densities.size();
  };
  return (*std::min_element(curves.begin(), curves.end(), shorter))->curve.lubricant_densities;
}

/// At one density, over the scans.
Mean mean_at(const std::vector<const ScanCurve*>& curves, std::size_t density,
             std::vector<double> analysis::DensityCurve::*values) {
  std::vector<double> all;
  all.reserve(curves.size());
  for (const ScanCurve* one : curves) all.push_back((one->curve.*values)[density]);
  return mean_of(all);
}

std::vector<double> asked_of(const Study& study, const std::string& group) {
  std::set<double> asked;
  for (const Scan& scan : study.scans) {
    if (scan.group != group) continue;
    const Study alone = study.of(scan);
    const auto& densities = alone.settings.film.lubricant_densities;
    asked.insert(densities.begin(), densities.end());
  }
  return {asked.begin(), asked.end()};
}

GroupCurve average_of(const std::vector<const ScanCurve*>& curves) {
  GroupCurve average;
  average.group = curves.front()->group;
  average.n = curves.size();
  analysis::DensityCurve& mean = average.curve;
  mean.mean_pressure = curves.front()->curve.mean_pressure;
  mean.lubricant_densities = common_densities(curves);
  for (std::size_t i = 0; i < mean.lubricant_densities.size(); ++i) {
    using Curve = analysis::DensityCurve;
    average.lubricated_shares.push_back(mean_at(curves, i, &Curve::lubricated_shares));
    average.friction_lubricated.push_back(mean_at(curves, i, &Curve::friction_lubricated));
    mean.lubricated_shares.push_back(average.lubricated_shares.back().mean);
    mean.friction_lubricated.push_back(average.friction_lubricated.back().mean);
  }
  std::vector<double> dry;
  dry.reserve(curves.size());
  for (const ScanCurve* one : curves) dry.push_back(one->curve.friction_dry);
  mean.friction_dry = mean_of(dry).mean;
  mean.plateau = analysis::plateau_of(mean);
  return average;
}

double density_in_grams(const CurvePoint& point) { return in_g_per_m2(point.lubricant_density); }
double average_density_in_grams(const AveragePoint& point) {
  return in_g_per_m2(point.lubricant_density);
}

}  // namespace

std::vector<GroupCurve> average_curves(const Study& study, const std::vector<ScanCurve>& curves) {
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
    averages.back().asked = asked_of(study, group);
  }
  return averages;
}

std::string answer_of(const GroupCurve& curve) {
  const std::string at = "at " + format_si(curve.curve.mean_pressure, "Pa");
  return (curve.group.empty() ? at : curve.group + " " + at) + ": " +
         analysis::sentence_of(curve.curve, curve.asked);
}

std::vector<CurvePoint> points_of(const std::vector<ScanCurve>& curves) {
  std::vector<CurvePoint> points;
  for (const ScanCurve& one : curves) {
    const analysis::DensityCurve& curve = one.curve;
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

void write_curves(const std::vector<analysis::DensityCurve>& curves, const std::string& scan,
                  const std::vector<double>& asked, analysis::FieldsFile& file) {
  if (curves.empty()) return;
  std::vector<ScanCurve> of_scan;
  std::vector<std::string> answers;
  of_scan.reserve(curves.size());
  answers.reserve(curves.size());
  for (const analysis::DensityCurve& curve : curves) {
    of_scan.push_back({scan, "", curve});
    answers.push_back(answer_of({"", 1, curve, {}, {}, asked}));
  }
  file.add_table("/density_curves", curve_columns(), points_of(of_scan));
  file.add_answers(answers);
}

const Columns<CurvePoint>& curve_columns() {
  static const Columns<CurvePoint> all = {
      {"scan", "", "", &CurvePoint::scan},
      {"group", "", "", &CurvePoint::group},
      {"mean_pressure_Pa", "", "", &CurvePoint::mean_pressure},
      {"lubricant_density_g_per_m2", "", "", density_in_grams},
      {"lubricated_share", "", "", &CurvePoint::lubricated_share},
      {"friction_lubricated", "", "", &CurvePoint::friction_lubricated}};
  return all;
}

const Columns<AveragePoint>& average_curve_columns() {
  static const Columns<AveragePoint> all = [] {
    Columns<AveragePoint> columns = {
        {"group", "", "", &AveragePoint::group},
        {"mean_pressure_Pa", "", "", &AveragePoint::mean_pressure},
        {"lubricant_density_g_per_m2", "", "", average_density_in_grams},
        {"n", "", "", &AveragePoint::n}};
    add_mean("lubricated_share", &AveragePoint::lubricated_share, columns);
    add_mean("friction_lubricated", &AveragePoint::friction_lubricated, columns);
    return columns;
  }();
  return all;
}

}  // namespace tabor::study
