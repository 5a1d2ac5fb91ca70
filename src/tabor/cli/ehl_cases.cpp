#include "tabor/cli/ehl_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <ostream>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/core/printable.hpp"

namespace tabor::cli {

namespace {

using Places = std::vector<std::size_t>;  ///< of a case's values on their axes

/// The case with one combination of the swept values.
io::Config case_at(const io::Config& config, const std::vector<SweepAxis>& axes,
                   const Places& places) {
  io::Config changed = config;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    changed = changed.with(axes[i].key, axes[i].values[places[i]]);
  }
  return changed;
}

EhlAnswer solve_or_reject(const EhlSolver& solve, const io::Config& config, Context& context) {
  try {
    return solve(config, context);
  } catch (const InputError& error) {
    return {.scalars = {{"refused", error.what()}, {"converged", false}},
            .text = "",
            .warnings = {std::string("rejected: ") + error.what()}};
  }
}

/// What of an answer stays until the end: maps of many cases would fill the memory.
KeptCase solve_to_keep(const EhlSolver& solve, const io::Config& config, Context& context) {
  const std::vector<std::string> before = std::exchange(context.warnings, {});
  KeptCase solved{.answer = solve_or_reject(solve, config, context), .notices = {}};
  solved.answer.text.clear();
  solved.answer.write = {};
  solved.notices = std::exchange(context.warnings, before);
  return solved;
}

EhlAnswer with_notices(KeptCase solved) {
  EhlAnswer& answer = solved.answer;
  answer.warnings.insert(answer.warnings.begin(), solved.notices.begin(), solved.notices.end());
  return std::move(answer);
}

void say(const std::string& text, Context& context) {
  if (context.progress) context.progress->clear();
  context.err << "tabor: " << printable(text) << '\n';
}

/// What the folder held, for whoever wonders why a sweep begins anew or does not.
void say_what_was_found(const KeptCases& kept, std::size_t n_cases, Context& context) {
  for (const std::string& complaint : kept.complaints()) {
    say(complaint + "; computed again", context);
  }
  if (context.quiet) return;
  if (kept.n_kept() > 0) {
    say(fmt::format("{} of {} cases were done, kept in {}", kept.n_kept(), n_cases,
                    kept.folder().string()),
        context);
  }
  if (kept.n_unused() > 0) {
    say(fmt::format("{} cases in {} are not used: of another case file, sweep or version",
                    kept.n_unused(), kept.folder().string()),
        context);
  }
}

/// A sweep of rows without a number says nothing but why.
void reject_if_none_makes_sense(const std::vector<EhlAnswer>& answers) {
  const auto is_rejected = [](const EhlAnswer& answer) {
    return answer.scalars.contains("refused");
  };
  if (!std::all_of(answers.begin(), answers.end(), is_rejected)) return;
  throw InputError(answers.front().scalars.at("refused").get<std::string>());
}

std::vector<std::optional<KeptCase>> take(KeptCases& kept, const EhlChain& chain,
                                          Context& context) {
  std::vector<std::optional<KeptCase>> found = kept.take(chain);
  say_what_was_found(kept, found.size(), context);
  return found;
}

}  // namespace

EhlCases::EhlCases(const EhlSeries& series, const std::vector<SweepAxis>& axes,
                   const std::vector<Places>& combinations)
    : order(solving_order(axes, combinations, series.program.downwards)) {
  configs.reserve(combinations.size());
  for (const Places& places : combinations) {
    configs.push_back(case_at(series.config, axes, places));
    reject_unknown_keys(series.program, configs.back());
  }
}

std::filesystem::path kept_folder(const EhlSeries& series) { return *series.output + ".cases"; }

KeptCases kept_cases(const EhlSeries& series, const EhlCases& cases, Context& context) {
  for (const io::Config& config : cases.configs) note_digests(series.program, config, context);
  std::vector<std::string> texts;
  texts.reserve(cases.order.size());
  const bool is_chain = series.program.make_chain != nullptr;
  for (const std::size_t i : cases.order) {
    const std::string before = is_chain && !texts.empty() ? texts.back() : "";
    texts.push_back(canonical_text(series.program, cases.configs[i], context, before));
  }
  return {kept_folder(series), std::move(texts)};
}

EhlAnswer solve_one_of_many(const EhlSolver& solve, const io::Config& config, Context& context) {
  EhlAnswer answer = with_notices(solve_to_keep(solve, config, context));
  reject_if_none_makes_sense({answer});
  return answer;
}

std::vector<EhlAnswer> solve_cases(const EhlSeries& series, const EhlCases& cases, KeptCases* kept,
                                   Context& context) {
  const EhlProgram& program = series.program;
  const EhlChain chain =
      program.make_chain ? program.make_chain() : EhlChain{.solve = program.solve};
  const std::size_t n_cases = cases.order.size();
  std::vector<std::optional<KeptCase>> found(n_cases);
  if (kept) found = take(*kept, chain, context);
  std::vector<EhlAnswer> answers(cases.configs.size());
  for (std::size_t place = 0; place < n_cases; ++place) {
    report_progress(context.observer(), "sweep",
                    static_cast<double>(place) / static_cast<double>(n_cases));
    const std::size_t i = cases.order[place];
    std::optional<KeptCase>& solved = found[place];
    if (!solved) {
      solved = solve_to_keep(chain.solve, cases.configs[i], context);
      if (kept) kept->keep(place, *solved, chain);
    }
    answers[i] = with_notices(std::move(*solved));
  }
  reject_if_none_makes_sense(answers);
  return answers;
}

}  // namespace tabor::cli
