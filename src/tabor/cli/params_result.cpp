#include "tabor/cli/params_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "tabor/cli/scan_groups.hpp"
#include "tabor/cli/table.hpp"
#include "tabor/io/columns.hpp"
#include "tabor/io/csv.hpp"

namespace tabor::cli {

namespace {

using metrology::Parameter;
using metrology::ParameterSet;

/// How a unit follows that of length: "µm²", "1/mm²", "µm³/µm²".
struct LengthUnit {
  const char* si;
  int power;
  const char* before;
  const char* after;
};

constexpr std::array kLengthUnits{LengthUnit{"m", 1, "", ""}, LengthUnit{"m^2", 2, "", "²"},
                                  LengthUnit{"m^3", 3, "", "³"}, LengthUnit{"1/m", -1, "1/", ""},
                                  LengthUnit{"1/m^2", -2, "1/", "²"}};
constexpr std::array kLengths{std::pair{1e-9, "nm"}, std::pair{1e-6, "µm"}, std::pair{1e-3, "mm"},
                              std::pair{1.0, "m"}};

ReadableUnit readable_length(const LengthUnit& unit, double largest) {
  // The smallest unit in which a density is at least one, the largest for a length.
  std::size_t chosen = unit.power > 0 ? 0 : kLengths.size() - 1;
  for (std::size_t i = 0; i < kLengths.size(); ++i) {
    const std::size_t k = unit.power > 0 ? i : kLengths.size() - 1 - i;
    if (std::abs(largest) * std::pow(kLengths[k].first, -unit.power) >= 1) chosen = k;
  }
  return {std::pow(kLengths[chosen].first, -unit.power),
          fmt::format("{}{}{}", unit.before, kLengths[chosen].second, unit.after)};
}

/// "442368", "3.3980", "-" for no value.
std::string digits(double value) {
  if (std::isnan(value)) return "-";
  if (value == std::floor(value) && std::abs(value) < 1e15) return fmt::format("{:.0f}", value);
  return fmt::format("{:.5g}", value);
}

bool is_bound(const Parameter& parameter) {
  return std::isnan(parameter.value) && parameter.note.starts_with("< ");
}

/// "< 0.062" of "< 0.062: why".
std::string bound_of(const Parameter& parameter) {
  return parameter.note.substr(0, parameter.note.find(':'));
}

std::string value_in(const ReadableUnit& unit, const Parameter& parameter) {
  if (is_bound(parameter)) return bound_of(parameter);
  return digits(parameter.value * unit.factor);
}

std::string value_of(const Parameter& parameter) {
  const ReadableUnit unit = readable_unit(parameter.unit, parameter.value);
  const std::string number = value_in(unit, parameter);
  return number == "-" || unit.name.empty() ? number : number + " " + unit.name;
}

std::string explanation(const Parameter& parameter) {
  if (parameter.note.empty()) return parameter.definition;
  // A bound stands in the column of the values already.
  const std::size_t start = is_bound(parameter) ? bound_of(parameter).size() + 2 : 0;
  const std::string note = parameter.note.substr(std::min(start, parameter.note.size()));
  return parameter.definition + " [" + note + "]";
}

const Parameter* find(const ScanParameters& scan, const std::string& symbol) {
  for (const Parameter& parameter : scan.parameters) {
    if (parameter.symbol == symbol) return &parameter;
  }
  return nullptr;
}

/// All parameters in the order in which they first appear.
std::vector<const Parameter*> rows_of(const std::vector<ScanParameters>& scans) {
  std::vector<const Parameter*> rows;
  std::set<std::string> known;
  for (const ScanParameters& scan : scans) {
    for (const Parameter& parameter : scan.parameters) {
      if (known.insert(parameter.symbol).second) rows.push_back(&parameter);
    }
  }
  return rows;
}

double largest_of(const std::vector<ScanParameters>& scans, const std::string& symbol) {
  double largest = 0;
  for (const ScanParameters& scan : scans) {
    const Parameter* parameter = find(scan, symbol);
    if (parameter && std::abs(parameter->value) > largest) largest = std::abs(parameter->value);
  }
  return largest;
}

std::string change(const Parameter& first, const Parameter& second, const ReadableUnit& unit) {
  const double a = first.value, b = second.value;
  if (std::isnan(a) || std::isnan(b)) return "-";
  const bool as_ratio = first.unit != "%" && first.unit != "deg" && a > 0 && b > 0;
  if (as_ratio) return fmt::format("x {:.4g}", b / a);
  return fmt::format("{:+.4g}", (b - a) * unit.factor);
}

std::vector<std::string> paths_of(const std::vector<ScanParameters>& scans) {
  std::vector<std::string> paths;
  for (const ScanParameters& scan : scans) paths.push_back(scan.path);
  return paths;
}

std::vector<ScanParameters> without_failures(const std::vector<ScanParameters>& scans) {
  std::vector<ScanParameters> good;
  std::copy_if(scans.begin(), scans.end(), std::back_inserter(good),
               [](const ScanParameters& scan) { return scan.failure.empty(); });
  return good;
}

/// A line of the table of groups.
struct GroupRow {
  std::string group;
  metrology::ParameterMean mean;
};

const Columns<GroupRow>& group_columns() {
  using metrology::ParameterMean;
  static const Columns<ParameterMean> mean{
      {"parameter", "", "", &ParameterMean::symbol},
      {"unit", "", "", &ParameterMean::unit},
      {"n", "", "", member_of(&ParameterMean::value, &Mean::n)},
      {"mean", "", "", member_of(&ParameterMean::value, &Mean::mean)},
      {"std", "", "", member_of(&ParameterMean::value, &Mean::standard_deviation)},
      {"sem", "", "", member_of(&ParameterMean::value, &Mean::standard_error)}};
  static const Columns<GroupRow> all =
      joined<GroupRow>({{"group", "", "", &GroupRow::group}}, within(mean, &GroupRow::mean));
  return all;
}

bool is_member(const GroupParameters& group, const ScanParameters& scan) {
  return std::find(group.scans.begin(), group.scans.end(), scan.path) != group.scans.end();
}

/// Those of any group.
std::vector<ScanParameters> scans_in(const std::vector<GroupParameters>& groups,
                                     const std::vector<ScanParameters>& scans) {
  std::vector<ScanParameters> members;
  std::copy_if(scans.begin(), scans.end(), std::back_inserter(members), [&](const auto& scan) {
    return std::any_of(groups.begin(), groups.end(),
                       [&](const auto& group) { return is_member(group, scan); });
  });
  return members;
}

/// The means, then what each scan of the group has.
std::vector<Cell> cells_of_row(const GroupParameters& group, const metrology::ParameterMean& mean,
                               const std::vector<ScanParameters>& scans) {
  std::vector<Cell> cells;
  for (const Column<GroupRow>& column : group_columns()) {
    cells.push_back(column.value({group.name, mean}));
  }
  for (const ScanParameters& scan : scans) {
    const Parameter* parameter = is_member(group, scan) ? find(scan, mean.symbol) : nullptr;
    cells.emplace_back(parameter ? parameter->value : std::numeric_limits<double>::quiet_NaN());
  }
  return cells;
}

}  // namespace

ReadableUnit readable_unit(const std::string& si_unit, double largest) {
  if (si_unit == "1" || si_unit.empty()) return {};
  if (si_unit == "deg") return {1, "°"};
  if (si_unit == "m^3/m^2") {
    const std::string length = readable_unit("m", largest).name;
    return {readable_unit("m", largest).factor, length + "³/" + length + "²"};
  }
  for (const LengthUnit& unit : kLengthUnits) {
    if (si_unit == unit.si) return readable_length(unit, largest);
  }
  return {1, si_unit};
}

std::string grouped_table(const std::vector<Parameter>& parameters) {
  std::string text;
  for (std::size_t begin = 0; begin < parameters.size();) {
    const ParameterSet set = parameters[begin].set;
    Table table({std::string(name_of(set)), "value", "definition"});
    std::size_t end = begin;
    for (; end < parameters.size() && parameters[end].set == set; ++end) {
      table.row({parameters[end].symbol, value_of(parameters[end]), explanation(parameters[end])});
    }
    text += (begin > 0 ? "\n" : "") + table.text();
    begin = end;
  }
  return text;
}

std::string comparison_table(const std::vector<ScanParameters>& scans) {
  const std::vector<ScanParameters> good = without_failures(scans);
  std::vector<std::string> titles{"symbol", "unit"};
  for (const std::string& name : headings(paths_of(good))) titles.push_back(name);
  if (good.size() == 2) titles.emplace_back("change");
  Table table(titles);
  for (const Parameter* row : rows_of(good)) {
    const ReadableUnit unit = readable_unit(row->unit, largest_of(good, row->symbol));
    std::vector<std::string> cells{row->symbol, unit.name};
    for (const ScanParameters& scan : good) {
      const Parameter* parameter = find(scan, row->symbol);
      cells.push_back(parameter ? value_in(unit, *parameter) : "-");
    }
    if (good.size() == 2) {
      const Parameter* first = find(good[0], row->symbol);
      const Parameter* second = find(good[1], row->symbol);
      cells.push_back(first && second ? change(*first, *second, unit) : "-");
    }
    table.row(cells);
  }
  return table.text();
}

std::string csv_table(const std::vector<ScanParameters>& scans) {
  const std::vector<const Parameter*> rows = rows_of(scans);
  std::vector<std::string> header{"scan", "treatment", "failure"};
  for (const Parameter* row : rows) header.push_back(row->symbol + " [" + row->unit + "]");
  std::string text = io::csv_line(header);
  for (const ScanParameters& scan : scans) {
    std::vector<std::string> cells{scan.path, scan.treatment, scan.failure};
    for (const Parameter* row : rows) {
      const Parameter* parameter = find(scan, row->symbol);
      cells.push_back(parameter ? io::csv_number(parameter->value) : "");
    }
    text += io::csv_line(cells);
  }
  return text;
}

std::string group_table(const GroupParameters& group) {
  Table table({group.name, "unit", "mean", "standard deviation", "n"});
  for (const metrology::ParameterMean& one : group.means) {
    const ReadableUnit unit = readable_unit(one.unit, one.value.mean);
    table.row({one.symbol, unit.name, digits(one.value.mean * unit.factor),
               digits(one.value.standard_deviation * unit.factor), fmt::format("{}", one.value.n)});
  }
  return table.text();
}

std::string csv_table(const std::vector<GroupParameters>& groups,
                      const std::vector<ScanParameters>& scans) {
  const std::vector<ScanParameters> shown = scans_in(groups, scans);
  std::vector<std::string> header;
  for (const Column<GroupRow>& column : group_columns()) header.push_back(column.key);
  for (const std::string& name : headings(paths_of(shown))) header.push_back(name);
  std::string text = io::csv_line(header);
  for (const GroupParameters& group : groups) {
    for (const metrology::ParameterMean& mean : group.means) {
      text += io::csv_line_of(cells_of_row(group, mean, shown));
    }
  }
  return text;
}

io::Json json_of(const GroupParameters& group) {
  io::Json parameters = io::Json::object();
  for (const metrology::ParameterMean& mean : group.means) {
    io::Json row = io::json_of(group_columns(), {group.name, mean});
    row.erase("group");
    row.erase("parameter");
    parameters[mean.symbol] = row;
  }
  return {{"group", group.name}, {"scans", group.scans}, {"parameters", parameters}};
}

io::Json json_of(const std::vector<Parameter>& parameters) {
  io::Json object = io::Json::object();
  for (const Parameter& parameter : parameters) {
    object[parameter.symbol] = {{"value", io::number(parameter.value)},
                                {"unit", parameter.unit},
                                {"definition", parameter.definition},
                                {"set", name_of(parameter.set)}};
    if (!parameter.note.empty()) object[parameter.symbol]["note"] = parameter.note;
  }
  return object;
}

}  // namespace tabor::cli
