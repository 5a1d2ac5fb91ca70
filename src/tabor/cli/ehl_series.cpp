#include "tabor/cli/ehl_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "tabor/cli/fields_file.hpp"
#include "tabor/cli/grid_limit.hpp"
#include "tabor/cli/result.hpp"
#include "tabor/cli/table.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"

namespace tabor::cli {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

using Places = std::vector<std::size_t>;  ///< of a case's values on their axes

/// The number at a key, "wear.mean_depth_m" being that of an object inside; NaN if there is none.
double number_of(const io::Json& scalars, const std::string& key) {
  const io::Json* node = &scalars;
  for (const std::string& name : split(key, '.')) {
    const auto found = node->find(name);
    if (found == node->end()) return kNone;
    node = &*found;
  }
  return node->is_number() ? node->get<double>() : kNone;
}

std::string text_of(double value, const EhlColumn& column) {
  return column.unit.empty() ? plain(value) : si(value, column.unit);
}

/// The case with one combination of the swept values.
io::Config case_at(const io::Config& config, const std::vector<SweepAxis>& axes,
                   const Places& places) {
  io::Config changed = config;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    changed = changed.with(axes[i].key, axes[i].values[places[i]]);
  }
  return changed;
}

/// A case that makes no sense is a row like another.
EhlAnswer solve_or_refuse(const EhlProgram& program, const EhlSolver& solve,
                          const io::Config& config, Context& context) {
  config.reject_unknown(program.keys);
  try {
    return solve(config, context);
  } catch (const InputError& error) {
    return {.scalars = {{"refused", error.what()}, {"converged", false}},
            .text = "",
            .warnings = {std::string("refused: ") + error.what()}};
  }
}

/// The cases in the order in which each is the best start of the next: axes on which the program
/// goes downwards last, from their largest value.
std::vector<std::size_t> order_of(const EhlProgram& program, const std::vector<SweepAxis>& axes,
                                  const std::vector<Places>& all) {
  std::vector<double> others_first(all.size() * axes.size() * 2, 0);
  const std::size_t width = axes.size() * 2;
  for (std::size_t a = 0; a < axes.size(); ++a) {
    const std::vector<double> numbers = axes[a].numbers();
    const bool goes_down = std::find(program.downwards.begin(), program.downwards.end(),
                                     axes[a].key) != program.downwards.end();
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::size_t place = all[i][a];
      if (goes_down) {
        others_first[i * width + axes.size() + a] = -numbers[place];
      } else {
        others_first[i * width + a] = static_cast<double>(place);
      }
    }
  }
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) { return others_first.begin() + std::ptrdiff_t(i * width); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::lexicographical_compare(key(a), key(a + 1), key(b), key(b + 1));
  });
  return order;
}

std::vector<EhlAnswer> solve_all(const EhlSeries& series, const std::vector<SweepAxis>& axes,
                                 const std::vector<Places>& all, Context& context) {
  const EhlProgram& program = series.program;
  const EhlSolver solve = program.make_series_solver ? program.make_series_solver() : program.solve;
  std::vector<EhlAnswer> answers(all.size());
  double n_done = 0;
  for (const std::size_t i : order_of(program, axes, all)) {
    report_progress(context.observer(), "sweep", n_done++ / static_cast<double>(all.size()));
    answers[i] = solve_or_refuse(program, solve, case_at(series.config, axes, all[i]), context);
    answers[i].write = {};  // fields of many cases would fill the memory
  }
  return answers;
}

/// One line for the warnings of many cases; the JSON object has them all.
void warn_of_many(const std::vector<EhlAnswer>& answers, Context& context) {
  const auto n_doubtful =
      std::count_if(answers.begin(), answers.end(),
                    [](const EhlAnswer& answer) { return !answer.warnings.empty(); });
  if (n_doubtful == 0) return;
  context.warn(fmt::format("{} of {} cases come with warnings of their own; --json lists them",
                           n_doubtful, answers.size()));
}

