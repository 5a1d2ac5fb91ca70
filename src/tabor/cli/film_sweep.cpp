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
#include "tabor/io/columns.hpp"
#include "tabor/study/ehl_tables.hpp"

namespace tabor::cli {

namespace {

using Results = std::vector<ehl::CaseResult>;
using ehl::CaseColumns;
using study::SweepAxis;

/// Numbers of many cases under the headings of their columns, what each warns of behind them.
class CaseTable {
 public:
  /// `first`: headings of what tells the cases apart; `last`: of what stands behind the numbers.
  CaseTable(std::vector<std::string> first, const study::EhlSweep& found,
            const std::vector<std::string>& last)
      : columns_(found.columns),
        has_codes_(!found.warnings.empty()),
        table_(headings(std::move(first), last)) {}

  void add(std::vector<std::string> cells, const ehl::CaseResult& result,
           const std::vector<std::string>& last) {
    for (const ColumnHead& column : columns_) {
      cells.push_back(text_of(result.number(column.key), column));
    }
    cells.insert(cells.end(), last.begin(), last.end());
    if (has_codes_) cells.push_back(results::codes_text(result.warnings));
    table_.row(cells);
  }

  /// Two more rows, and two objects of JSON.
  void add_limits(const std::vector<numerics::GridLimit>& limits, io::Json& object) {
    std::vector<std::string> limit_row = {"limit"};
    std::vector<std::string> order_row = {"order"};
    io::Json limit_of = io::Json::object(), order_of = io::Json::object();
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      limit_row.push_back(text_of(limits[i].value, columns_[i]));
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
  std::vector<std::string> headings(std::vector<std::string> first,
                                    const std::vector<std::string>& last) const {
    for (const ColumnHead& column : columns_) first.push_back(column.heading);
    first.insert(first.end(), last.begin(), last.end());
    if (has_codes_) first.emplace_back("warnings");
    return first;
  }

  const CaseColumns& columns_;
  bool has_codes_;
  Table table_;
};

bool all_converged(const Results& results) {
  return std::all_of(results.begin(), results.end(),
                     [](const ehl::CaseResult& result) { return result.converged(); });
}

/// The swept values of a case, `set`, and what came of them.
io::Json result_of(io::Json set, const ehl::CaseResult& result) {
  io::Json object = {{"set", std::move(set)}};
  object.update(io::json_of(result.numbers));
  if (result.rejected()) {
    object.update({{"converged", false},
                   {"status", ehl::kCaseStatus.of(result.status)},
                   {"error", result.error}});
  }
  object["warnings"] = texts_of(result.warnings);
  object["warning_codes"] = codes_of(result.warnings);
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
  CaseTable table(keys, found, {"converged"});
  io::Json shown = io::Json::array();
  const std::vector<study::Places> all = combinations(found.axes);
  for (std::size_t i = 0; i < all.size(); ++i) {
    io::Json set = io::Json::object();
    std::vector<std::string> cells;
    for (std::size_t a = 0; a < keys.size(); ++a) {
      cells.push_back(found.axes[a].values[all[i][a]]);
      set[keys[a]] = cells.back();
    }
    table.add(cells, found.results[i], {yes_no(found.results[i].converged())});
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
    say(fmt::format("{} of {} finished cases were found in {}", found.n_kept, found.n_cases,
                    folder),
        context);
  }
  if (found.n_unused > 0) {
    say(fmt::format("{} cases in {} belong to another case file, sweep or version and are not used",
                    found.n_unused, folder),
        context);
  }
}

/// What a shard has to say: the whole is shown by the run that has no shard.
int show_shard(const FilmSweep& sweep, const study::EhlOutcome& outcome, Context& context) {
  const std::size_t n_cases = outcome.results.size();
  const engine::Shard shard = *sweep.run.shard;
  const bool converged =
      std::all_of(outcome.results.begin(), outcome.results.end(),
                  [](const auto& result) { return !result || result->converged(); });
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
        fmt::format("interrupted; the same command continues with {} of {} finished cases in {}",
                    outcome.n_kept, outcome.results.size(), sweep.folder().string()),
        kInterrupted);
  }
}

}  // namespace

int show_sweep(const FilmSweep& sweep, study::EhlSeries& series, Context& context) {
  const engine::RunOptions options = run_options(sweep.run, context);
  std::optional<study::EhlStore> store;
  if (sweep.output) {
    give_tasks(series, context.observer());
    store.emplace(sweep.folder(),
                  options.shard ? engine::Store::Use::shared : engine::Store::Use::alone);
  }
  const study::EhlOutcome outcome =
      run_ehl(series, store ? &*store : nullptr, options, [&](const study::EhlFound& found) {
        say_what_was_found(found, sweep.folder().string(), context);
      });
  if (outcome.ended_by) return end_early(sweep, outcome, context);
  if (options.shard) return show_shard(sweep, outcome, context);
  const study::EhlSweep found = sweep_of(sweep.program, sweep.axes, outcome.all());
  context.warn(found.warnings);
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
      study::run_ehl_study(sweep.program, sweep.config, study, context.seed_or_default(),
                           run_options(sweep.run, context));
  const study::EhlSweep found =
      study::sweep_of(sweep.program, {std::move(outcome.axis)}, std::move(outcome.results));
  context.warn(found.warnings);
  const SweepAxis& axis = found.axes.front();
  const std::vector<double> values = axis.numbers();
  CaseTable table({axis.key}, found, {});
  io::Json shown = io::Json::array();
  for (std::size_t i = 0; i < values.size(); ++i) {
    table.add({study.unit.empty() ? axis.values[i] : si(values[i], study.unit)}, found.results[i],
              {});
    shown.push_back(result_of({{axis.key, axis.values[i]}}, found.results[i]));
  }
  return finish_many(sweep, found, table, {{"study", study.name}, {"results", shown}}, context);
}

}  // namespace tabor::cli
