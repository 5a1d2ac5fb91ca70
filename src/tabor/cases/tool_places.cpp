#include <algorithm>
#include <array>
#include <cmath>

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

constexpr std::array kAveragedOfTrapped{
    &TrappedFriction::load_share,       &TrappedFriction::max_pressure,
    &TrappedFriction::leaked_fraction,  &TrappedFriction::contact_area_fraction,
    &TrappedFriction::lubricated_share, &TrappedFriction::mean_gap,
    &TrappedFriction::friction_solid,   &TrappedFriction::friction_boundary};

constexpr std::array kCountsOfTrapped{&TrappedFriction::n_pockets, &TrappedFriction::n_squeezed,
                                      &TrappedFriction::n_at_seal};

template <typename Value>
Mean mean_of_each(const std::vector<FrictionRecord>& records, const Value& value) {
  std::vector<double> values;
  values.reserve(records.size());
  for (const FrictionRecord& one : records) values.push_back(static_cast<double>(value(one)));
  return mean_of(values);
}

Mean mean_over(const std::vector<FrictionRecord>& records, double FrictionRecord::*value) {
  return mean_of_each(records, [value](const FrictionRecord& one) { return one.*value; });
}

/// Counts are rounded.
TrappedFriction mean_of_trapped(const std::vector<FrictionRecord>& records) {
  TrappedFriction mean = *records.front().trapped;
  for (const auto member : kAveragedOfTrapped) {
    mean.*member = mean_of_each(records, [=](const FrictionRecord& one) {
                     return (*one.trapped).*member;
                   }).mean;
  }
  for (const auto member : kCountsOfTrapped) {
    mean.*member = std::llround(mean_of_each(records, [=](const FrictionRecord& one) {
                                  return (*one.trapped).*member;
                                }).mean);
  }
  for (const FrictionRecord& one : records) {
    mean.certificate = std::max(mean.certificate, one.trapped->certificate);
    mean.converged = mean.converged && one.trapped->converged;
  }
  return mean;
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
  if (mean.trapped) mean.trapped = mean_of_trapped(records);
  mean.tool = ToolFriction{
      .n_places = records.size(),
      .spread = ToolSpread{deviation_over(records, &FrictionRecord::friction_area_fraction),
                           deviation_over(records, &FrictionRecord::friction_dry),
                           deviation_over(records, &FrictionRecord::friction_lubricated)}};
  return mean;
}

}  // namespace tabor::cases