bool all_converged(const std::vector<EhlAnswer>& answers) {
  return std::all_of(answers.begin(), answers.end(),
                     [](const EhlAnswer& answer) { return answer.converged; });
}

/// The swept values of a case, `set`, and what came of them.
io::Json result_of(io::Json set, const EhlAnswer& answer) {
  io::Json result = {{"set", std::move(set)}};
  result.update(answer.scalars);
  result["warnings"] = answer.warnings;
  return result;
}

using Columns = std::vector<EhlColumn>;

/// Those of the program that these cases have.
Columns columns_of(const EhlProgram& program, const std::vector<EhlAnswer>& answers) {
  Columns columns;
  for (const EhlColumn& column : program.columns) {
    const bool is_there = std::any_of(answers.begin(), answers.end(), [&](const EhlAnswer& answer) {
      return std::isfinite(number_of(answer.scalars, column.key));
    });
    if (is_there || !column.is_optional) columns.push_back(column);
  }
  return columns;
}

std::vector<std::string> headings_of(std::vector<std::string> first, const Columns& columns) {
  for (const EhlColumn& column : columns) first.push_back(column.heading);
  return first;
}

std::vector<std::string> row_of(std::vector<std::string> first, const Columns& columns,
                                const io::Json& scalars) {
  for (const EhlColumn& column : columns) {
    first.push_back(text_of(number_of(scalars, column.key), column));
  }
  return first;
}

