// Tells options, values and positional words apart; what a value means is the business of the
// Option that takes it.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>
#include <utility>

#include "tabor/cli/options.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"

namespace tabor::cli {

namespace {

/// Value of an option, in the order of the command line; "" for a switch.
struct Given {
  const Option* option;
  std::string value;
};

bool names_file_of(const Option& option, const std::string& word) {
  return std::any_of(option.extensions.begin(), option.extensions.end(),
                     [word = lower(word)](const auto& one) { return word.ends_with(one); });
}

/// True for a word that begins an option; "-1um" is a value.
bool is_option(const std::string& word) {
  if (word.size() < 2 || word[0] != '-') return false;
  return word[1] != '.' && std::isdigit(static_cast<unsigned char>(word[1])) == 0;
}

/// Sorts the words of one command line.
class WordSorter {
 public:
  WordSorter(const OptionSet& set, const std::string& verb, const std::vector<std::string>& words)
      : set_(set), verb_(verb), words_(words) {}

  std::vector<Given> sort() {
    bool options_ended = false;
    for (next_ = 0; next_ < words_.size();) {
      const std::string& word = words_[next_++];
      if (!options_ended && word == "--") {
        options_ended = true;
      } else if (!options_ended && is_option(word)) {
        take_option(word);
      } else {
        take_positional(word);
      }
    }
    return std::move(given_);
  }

 private:
  [[noreturn]] void reject(const std::string& why) const {
    throw UsageError(fmt::format("{}; see 'tabor {} --help'", why, verb_));
  }

  void take_option(const std::string& word) {
    const std::size_t equals = word.find('=');
    const bool is_short = word[1] != '-';
    const std::string flag = is_short ? word.substr(0, 2) : word.substr(0, equals);
    const Option& option = find(flag, is_short ? word : flag);
    const bool has_value = is_short ? word.size() > 2 : equals != std::string::npos;
    if (option.is_switch()) {
      if (has_value) reject(fmt::format("{} takes no value", option.flag));
      given_.push_back({&option, ""});
    } else {
      given_.push_back(
          {&option, has_value ? word.substr(is_short ? 2 : equals + 1) : value_after(option)});
    }
  }

  const Option& find(const std::string& flag, const std::string& whole) const {
    for (const Option& option : set_.options()) {
      if (!option.is_positional() && option.is_called(flag)) return option;
    }
    std::vector<std::string> flags;
    for (const Option& option : set_.options()) {
      if (!option.is_positional()) flags.push_back(option.flag);
    }
    reject(fmt::format("unknown option '{}'{}", whole, suggestion(whole, flags)));
  }

  /// Takes the next word, unless an option may stand alone and it names no file of its kind.
  std::string value_after(const Option& option) {
    const bool has_word = next_ < words_.size() && !is_option(words_[next_]);
    if (!option.if_bare.empty()) {
      if (has_word && names_file_of(option, words_[next_])) return words_[next_++];
      if (has_word && !filled_.empty() && !std::filesystem::exists(words_[next_])) {
        throw InputError(
            option.flag, "'" + words_[next_] + "'",
            fmt::format("a name that ends in {}", fmt::join(option.extensions, " or ")), "");
      }
      return option.if_bare;
    }
    if (!has_word) reject(fmt::format("{}: {} is missing", option.flag, option.placeholder));
    return words_[next_++];
  }

  void take_positional(const std::string& word) {
    for (const Option& option : set_.options()) {
      if (!option.is_positional()) continue;
      if (!filled_.insert(&option).second && !option.repeatable) continue;
      given_.push_back({&option, word});
      return;
    }
    reject(fmt::format("unexpected word '{}'", word));
  }

  const OptionSet& set_;
  const std::string& verb_;
  const std::vector<std::string>& words_;
  std::size_t next_ = 0;
  std::vector<Given> given_;
  std::set<const Option*> filled_;  // positional ones that have a word
};

bool is_given(const std::string& flag, const std::vector<Given>& given) {
  return std::any_of(given.begin(), given.end(),
                     [&](const Given& one) { return one.option->flag == flag; });
}

void require_all(const std::vector<Given>& given, const OptionSet& set, const std::string& verb) {
  for (const Option& option : set.options()) {
    if (!option.required || is_given(option.flag, given) || is_given(option.unless, given)) {
      continue;
    }
    const std::string form =
        option.placeholder.empty() ? option.flag : option.flag + " " + option.placeholder;
    throw UsageError(fmt::format("{} is missing ({}){}; see 'tabor {} --help'", form, option.help,
                                 option.unless.empty() ? "" : "; or give " + option.unless, verb));
  }
}

void require_companions(const std::vector<Given>& given, const std::string& verb) {
  for (const auto& [option, value] : given) {
    if (option->only_with.empty() || is_given(option->only_with, given)) continue;
    throw UsageError(
        fmt::format("{} needs {}; see 'tabor {} --help'", option->flag, option->only_with, verb));
  }
}

void reject_repeated(const std::vector<Given>& given) {
  std::set<const Option*> seen;
  for (const Given& one : given) {
    if (!seen.insert(one.option).second && !one.option->repeatable) {
      throw UsageError(fmt::format("{} is given more than once", one.option->flag));
    }
  }
}

void assign(const Option& option, const std::string& value) {
  try {
    option.assign(value);
  } catch (const InputError& error) {
    throw UsageError(error.what());
  }
}

}  // namespace

void parse(const OptionSet& set, const std::string& verb, const std::vector<std::string>& words) {
  const std::vector<Given> given = WordSorter(set, verb, words).sort();
  require_all(given, set, verb);
  require_companions(given, verb);
  reject_repeated(given);
  for (const bool is_base : {true, false}) {
    for (const auto& [option, value] : given) {
      if (option->is_base == is_base) assign(*option, value);
    }
  }
}

}  // namespace tabor::cli
