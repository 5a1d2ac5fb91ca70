#include <algorithm>
#include <array>

#include "tabor/cases/states.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/mean.hpp"

namespace tabor::cases {
namespace {

constexpr std::array kAveraged{&FrictionRecord::contact_area_fraction,
                               &FrictionRecord::contact_area_fraction_pixels,
                               &FrictionRecord::saturated_area_fraction,
                               &FrictionRecord::mean_gap,
                               &FrictionRecord::separation,
                               &FrictionRecord::lubricated_share,
                               &FrictionRecord::spill_over_fraction,
                               &FrictionRecord::trapped_fraction,
                               &FrictionRecord::escaping_fraction,
                               &FrictionRecord::friction_area_fraction,
                               &FrictionRecord::friction_dry,
                               &FrictionRecord::friction_lubricated};

Mean mean_over(const std::vector<FrictionRecord>& records, double FrictionRecord::*value) {
  std::vector<double> values;
  values.reserve(records.size());
  for (const FrictionRecord& one : records) values.push_back(one.*value);
  return mean_of(values);
}

double deviation_over(const std::vector<FrictionRecord>& records, double FrictionRecord::*value) {
  return mean_over(records, value).standard_deviation;
}

/// The worst of all places counts.
void add_quality(const FrictionRecord& one, FrictionRecord& all) {
  all.certificate = std::max(all.certificate, one.certificate);
  all.contact_gap_error = std::max(all.contact_gap_error, one.contact_gap_error);
  all.converged = all.converged && one.converged;
  all.dry_at_bound = all.dry_at_bound && one.dry_at_bound;
  add(one.warnings, all.warnings);
}

}  // namespace

FrictionRecord mean_over_places(const std::vector<FrictionRecord>& records) {
  if (records.empty()) throw InputError("tool: no place to average over");
  FrictionRecord mean = records.front();
  if (records.size() == 1) return mean;
  for (const auto member : kAveraged) mean.*member = mean_over(records, member).mean;
  for (const FrictionRecord& one : records) add_quality(one, mean);
  mean.tool = ToolFriction{
      .n_places = records.size(),
      .spread = ToolSpread{deviation_over(records, &FrictionRecord::friction_area_fraction),
                           deviation_over(records, &FrictionRecord::friction_dry),
                           deviation_over(records, &FrictionRecord::friction_lubricated)}};
  return mean;
}

}  // namespace tabor::cases
