#include "tabor/cli/params_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "tabor/cli/table.hpp"
#include "tabor/results/parameter_tables.hpp"

namespace tabor::cli {

namespace {

using cases::ParametersRecord;
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

double largest_of(const std::vector<ParametersRecord>& scans, const std::string& symbol) {
  double largest = 0;
  for (const ParametersRecord& scan : scans) {
    const Parameter* parameter = scan.find(symbol);
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

std::vector<std::string> paths_of(const std::vector<ParametersRecord>& scans) {
  std::vector<std::string> paths;
  paths.reserve(scans.size());
  for (const ParametersRecord& scan : scans) paths.push_back(scan.path);
  return paths;
}

std::vector<ParametersRecord> without_failures(const std::vector<ParametersRecord>& scans) {
  std::vector<ParametersRecord> good;
  std::copy_if(scans.begin(), scans.end(), std::back_inserter(good),
               [](const ParametersRecord& scan) { return scan.failure.empty(); });
  return good;
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

std::string comparison_table(const std::vector<cases::ParametersRecord>& scans) {
  const std::vector<ParametersRecord> good = without_failures(scans);
  std::vector<std::string> titles{"symbol", "unit"};
  for (const std::string& name : results::headings(paths_of(good))) titles.push_back(name);
  if (good.size() == 2) titles.emplace_back("change");
  Table table(titles);
  for (const Parameter* row : cases::distinct_parameters(good)) {
    const ReadableUnit unit = readable_unit(row->unit, largest_of(good, row->symbol));
    std::vector<std::string> cells{row->symbol, unit.name};
    for (const ParametersRecord& scan : good) {
      const Parameter* parameter = scan.find(row->symbol);
      cells.push_back(parameter ? value_in(unit, *parameter) : "-");
    }
    if (good.size() == 2) {
      const Parameter* first = good[0].find(row->symbol);
      const Parameter* second = good[1].find(row->symbol);
      cells.push_back(first && second ? change(*first, *second, unit) : "-");
    }
    table.row(cells);
  }
  return table.text();
}

std::string group_table(const cases::GroupParameters& group) {
  Table table({group.name, "unit", "mean", "standard deviation", "n"});
  for (const metrology::ParameterMean& one : group.means) {
    const ReadableUnit unit = readable_unit(one.unit, one.value.mean);
    table.row({one.symbol, unit.name, digits(one.value.mean * unit.factor),
               digits(one.value.standard_deviation * unit.factor), fmt::format("{}", one.value.n)});
  }
  return table.text();
}

}  // namespace tabor::cli
