#include "tabor/cases/surface_parameters.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "tabor/topography/geometry.hpp"

namespace tabor::cases {

using metrology::Parameter;

const Parameter* ParametersRecord::find(const std::string& symbol) const {
  const auto found = std::find_if(parameters.begin(), parameters.end(),
                                  [&](const Parameter& one) { return one.symbol == symbol; });
  return found == parameters.end() ? nullptr : &*found;
}

ParametersRecord parameters_of(const topography::Topography& treated,
                               const metrology::ParameterOptions& options,
                               const Observer& observer) {
  const std::optional<topography::Topography> scan = topography::scan_of_images(treated);
  const topography::Topography& surface = scan ? *scan : treated;
  return {.path = surface.source,
          .treatment = surface.history.empty()
                           ? "none"
                           : fmt::format("{}", fmt::join(surface.history, ", ")),
          .valid_points = surface.grid.size() - topography::count_holes(surface),
          .parameters = metrology::parameters(surface, options, observer)};
}

std::vector<const Parameter*> distinct_parameters(const std::vector<ParametersRecord>& records) {
  std::vector<const Parameter*> all;
  std::set<std::string> known;
  for (const ParametersRecord& record : records) {
    for (const Parameter& parameter : record.parameters) {
      if (known.insert(parameter.symbol).second) all.push_back(&parameter);
    }
  }
  return all;
}

const Columns<Parameter>& parameter_columns() {
  static const Columns<Parameter> all{
      {"value", "", "", &Parameter::value},
      {"unit", "", "", &Parameter::unit},
      {"definition", "", "", &Parameter::definition},
      {"set", "", "", [](const Parameter& one) { return std::string(name_of(one.set)); }},
      {"note", "", "",
       [](const Parameter& one) { return one.note.empty() ? Cell() : Cell(one.note); }}};
  return all;
}

bool GroupParameters::has(const ParametersRecord& record) const {
  return std::find(scans.begin(), scans.end(), record.path) != scans.end();
}

GroupParameters mean_of(const std::string& name,
                        const std::vector<const ParametersRecord*>& records) {
  GroupParameters group{name, {}, {}};
  std::vector<std::vector<Parameter>> measured;
  for (const ParametersRecord* record : records) {
    if (!record->failure.empty()) continue;
    group.scans.push_back(record->path);
    measured.push_back(record->parameters);
  }
  group.means = metrology::parameter_means(measured);
  return group;
}

const Columns<GroupParameter>& group_parameter_columns() {
  using metrology::ParameterMean;
  static const Columns<ParameterMean> mean{
      {"parameter", "", "", &ParameterMean::symbol},
      {"unit", "", "", &ParameterMean::unit},
      {"n", "", "", member_of(&ParameterMean::value, &Mean::n)},
      {"mean", "", "", member_of(&ParameterMean::value, &Mean::mean)},
      {"std", "", "", member_of(&ParameterMean::value, &Mean::standard_deviation)},
      {"sem", "", "", member_of(&ParameterMean::value, &Mean::standard_error)}};
  static const Columns<GroupParameter> all = joined<GroupParameter>(
      {{"group", "", "", &GroupParameter::group}}, within(mean, &GroupParameter::mean));
  return all;
}

}  // namespace tabor::cases
