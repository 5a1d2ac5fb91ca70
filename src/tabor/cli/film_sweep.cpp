#include "tabor/cli/film_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <ostream>

#include "tabor/cli/failure.hpp"
#include "tabor/cli/result.hpp"
#include "tabor/cli/table.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/printable.hpp"
#include "tabor/core/text.hpp"
#include "tabor/study/ehl_tables.hpp"

namespace tabor::cli {

namespace {

using Results = std::vector<ehl::CaseResult>;
using CaseColumns = std::vector<ehl::CaseColumn>;
using study::SweepAxis;

/// Says once what the cases warn of.
void warn_of_many(const study::EhlSweep& found, Context& context) {
  for (const std::string& line : found.warnings.lines) context.warn(line);
}

std::string number_text(double value, const ehl::CaseColumn& column) {
  return column.unit.empty() ? plain(value) : si(value, column.unit);
}

/// Numbers of many cases under the headings of their columns, what each warns of behind them.
class CaseTable {
 public:
  /// `first`: headings of what tells the cases apart; `last`: of what stands behind the numbers.
  CaseTable(std::vector<std::string> first, const CaseColumns& columns,
            const std::vector<std::string>& last, const std::vector<std::string>& marks)
      : columns_(columns), marks_(marks), table_(headings(std::move(first), last)) {}

  void add(std::vector<std::string> cells, const ehl::CaseResult& result,
           const std::vector<std::string>& last) {
    for (const ehl::CaseColumn& column : columns_) {
      cells.push_back(number_text(study::number_of(result.scalars, column.key), column));
    }
    cells.insert(cells.end(), last.begin(), last.end());
    if (has_marks()) cells.push_back(marks_[n_rows_]);
    ++n_rows_;
    table_.row(cells);
  }

  /// Two more rows, and two objects of JSON.
  void add_limits(const std::vector<numerics::GridLimit>& limits, io::Json& object) {
    std::vector<std::string> limit_row = {"limit"};
    std::vector<std::string> order_row = {"order"};
    io::Json limit_of = io::Json::object(), order_of = io::Json::object();
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      limit_row.push_back(number_text(limits[i].value, columns_[i]));
      order_row.push_back(plain(limits[i].order, 2));
      limit_of[columns_[i].key] = io::number(limits[i].value);
      order_of[columns_[i].key] = io::number(limits[i].order);
    }
    object.update({{"limits", limit_of}, {"orders", order_of}});
    table_.row(limit_row);
    table_.row(order_row);
  }

  std::string text() const { return table_.text(); }

 private:
  bool has_marks() const {
    return std::any_of(marks_.begin(), marks_.end(),
                       [](const std::string& mark) { return !mark.empty(); });
  }
  std::vector<std::string> headings(std::vector<std::string> first,
                                    const std::vector<std::string>& last) const {
    for (const ehl::CaseColumn& column : columns_) first.push_back(column.heading);
    first.insert(first.end(), last.begin(), last.end());
    if (has_marks()) first.emplace_back("warnings");
    return first;
  }