/// Limits of all columns, and the order of the error that they show, as rows and JSON objects.
void add_limits(const Columns& columns, const EhlStudy& study, const std::vector<double>& values,
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

/// The study that a sweep amounts to: three values or more of what it varies.
const EhlStudy* study_of(const EhlProgram& program, const std::vector<SweepAxis>& axes) {
  if (axes.size() != 1 || axes.front().values.size() < 3) return nullptr;
  for (const EhlStudy& study : program.studies) {
    if (study.has_limit && study.key == axes.front().key) return &study;
  }
  return nullptr;
}

int finish_series(const EhlSeries& series, const Table& table, const io::Json& object,
                  const std::vector<EhlAnswer>& answers, Context& context) {
  const bool converged = all_converged(answers);
  warn_of_many(answers, context);
  io::Json whole = json_head(context);
  whole["case"] = series.file;
  whole.update(object);
  whole["converged"] = converged;
  return finish(context, whole, table.text(), converged ? kDone : kNotConverged);
}

/// Numbers of all cases of a sweep, one array per axis and column.
void write_sweep(const EhlSeries& series, const std::vector<SweepAxis>& axes,
                 const std::vector<EhlAnswer>& answers, const Context& context) {
  const EhlProgram& program = series.program;
  io::Hdf5Writer writer(*series.output);
  write_result_head(writer, context, series.config.to_text(), program.methods);
  writer.attribute("/", "kind", "ehl " + program.name + " sweep");
  writer.group("/sweep/axes");
  std::vector<std::string> keys;
  std::vector<std::int64_t> shape;
  for (const SweepAxis& axis : axes) {
    const std::string path = "/sweep/axes/" + axis.key;
    keys.push_back(axis.key);
    shape.push_back(static_cast<std::int64_t>(axis.values.size()));
    writer.write(path, axis.numbers());
    writer.describe(path, "SI", axis.key);
    if (axis.has_words()) writer.attribute(path, "words", axis.values);
  }
  writer.attribute("/sweep", "axes", keys);  // the last one fastest
  writer.write("/sweep/shape", shape);
  std::vector<double> values(answers.size());
  const auto write = [&](const std::string& name, const std::string& unit,
                         const std::string& heading) {
    writer.write("/sweep/" + name, values);
    writer.describe("/sweep/" + name, unit, heading);
  };
  for (const EhlColumn& column : columns_of(program, answers)) {
    for (std::size_t i = 0; i < answers.size(); ++i) {
      values[i] = number_of(answers[i].scalars, column.key);
    }
    write(column.key, column.unit, column.heading);
  }
  for (std::size_t i = 0; i < answers.size(); ++i) values[i] = answers[i].converged ? 1 : 0;
  write("converged", "", "converged");
  writer.commit();
}

const EhlStudy& find_study(const EhlProgram& program, const std::string& name) {
  std::vector<std::string> names;
  for (const EhlStudy& study : program.studies) {
    if (study.name == name) return study;
    names.push_back(study.name);
  }
  throw UsageError(fmt::format("--study '{}'{}; 'tabor ehl {}' knows {}", name,
                               suggestion(name, names), program.name,
                               names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

/// The value of a study's key at one of its factors; numbers of nodes make whole cells.
double value_at(const EhlStudy& study, double usual, double factor) {
  if (!study.is_count) return usual * factor;
  const double cells = (usual - study.end_nodes) * factor / study.cells_by;
  return study.end_nodes + study.cells_by * std::round(cells);
}

}  // namespace

int show_sweep(const EhlSeries& series, const std::vector<SweepAxis>& axes, Context& context) {
  const EhlProgram& program = series.program;
  const std::vector<Places> all = combinations(axes);
  const std::vector<EhlAnswer> answers = solve_all(series, axes, all, context);
  std::vector<std::string> headings;
  headings.reserve(axes.size());
  for (const SweepAxis& axis : axes) headings.push_back(axis.key);
  const Columns columns = columns_of(program, answers);
  headings = headings_of(headings, columns);
  headings.emplace_back("converged");
  Table table(headings);
  io::Json results = io::Json::array();
  for (std::size_t i = 0; i < all.size(); ++i) {
    io::Json set = io::Json::object();
    std::vector<std::string> cells;
    for (std::size_t a = 0; a < axes.size(); ++a) {
      cells.push_back(axes[a].values[all[i][a]]);
      set[axes[a].key] = cells.back();
    }
    cells = row_of(cells, columns, answers[i].scalars);
    cells.push_back(yes_no(answers[i].converged));
    table.row(cells);
    results.push_back(result_of(std::move(set), answers[i]));
  }
  if (series.output) write_sweep(series, axes, answers, context);
  io::Json object = {{"results", results}};
  if (const EhlStudy* study = study_of(program, axes)) {
    add_limits(columns, *study, axes.front().numbers(), answers, table, object);
  }
  return finish_series(series, table, object, answers, context);
}

int show_study(const EhlSeries& series, const std::string& name, Context& context) {
  const EhlProgram& program = series.program;
  const EhlStudy& study = find_study(program, name);
  series.config.reject_unknown(program.keys);
  // What the case does not say is what its solution says it took.
  const double usual = number_of(program.solve(series.config, context).scalars, study.scalar);
  if (!std::isfinite(usual)) {
    throw InputError("--study " + study.name, "a case that has no " + study.key, "", "");
  }
  io::Json results = io::Json::array();
  std::vector<double> values;
  std::vector<std::string> texts;
  std::vector<EhlAnswer> answers;
  for (const double factor : study.factors) {
    values.push_back(value_at(study, usual, factor));
    texts.push_back(
        fmt::format("{:.12g}{}", values.back(), study.unit.empty() ? "" : " " + study.unit));
    answers.push_back(program.solve(series.config.with(study.key, texts.back()), context));
    answers.back().write = {};
    results.push_back(result_of({{study.key, texts.back()}}, answers.back()));
  }
  const Columns columns = columns_of(program, answers);
  Table table(headings_of({study.key}, columns));
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const std::string value = study.unit.empty() ? texts[i] : si(values[i], study.unit);
    table.row(row_of({value}, columns, answers[i].scalars));
  }
  io::Json object = {{"study", study.name}, {"results", results}};
  if (study.has_limit) add_limits(columns, study, values, answers, table, object);
  return finish_series(series, table, object, answers, context);
}

}  // namespace tabor::cli
