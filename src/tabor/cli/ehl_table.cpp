#include "tabor/cli/ehl_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tabor/cli/grid_limit.hpp"
#include "tabor/core/text.hpp"

namespace tabor::cli {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::string text_of(double value, const EhlColumn& column) {
  return column.unit.empty() ? plain(value) : si(value, column.unit);
}

}  // namespace

double number_of(const io::Json& scalars, const std::string& key) {
  const io::Json* node = &scalars;
  for (const std::string& name : split(key, '.')) {
    node = node->find(name);
    if (!node) return kNone;
  }
  return node->is_number() ? node->get<double>() : kNone;
}

EhlColumns columns_of(const EhlProgram& program, const std::vector<EhlAnswer>& answers) {
  EhlColumns columns;
  for (const EhlColumn& column : program.columns) {
    const bool is_there = std::any_of(answers.begin(), answers.end(), [&](const EhlAnswer& answer) {
      return std::isfinite(number_of(answer.scalars, column.key));
    });
    if (is_there || !column.is_optional) columns.push_back(column);
  }
  return columns;
}

std::vector<std::string> headings_of(std::vector<std::string> first, const EhlColumns& columns) {
  for (const EhlColumn& column : columns) first.push_back(column.heading);
  return first;
}

std::vector<std::string> row_of(std::vector<std::string> first, const EhlColumns& columns,
                                const io::Json& scalars) {
  for (const EhlColumn& column : columns) {
    first.push_back(text_of(number_of(scalars, column.key), column));
  }
  return first;
}

void add_limits(const EhlColumns& columns, const EhlStudy& study, const std::vector<double>& values,
                const std::vector<EhlAnswer>& answers, Table& table, io::Json& object) {
  std::vector<double> spacing(values);
  if (study.is_count) {
    for (double& value : spacing) value = 1 / (value - study.end_nodes);
  }
  io::Json limits = io::Json::object();
  io::Json orders = io::Json::object();
  std::vector<std::string> limit_row = {"limit"};
  std::vector<std::string> order_row = {"order"};
  for (const EhlColumn& column : columns) {
    std::vector<double> numbers;
    numbers.reserve(answers.size());
    for (const EhlAnswer& answer : answers) {
      numbers.push_back(number_of(answer.scalars, column.key));
    }
    const GridLimit limit = column.has_limit ? limit_of(spacing, numbers) : GridLimit{kNone, kNone};
    limit_row.push_back(text_of(limit.value, column));
    order_row.push_back(plain(limit.order, 2));
    limits[column.key] = io::number(limit.value);
    orders[column.key] = io::number(limit.order);
  }
  table.row(limit_row);
  table.row(order_row);
  object["limits"] = limits;
  object["orders"] = orders;
}

}  // namespace tabor::cli