  const CaseColumns& columns_;
  const std::vector<std::string>& marks_;
  Table table_;
  std::size_t n_rows_ = 0;
};

bool all_converged(const Results& results) {
  return std::all_of(results.begin(), results.end(),
                     [](const ehl::CaseResult& result) { return result.converged; });
}

/// The swept values of a case, `set`, and what came of them.
io::Json result_of(io::Json set, const ehl::CaseResult& result) {
  io::Json object = {{"set", std::move(set)}};
  object.update(result.scalars);
  object["warnings"] = result.warnings;
  return object;
}

int finish_many(const FilmSweep& sweep, const study::EhlSweep& found, CaseTable& table,
                io::Json object, Context& context) {
  if (!found.limits.empty()) table.add_limits(found.limits, object);
  const bool converged = all_converged(found.results);
  io::Json whole = json_head(context);
  whole["case"] = sweep.file;
  whole.update(object);
  whole["converged"] = converged;
  const std::string csv = sweep.csv.is_asked() ? csv_of(found) : "";
  return finish(context, whole, write_csv(sweep.csv, csv, table.text()),
                converged ? kDone : kNotConverged);
}

/// The table, or the JSON object.
int show_results(const FilmSweep& sweep, const study::EhlSweep& found, Context& context) {
  std::vector<std::string> keys;
  for (const SweepAxis& axis : found.axes) keys.push_back(axis.key);
  CaseTable table(keys, found.columns, {"converged"}, found.warnings.marks);
  io::Json shown = io::Json::array();
  const std::vector<study::Places> all = combinations(found.axes);
  for (std::size_t i = 0; i < all.size(); ++i) {
    io::Json set = io::Json::object();
    std::vector<std::string> cells;
    for (std::size_t a = 0; a < keys.size(); ++a) {
      cells.push_back(found.axes[a].values[all[i][a]]);
      set[keys[a]] = cells.back();
    }
    table.add(cells, found.results[i], {yes_no(found.results[i].converged)});
    shown.push_back(result_of(std::move(set), found.results[i]));
  }
  return finish_many(sweep, found, table, {{"results", shown}}, context);
}

void say(const std::string& text, Context& context) {
  if (context.progress) context.progress->clear();
  context.err << "tabor: " << printable(text) << '\n';
}

/// What the folder held.
void say_what_was_found(const study::EhlFound& found, const std::string& folder, Context& context) {
  for (const std::string& complaint : found.damaged) {
    say(complaint.starts_with("damaged") ? complaint : complaint + "; computed again", context);
  }
  if (context.quiet) return;
  if (found.n_kept > 0) {
    say(fmt::format("{} of {} cases were done, kept in {}", found.n_kept, found.n_cases, folder),
        context);
  }
  if (found.n_unused > 0) {
    say(fmt::format("{} cases in {} are not used: of another case file, sweep or version",
                    found.n_unused, folder),
        context);
  }
}

/// What a shard has to say: the whole is shown by the run that has no shard.
int show_shard(const FilmSweep& sweep, const study::EhlOutcome& outcome, Context& context) {
  const std::size_t n_cases = outcome.results.size();
  const study::Shard shard = *sweep.run.shard;
  const bool converged =
      std::all_of(outcome.results.begin(), outcome.results.end(),
                  [](const auto& result) { return !result || result->converged; });
  io::Json object = json_head(context);
  object.update({{"case", sweep.file},
                 {"shard", fmt::format("{}/{}", shard.index, shard.count)},
                 {"kept", sweep.folder().string()},
                 {"n_cases", n_cases},
                 {"n_done", outcome.n_kept},
                 {"n_computed", outcome.n_computed},
                 {"converged", converged}});
  Facts facts;
  facts.fact("cases", fmt::format("{} of {} done, {} computed now", outcome.n_kept, n_cases,
                                  outcome.n_computed));
  facts.fact("kept in", sweep.folder().string());
  facts.fact("then", "the same command without --shard writes " + *sweep.output);
  return finish(context, object, facts.text(), converged ? kDone : kNotConverged);
}

/// Says how to go on, if there is anything to go on from.
int end_early(const FilmSweep& sweep, const study::EhlOutcome& outcome, Context& context) {
  try {
    std::rethrow_exception(outcome.ended_by);
  } catch (const Interrupted&) {
    if (outcome.n_kept == 0) throw;
    return fail(
        context,
        fmt::format("interrupted; {} of {} cases are kept in {}; the same command continues",
                    outcome.n_kept, outcome.results.size(), sweep.folder().string()),
        kInterrupted);
  }
}

}  // namespace

int show_sweep(const FilmSweep& sweep, study::EhlSeries& series, Context& context) {
  const study::RunOptions options = run_options(sweep.run, context);
  std::optional<study::EhlStore> store;
  if (sweep.output) {
    give_tasks(series, context.observer());
    store.emplace(sweep.folder(),
                  options.shard ? study::Store::Use::shared : study::Store::Use::alone);
  }
  const study::EhlOutcome outcome =
      run_ehl(series, store ? &*store : nullptr, options, [&](const study::EhlFound& found) {
        say_what_was_found(found, sweep.folder().string(), context);
      });
  if (outcome.ended_by) return end_early(sweep, outcome, context);
  if (options.shard) return show_shard(sweep, outcome, context);
  const study::EhlSweep found = sweep_of(sweep.program, sweep.axes, outcome.all());
  warn_of_many(found, context);
  if (store) {
    write_sweep(*sweep.output, head_of(context, sweep.config.to_text(), sweep.program.methods),
                found, context.warnings);
    store->finish();
  }
  return show_results(sweep, found, context);
}

int show_study(const FilmSweep& sweep, const std::string& name, Context& context) {
  const ehl::CaseStudy& study = study::find_study(sweep.program, name);
  study::EhlStudyOutcome outcome =
      run_ehl_study(sweep.program, sweep.config, study, context.seed_or_default(),
                    run_options(sweep.run, context));
  const study::EhlSweep found =
      study::sweep_of(sweep.program, {std::move(outcome.axis)}, std::move(outcome.results));
  warn_of_many(found, context);
  const SweepAxis& axis = found.axes.front();
  const std::vector<double> values = axis.numbers();
  CaseTable table({axis.key}, found.columns, {}, found.warnings.marks);
  io::Json shown = io::Json::array();
  for (std::size_t i = 0; i < values.size(); ++i) {
    table.add({study.unit.empty() ? axis.values[i] : si(values[i], study.unit)}, found.results[i],
              {});
    shown.push_back(result_of({{axis.key, axis.values[i]}}, found.results[i]));
  }
  return finish_many(sweep, found, table, {{"study", study.name}, {"results", shown}}, context);
}

}  // namespace tabor::cli
