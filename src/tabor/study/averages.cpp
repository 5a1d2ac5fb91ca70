#include "tabor/study/averages.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "tabor/core/units.hpp"
#include "tabor/study/friction_table.hpp"
#include "tabor/study/record.hpp"

namespace tabor::study {
namespace {

constexpr double kAtRest = -1;  // stands for the speed of rows whose oil does not flow

using Key = std::tuple<std::string, double, double, double>;

double speed_of(const Row& row) { return row.fluid ? row.fluid->sliding_speed : kAtRest; }

Key key_of(const Row& row) {
  return {row.group, row.mean_pressure, row.lubricant_density, speed_of(row)};
}

/// The keys that occur: groups as they come first, in each rising pressure, then density, then
/// speed, whatever the order of the rows, as those of a shard leave some out.
std::vector<Key> ordered_keys(const std::vector<Row>& rows) {
  std::vector<std::string> groups;
  std::vector<std::pair<std::size_t, Key>> ranked;
  for (const Row& row : rows) {
    const auto found = std::find(groups.begin(), groups.end(), row.group);
    ranked.emplace_back(found - groups.begin(), key_of(row));
    if (found == groups.end()) groups.push_back(row.group);
  }
  std::sort(ranked.begin(), ranked.end());
  ranked.erase(std::unique(ranked.begin(), ranked.end()), ranked.end());
  std::vector<Key> keys;
  keys.reserve(ranked.size());
  for (const auto& [rank, key] : ranked) keys.push_back(key);
  return keys;
}

template <typename Value>
Mean mean_over(const std::vector<const Row*>& rows, const Value& value) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const Row* row : rows) values.push_back(value(*row));
  return mean_of(values);
}

template <typename Has>
bool all_have(const std::vector<const Row*>& rows, const Has& has) {
  return !rows.empty() &&
         std::all_of(rows.begin(), rows.end(), [&](const Row* row) { return has(*row); });
}

/// The spread over the places of a tool, mean of the scans; absent where one has none.
std::optional<cases::ToolSpread> mean_tool_spread(const std::vector<const Row*>& rows) {
  const auto has_spread = [](const Row& row) { return row.tool && row.tool->spread; };
  if (!all_have(rows, has_spread)) return std::nullopt;
  const auto mean_spread = [&](double cases::ToolSpread::*value) {
    return mean_over(rows, [=](const Row& row) { return *row.tool->spread.*value; }).mean;
  };
  return cases::ToolSpread{mean_spread(&cases::ToolSpread::area_fraction),
                           mean_spread(&cases::ToolSpread::friction_dry),
                           mean_spread(&cases::ToolSpread::friction_lubricated)};
}

/// What a friction table takes of a row.
FrictionNumber friction_number_of(const Row& row) {
  FrictionNumber number;
  number.scan = row.scan;
  number.group = row.group;
  number.at = {row.mean_pressure, row.lubricant_density, std::nullopt};
  number.friction_dry = row.friction_dry;
  number.friction = row.friction_lubricated;
  if (row.fluid) {
    number.at.sliding_speed = row.fluid->sliding_speed;
    number.friction = row.fluid->friction_mixed;
  }
  number.converged = row.converged;
  number.failed = row.failed();
  number.codes = codes_of(row.warnings);
  return number;
}

Average average_over(const Key& key, const std::vector<const Row*>& rows) {
  Average average;
  average.group = std::get<0>(key);
  average.mean_pressure = std::get<1>(key);
  average.lubricant_density = std::get<2>(key);
  average.n = rows.size();
  average.friction_dry = mean_over(rows, [](const Row& row) { return row.friction_dry; });
  average.friction_lubricated =
      mean_over(rows, [](const Row& row) { return row.friction_lubricated; });
  average.tool_spread = mean_tool_spread(rows);
  if (all_have(rows, [](const Row& row) { return row.trapped.has_value(); })) {
    average.liquid_load_share =
        mean_over(rows, [](const Row& row) { return row.trapped->load_share; });
  }
  if (std::get<3>(key) == kAtRest) return average;
  average.fluid.emplace();
  average.fluid->sliding_speed = std::get<3>(key);
  average.fluid->load_share = mean_over(rows, [](const Row& row) { return row.fluid->load_share; });
  average.fluid->friction_viscous =
      mean_over(rows, [](const Row& row) { return row.fluid->friction_viscous; });
  average.fluid->friction_mixed =
      mean_over(rows, [](const Row& row) { return row.fluid->friction_mixed; });
  return average;
}

}  // namespace

const Columns<Mean>& mean_columns() {
  static const Columns<Mean> columns{{"_mean", "", "", &Mean::mean},
                                     {"_std", "", "", &Mean::standard_deviation},
                                     {"_sem", "", "", &Mean::standard_error}};
  return columns;
}

std::vector<Average> averages(const std::vector<Row>& rows) {
  std::vector<Average> result;
  for (const Key& key : ordered_keys(rows)) {
    std::vector<const Row*> counted;
    std::vector<FrictionNumber> numbers;
    for (const Row& row : rows) {
      if (key_of(row) != key) continue;
      numbers.push_back(friction_number_of(row));
      if (!row.failed() && row.converged) counted.push_back(&row);
    }
    result.push_back(average_over(key, counted));
    result.back().left_out = refusal_of(numbers);
  }
  return result;
}

Columns<Average> average_columns(const cases::FrictionParts& parts) {
  Columns<Average> columns{
      {"group", "", "", &Average::group},
      {"mean_pressure_Pa", "Pa", "", &Average::mean_pressure},
      {"lubricant_density_g_per_m2", "g/m²", "",
       [](const Average& average) { return in_g_per_m2(average.lubricant_density); }},
      {"n", "", "", &Average::n}};
  add_mean("friction_dry", &Average::friction_dry, columns);
  add_mean("friction_lubricated", &Average::friction_lubricated, columns);
  if (parts.trapped) add_mean("liquid_load_share", &Average::liquid_load_share, columns);
  if (parts.tool) {
    const Columns<cases::ToolSpread> spread{
        {"friction_area_fraction_std_of_places", "", "", &cases::ToolSpread::area_fraction},
        {"friction_dry_std_of_places", "", "", &cases::ToolSpread::friction_dry},
        {"friction_lubricated_std_of_places", "", "", &cases::ToolSpread::friction_lubricated}};
    columns = joined(columns, within(spread, &Average::tool_spread));
  }
  if (parts.fluid) {
    Columns<FluidAverage> fluid{{"sliding_speed_m_per_s", "m/s", "", &FluidAverage::sliding_speed}};
    add_mean("fluid_load_share", &FluidAverage::load_share, fluid);
    add_mean("friction_viscous", &FluidAverage::friction_viscous, fluid);
    add_mean("friction_mixed", &FluidAverage::friction_mixed, fluid);
    columns = joined(columns, within(fluid, &Average::fluid));
  }
  columns.emplace_back("left_out", "", kLeftOutHeading, &Average::left_out);
  return columns;
}

}  // namespace tabor::study
