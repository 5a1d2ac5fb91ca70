#pragma once

#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tabor/cli/command_files.hpp"
#include "tabor/cli/options.hpp"
#include "tabor/cli/progress.hpp"
#include "tabor/results/findings.hpp"

// Defines what a verb of the command line is, and the context that each verb works in.
namespace tabor::cli {

/// Context of a verb: what it gets besides its own options.
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
  std::vector<results::Finding> warnings = {};  ///< those without a code belong to no number
  AdviceSpelling spelling = {};                 ///< of the options that the verb has
  CommandFiles files = {};                      ///< that it reads and writes
  ProgressPrinter* progress = nullptr;

  /// Adds a warning once; it appears in the JSON object or on stderr, warnings before notes.
  void warn(const std::string& text);
  /// Adds warnings of numbers; their JSON has code and cases. Their advice is spelled as options of
  /// the verb.
  void warn(std::vector<results::Finding> found);
  /// Returns a finding as it appears on stderr, on one line of at most results::kLineWidth
  /// characters: "warning: ..." or, of information, "note: ...".
  static std::string line_of(const results::Finding& finding);
  /// Returns what an error says, with the settings that it names as options of the verb.
  std::string spelled(std::string_view message) const;
  /// True where a file of defaults gave this option.
  bool has_default(const std::string& flag) const;

  Observer observer() const;
  std::uint64_t seed_or_default() const { return seed.value_or(1); }
};

/// Options that end the program before a verb runs; they stand anywhere on the command line.
inline constexpr const char* kHelp = "--help";
inline constexpr const char* kHelpShort = "-h";
inline constexpr const char* kVersionFlag = "--version";
inline constexpr const char* kVersionShort = "-V";

/// Runs a verb whose options are parsed; returns its exit code.
using Action = std::function<int(Context&)>;

/// One key of a file that a verb reads.
struct HelpKey {
  std::string name;         ///< "ball.radius"
  std::string unit;         ///< "m", "" for plain numbers and words
  std::string when_absent;  ///< what holds where it is not given: "7 MPa", "required"
  std::string meaning;
};

/// Keys that the help of a verb lists for a word: `tabor ehl impact --help`.
struct HelpTable {
  std::string word;  ///< "impact"
  std::string title;
  std::vector<HelpKey> keys;
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

/// Returns all verbs in the order of the help.
const std::vector<Verb>& verbs();
std::vector<std::string> names_of_verbs();

/// Returns the verb of this name. Throws UsageError with the nearest name where there is none.
const Verb& find_verb(const std::string& name);

/// Declares --help, --version, --json, --quiet, --threads, --seed and others that every verb has.
void declare_common(OptionSet& set, Context& context);

/// Returns a spelling of advice by these options: "--level plane" for <level=plane>.
AdviceSpelling spelling_of(const OptionSet& set);

/// Returns the options of a verb, common ones included, for help and documentation.
OptionSet options_of(const Verb& verb);

}  // namespace tabor::cli
