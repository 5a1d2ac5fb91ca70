#pragma once

#include <string>
#include <vector>

#include "tabor/core/column.hpp"
#include "tabor/core/convergence.hpp"
#include "tabor/metrology/areal/parameter_means.hpp"
#include "tabor/metrology/areal/parameters.hpp"

// Measures the roughness parameters of a surface and averages those of several.
namespace tabor::cases {

/// Roughness parameters of one surface, or why it has none.
struct ParametersRecord {
  std::string path;                                   ///< of its scan
  std::string treatment;                              ///< the filter chain, "none" without
  Index valid_points = 0;                             ///< pixels with a height
  std::vector<metrology::Parameter> parameters = {};  ///< empty if the scan failed
  std::string failure = {};                           ///< why there are none

  /// Returns the parameter of a symbol; null if there is none.
  const metrology::Parameter* find(const std::string& symbol) const;
};

/// Measures a treated surface; throws as metrology::parameters(). The path is that of its source,
/// the treatment the steps of its history. Of a scan that mirror images continue, the scan alone is
/// measured.
ParametersRecord parameters_of(const topography::Topography& treated,
                               const metrology::ParameterOptions& options = {},
                               const Observer& observer = {});

/// Returns one parameter of each symbol, in the order in which they first appear.
std::vector<const metrology::Parameter*> distinct_parameters(
    const std::vector<ParametersRecord>& records);

/// Columns of one parameter: the value in SI units and what it means.
const Columns<metrology::Parameter>& parameter_columns();

/// Means over the surfaces of one group.
struct GroupParameters {
  std::string name;
  std::vector<std::string> scans;  ///< that were measured
  std::vector<metrology::ParameterMean> means;

  /// True for a record that the means count.
  bool has(const ParametersRecord& record) const;
};

/// Averages the parameters of a group; records without parameters do not count.
GroupParameters mean_of(const std::string& name,
                        const std::vector<const ParametersRecord*>& records);

/// One parameter of one group.
struct GroupParameter {
  std::string group;
  metrology::ParameterMean mean;
};
/// Columns of one mean: the group, the parameter, its unit and the statistics.
const Columns<GroupParameter>& group_parameter_columns();

}  // namespace tabor::cases
