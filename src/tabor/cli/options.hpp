#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tabor/core/units.hpp"

// Declares the options of a verb and assigns the words of a command line to its variables.
namespace tabor::cli {

/// Kind of file that the word of an option names.
enum class FileRole {
  none,
  input,   ///< is read, never replaced
  output,  ///< is written
  folder   ///< files are written into it
};

/// One option as declared by a verb: everything help, docs/options.md and the parser need.
struct Option {
  std::string flag;              ///< "--pressure", or "SCAN" for a positional argument
  std::string short_flag = {};   ///< "-o", mostly ""
  std::string also = {};         ///< "--poissons-ratio": understood too, and not listed
  std::string placeholder = {};  ///< "P[,P2,...]", "" for a switch
  std::string help = {};
  std::string group = {};               ///< heading in help; "": that of the option before
  std::vector<std::string> words = {};  ///< values to choose from, or samples of them
  bool required = false;
  std::string unless = {};     ///< "--material": neither required nor a default where this is given
  std::string only_with = {};  ///< "--lowpass-scan": means something only where this is given
  bool is_base = false;        ///< assigned before all others, which override it
  bool repeatable = false;
  FileRole names = FileRole::none;
  bool may_name_file = false;  ///< a word that names a file or something else, as of --tool
  std::string if_bare = {};    ///< value where no word with one of its extensions follows; "": none
  std::vector<std::string> extensions = {};             ///< of an output: ".h5"; empty: not checked
  std::function<void(const std::string&)> assign = {};  ///< throws InputError or UsageError

  bool is_positional() const { return flag.front() != '-'; }
  bool is_switch() const { return !is_positional() && placeholder.empty(); }
  bool is_path() const { return names != FileRole::none || may_name_file; }
  /// True for the flag, its short form and its other spelling.
  bool is_called(const std::string& word) const {
    return word == flag || (!word.empty() && (word == short_flag || word == also));
  }
};

/// The options of one verb. Every declaration binds a variable, whose value at that moment is the
/// default; parse() assigns the given values in the order of the command line.
class OptionSet {
 public:
  /// Sets the heading of the options declared from here on, up to one that has its own.
  void group(const std::string& title) { group_ = title; }

  Option& add(Option option);
  Option& positional(const std::string& name, const std::string& help, std::string& target);
  Option& positionals(const std::string& name, const std::string& help,
                      std::vector<std::string>& target);
  /// Declares a word that names a file to read.
  Option& input(const std::string& name, const std::string& help, std::string& target);
  /// Declares `-o`, `--output`: a file of one of these extensions; a folder if there are none.
  Option& output(const std::string& placeholder, const std::string& help,
                 const std::vector<std::string>& extensions, std::optional<std::string>& target);
  Option& toggle(const std::string& flag, const std::string& help, bool& target);
  Option& text(const std::string& flag, const std::string& placeholder, const std::string& help,
               std::optional<std::string>& target);
  Option& choice(const std::string& flag, const std::vector<std::string>& words,
                 const std::string& help, std::string& target);
  /// Declares an option whose values are the names of an enumeration (core/names.hpp).
  template <typename Names, typename Enum>
  Option& choice(const std::string& flag, const Names& names, const std::string& help,
                 Enum& target) {
    return choice(flag, names.all(), help,
                  [names, &target](const std::string& word) { target = *names.find(word); });
  }
  Option& choice(const std::string& flag, const std::vector<std::string>& words,
                 const std::string& help, const std::function<void(const std::string&)>& take);
  Option& count(const std::string& flag, const std::string& help, std::uint64_t& target);
  Option& count(const std::string& flag, const std::string& help,
                std::optional<std::uint64_t>& target);
  Option& number(const std::string& flag, const std::string& placeholder, const std::string& help,
                 double& target);
  Option& number(const std::string& flag, const std::string& placeholder, const std::string& help,
                 std::optional<double>& target);
  Option& quantity(const std::string& flag, const std::string& placeholder, const std::string& help,
                   Dimension dimension, double& target);
  Option& quantity(const std::string& flag, const std::string& placeholder, const std::string& help,
                   Dimension dimension, std::optional<double>& target);
  Option& quantities(const std::string& flag, const std::string& placeholder,
                     const std::string& help, Dimension dimension, std::vector<double>& target);

  const std::vector<Option>& options() const { return options_; }

 private:
  std::vector<Option> options_;
  std::string group_ = "Options";
};

/// Parse values of options. Throw UsageError for a word that is no finite number, no whole number
/// from 0, none of the choices.
double finite_number(const std::string& flag, const std::string& text);
std::uint64_t whole_number(const std::string& flag, const std::string& text);
std::string chosen_word(const std::string& flag, const std::string& word,
                        const std::vector<std::string>& choices);

/// Assigns the words of the command line. Throws UsageError: an unknown option (naming the nearest
/// match), a missing or surplus word, a value that is not what the option takes.
void parse(const OptionSet& set, const std::string& verb, const std::vector<std::string>& words);

}  // namespace tabor::cli
