#pragma once

#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tabor/analysis/findings.hpp"
#include "tabor/cli/command_files.hpp"
#include "tabor/cli/options.hpp"
#include "tabor/cli/progress.hpp"

namespace tabor::cli {

/// What every verb is given besides its own options.
struct Context {
  std::ostream& out;
  std::ostream& err;
  std::string command_line = {};   ///< with the defaults that were used, for result files
  std::string defaults_file = {};  ///< "" without one
  std::vector<std::pair<std::string, std::string>> defaults = {};  ///< used of it: flag, value
  bool json = false;
  bool quiet = false;
  std::uint64_t threads = 0;  ///< 0 = all cores
  std::optional<std::uint64_t> seed = {};
  std::vector<analysis::Finding> warnings = {};  ///< those without a code belong to no number
  CommandFiles files = {};                       ///< that it reads and writes
  ProgressPrinter* progress = nullptr;

  /// Adds a warning once; it appears in the JSON object or on stderr.
  void warn(const std::string& text);
  /// The same for warnings of numbers; their JSON names code and cases.
  void warn(const std::vector<analysis::Finding>& found);
  Observer observer() const;
  std::uint64_t seed_or_default() const { return seed.value_or(1); }
};

/// Runs a verb whose options are parsed; returns its exit code.
using Action = std::function<int(Context&)>;

/// What help adds for a word of a verb: `tabor ehl impact --help`.
struct HelpTable {
  std::string word;  ///< "impact"
  std::string title;
  std::vector<std::string> headings;
  std::vector<std::vector<std::string>> rows;
};

/// One verb of the command line. declare() binds the options to variables owned by the Action it
/// returns, so a verb can be run any number of times.
struct Verb {
  std::string name;
  std::string arguments;              ///< "SCAN --pressure P [options]"
  std::string summary;                ///< one line
  std::string details = {};           ///< paragraphs below the summary, may be empty
  std::vector<std::string> examples;  ///< command lines that work in the project's folder
  std::function<Action(OptionSet&)> declare;
  std::function<std::vector<HelpTable>()> tables = {};
};

/// All verbs in the order people meet them.
const std::vector<Verb>& verbs();

/// Declares --json, --quiet, --threads and --seed, which every verb has.
void declare_common(OptionSet& set, Context& context);

/// The options of a verb, common ones included, for help and documentation.
OptionSet options_of(const Verb& verb);

}  // namespace tabor::cli
