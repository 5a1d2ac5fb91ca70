#include "tabor/cli/ehl_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "tabor/cli/ehl_cases.hpp"
#include "tabor/cli/ehl_table.hpp"
#include "tabor/cli/ehl_warnings.hpp"
#include "tabor/cli/failure.hpp"
#include "tabor/cli/fields_file.hpp"
#include "tabor/cli/result.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"

namespace tabor::cli {

namespace {

using Places = std::vector<std::size_t>;  ///< of a case's values on their axes

/// Says once what the cases warn of; returns the marks of each.
std::vector<std::string> warn_of_many(const std::vector<EhlAnswer>& answers,
                                      const EhlCaseNames& names, Context& context) {
  EhlWarnings warnings = gather_warnings(answers, names);
  for (const std::string& line : warnings.lines) context.warn(line);
  return std::move(warnings.marks);
}

/// "roughness.kind / motion.speed", and for each case "lapped-like / 1 m/s".
EhlCaseNames names_of(const std::vector<SweepAxis>& axes, const std::vector<Places>& all) {
  EhlCaseNames names{.key = {}, .values = std::vector<std::string>(all.size())};
  for (std::size_t a = 0; a < axes.size(); ++a) {
    const std::string before = a > 0 ? " / " : "";
    names.key += before + axes[a].key;
    for (std::size_t i = 0; i < all.size(); ++i) {
      names.values[i] += before + axes[a].values[all[i][a]];
    }
  }
  return names;
}

/// Adds the marks of a case to its row, where any case has some.
void add_marks(const std::vector<std::string>& marks, std::size_t i,
               std::vector<std::string>& cells) {
  const bool has_any = std::any_of(marks.begin(), marks.end(),
                                   [](const std::string& mark) { return !mark.empty(); });
  if (has_any) cells.push_back(i < marks.size() ? marks[i] : "warnings");
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
  io::Json whole = json_head(context);
  whole["case"] = series.file;
  whole.update(object);
  whole["converged"] = converged;
  return finish(context, whole, table.text(), converged ? kDone : kNotConverged);
}

/// Numbers of all cases of a sweep, one array per axis and column.
void write_sweep(const EhlSeries& series, const std::vector<SweepAxis>& axes,
                 const std::vector<EhlAnswer>& answers, const std::vector<std::string>& marks,
                 const Context& context) {
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
    writer.describe(path, axis.unit(), axis.key);
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
  std::vector<std::string> warnings;
  warnings.reserve(answers.size());
  for (const EhlAnswer& answer : answers) {
    warnings.push_back(fmt::format("{}", fmt::join(answer.warnings, "\n")));
  }
  writer.write("/sweep/warnings", warnings);
  writer.write("/sweep/warning_marks", marks);
  write_warnings(writer, context);
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

int say_interrupted(const KeptCases& kept, std::size_t n_cases, Context& context) {
  return fail(context,
              fmt::format("interrupted; {} of {} cases are kept in {}; the same command continues",
                          kept.n_kept(), n_cases, kept.folder().string()),
              kInterrupted);
}

/// The table, or the JSON object.
int show_answers(const EhlSeries& series, const std::vector<SweepAxis>& axes,
                 const std::vector<Places>& all, const std::vector<EhlAnswer>& answers,
                 const std::vector<std::string>& marks, Context& context) {
  std::vector<std::string> headings;
  headings.reserve(axes.size());
  for (const SweepAxis& axis : axes) headings.push_back(axis.key);
  const EhlColumns columns = columns_of(series.program, answers);
  headings = headings_of(headings, columns);
  headings.emplace_back("converged");
  add_marks(marks, marks.size(), headings);
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
    add_marks(marks, i, cells);
    table.row(cells);
    results.push_back(result_of(std::move(set), answers[i]));
  }
  io::Json object = {{"results", results}};
  if (const EhlStudy* study = study_of(series.program, axes)) {
    add_limits(columns, *study, axes.front().numbers(), answers, table, object);
  }
  return finish_series(series, table, object, answers, context);
}

}  // namespace

int show_sweep(const EhlSeries& series, const std::vector<SweepAxis>& axes, Context& context) {
  const std::vector<Places> all = combinations(axes);
  const EhlCases cases(series, axes, all);
  const EhlCaseNames names = names_of(axes, all);
  if (!series.output) {
    const std::vector<EhlAnswer> answers = solve_cases(series, cases, nullptr, context);
    const std::vector<std::string> marks = warn_of_many(answers, names, context);
    return show_answers(series, axes, all, answers, marks, context);
  }
  KeptCases kept = kept_cases(series, cases, context);
  std::vector<EhlAnswer> answers;
  try {
    answers = solve_cases(series, cases, &kept, context);
  } catch (const Interrupted&) {
    if (kept.n_kept() == 0) throw;
    return say_interrupted(kept, all.size(), context);
  }
  const std::vector<std::string> marks = warn_of_many(answers, names, context);
  write_sweep(series, axes, answers, marks, context);
  kept.remove();
  return show_answers(series, axes, all, answers, marks, context);
}

int show_study(const EhlSeries& series, const std::string& name, Context& context) {
  const EhlProgram& program = series.program;
  const EhlStudy& study = find_study(program, name);
  reject_unknown_keys(program, series.config);
  // What the case does not say is what its solution says it took.
  const double usual =
      number_of(solve_one_of_many(program.solve, series.config, context).scalars, study.scalar);
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
    answers.push_back(
        solve_one_of_many(program.solve, series.config.with(study.key, texts.back()), context));
    results.push_back(result_of({{study.key, texts.back()}}, answers.back()));
  }
  const std::vector<std::string> marks =
      warn_of_many(answers, {.key = study.key, .values = texts}, context);
  const EhlColumns columns = columns_of(program, answers);
  std::vector<std::string> headings = headings_of({study.key}, columns);
  add_marks(marks, marks.size(), headings);
  Table table(headings);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const std::string value = study.unit.empty() ? texts[i] : si(values[i], study.unit);
    std::vector<std::string> cells = row_of({value}, columns, answers[i].scalars);
    add_marks(marks, i, cells);
    table.row(cells);
  }
  io::Json object = {{"study", study.name}, {"results", results}};
  if (study.has_limit) add_limits(columns, study, values, answers, table, object);
  return finish_series(series, table, object, answers, context);
}

}  // namespace tabor::cli
