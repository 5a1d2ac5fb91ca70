#include "tabor/results/parameter_tables.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <limits>
#include <set>

#include "tabor/io/columns.hpp"
#include "tabor/io/text/csv.hpp"

namespace tabor::results {

using cases::GroupParameters;
using cases::ParametersRecord;
using metrology::Parameter;

namespace {

/// Returns the scans that are in any group.
std::vector<ParametersRecord> scans_in(const std::vector<GroupParameters>& groups,
                                       const std::vector<ParametersRecord>& scans) {
  std::vector<ParametersRecord> members;
  std::copy_if(scans.begin(), scans.end(), std::back_inserter(members), [&](const auto& scan) {
    return std::any_of(groups.begin(), groups.end(),
                       [&](const auto& group) { return group.has(scan); });
  });
  return members;
}

/// The means, then what each scan of the group has.
std::vector<Cell> cells_of_row(const GroupParameters& group, const metrology::ParameterMean& mean,
                               const std::vector<ParametersRecord>& scans) {
  std::vector<Cell> cells;
  for (const auto& column : cases::group_parameter_columns()) {
    cells.push_back(column.value({group.name, mean}));
  }
  for (const ParametersRecord& scan : scans) {
    const Parameter* parameter = group.has(scan) ? scan.find(mean.symbol) : nullptr;
    cells.emplace_back(parameter ? parameter->value : std::numeric_limits<double>::quiet_NaN());
  }
  return cells;
}

}  // namespace

std::vector<std::string> headings(const std::vector<std::string>& files) {
  std::vector<std::string> names;
  std::set<std::string> known;
  for (const std::string& file : files) {
    names.push_back(std::filesystem::path(file).filename().string());
    known.insert(names.back());
  }
  return known.size() == names.size() ? names : files;
}

std::string csv_of(const std::vector<ParametersRecord>& scans) {
  const std::vector<const Parameter*> rows = cases::distinct_parameters(scans);
  std::vector<std::string> header{"scan", "treatment", "failure"};
  for (const Parameter* row : rows) header.push_back(row->symbol + " [" + row->unit + "]");
  std::string text = io::csv_line(header);
  for (const ParametersRecord& scan : scans) {
    std::vector<std::string> cells{scan.path, scan.treatment, scan.failure};
    for (const Parameter* row : rows) {
      const Parameter* parameter = scan.find(row->symbol);
      cells.push_back(parameter ? io::csv_number(parameter->value) : "");
    }
    text += io::csv_line(cells);
  }
  return text;
}

std::string csv_of(const std::vector<GroupParameters>& groups,
                   const std::vector<ParametersRecord>& scans) {
  if (groups.empty()) return csv_of(scans);
  const std::vector<ParametersRecord> shown = scans_in(groups, scans);
  std::vector<std::string> header, paths;
  for (const auto& column : cases::group_parameter_columns()) header.push_back(column.key);
  for (const ParametersRecord& scan : shown) paths.push_back(scan.path);
  for (const std::string& name : headings(paths)) header.push_back(name);
  std::string text = io::csv_line(header);
  for (const GroupParameters& group : groups) {
    for (const metrology::ParameterMean& mean : group.means) {
      text += io::csv_line_of(cells_of_row(group, mean, shown));
    }
  }
  return text;
}

io::Json json_of(const std::vector<Parameter>& parameters) {
  io::Json object = io::Json::object();
  for (const Parameter& parameter : parameters) {
    object[parameter.symbol] = io::json_of(cases::parameter_columns(), parameter);
  }
  return object;
}

io::Json json_of(const GroupParameters& group) {
  io::Json parameters = io::Json::object();
  for (const metrology::ParameterMean& mean : group.means) {
    io::Json row = io::json_of(cases::group_parameter_columns(), {group.name, mean});
    row.erase("group");
    row.erase("parameter");
    parameters[mean.symbol] = row;
  }
  return {{"group", group.name}, {"scans", group.scans}, {"parameters", parameters}};
}

}  // namespace tabor::results
