#include "tabor/cli/verb.hpp"

#include <algorithm>
#include <sstream>

#include "tabor/cli/verbs.hpp"

namespace tabor::cli {

void Context::warn(const std::string& text) {
  analysis::Finding of_no_number;
  of_no_number.text = text;
  warn(std::vector{of_no_number});
}

void Context::warn(const std::vector<analysis::Finding>& found) {
  for (const analysis::Finding& finding : found) {
    const auto says_the_same = [&, line = line_of(finding)](const analysis::Finding& said) {
      return line_of(said) == line;
    };
    if (std::none_of(warnings.begin(), warnings.end(), says_the_same)) warnings.push_back(finding);
  }
}

Observer Context::observer() const { return progress ? progress->observer() : Observer{}; }

const std::vector<Verb>& verbs() {
  static const std::vector<Verb> all = {
      info_verb(),     convert_verb(), params_verb(),    psd_verb(),      combine_verb(),
      generate_verb(), contact_verb(), lubricate_verb(), friction_verb(), sweep_verb(),
      ehl_verb(),      report_verb(),  table_verb(),     formats_verb(),  materials_verb(),
      cite_verb(),     options_verb()};
  return all;
}

void declare_common(OptionSet& set, Context& context) {
  set.group("Common options");
  set.toggle("--json", "print one JSON object and nothing else", context.json);
  set.toggle("--quiet", "show no progress", context.quiet);
  set.count("--threads", "threads to use [all cores]; results never depend on it", context.threads);
  static std::optional<std::string> nobody;  // defaults_for() looks for it before options are read
  set.text("--defaults", "FILE|none", "file of default options [tabor.toml here, if there is one]",
           nobody);
  set.count("--seed", "seed of everything random [1]", context.seed);
}

OptionSet options_of(const Verb& verb) {
  std::ostringstream nowhere;
  Context context{.out = nowhere, .err = nowhere};
  OptionSet set;
  verb.declare(set);
  declare_common(set, context);
  // The variables end here; without `assign` nobody can write to them.
  OptionSet described;
  for (Option option : set.options()) {
    option.assign = nullptr;
    described.group(option.group);
    described.add(option);
  }
  return described;
}

}  // namespace tabor::cli
