#include "tabor/cli/defaults.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>

#include "tabor/cli/explain.hpp"
#include "tabor/cli/failure.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/io/text/toml.hpp"

namespace tabor::cli {

namespace {

using Words = std::vector<std::string>;

constexpr const char* kFlag = "--defaults";
constexpr const char* kFile = "tabor.toml";

/// False for options that say what one command reads, writes or prints.
bool may_have_default(const Option& option) {
  return !option.is_positional() && option.names == FileRole::none && option.flag != kFlag &&
         option.flag != "--json" && option.flag != kExplain && option.flag != kHelp &&
         option.flag != kVersionFlag;
}

/// "--shear-strength" as a key of the file.
std::string key_of(const std::string& flag) {
  std::string key = flag.substr(2);
  std::replace(key.begin(), key.end(), '-', '_');
  return key;
}

/// Every key that the file may have: of any verb, and of one in its table.
Words known_keys() {
  Words known;
  for (const Verb& verb : verbs()) {
    const OptionSet set = options_of(verb);
    for (const Option& option : set.options()) {
      if (!may_have_default(option)) continue;
      known.push_back(key_of(option.flag));
      known.push_back(verb.name + "." + key_of(option.flag));
    }
  }
  std::sort(known.begin(), known.end());
  known.erase(std::unique(known.begin(), known.end()), known.end());
  return known;
}

/// The value of an option among the words, if it is typed there.
std::optional<std::string> typed(const std::string& flag, const Words& words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == flag) return i + 1 < words.size() ? words[i + 1] : "";
    if (words[i].starts_with(flag + "=")) return words[i].substr(flag.size() + 1);
  }
  return std::nullopt;
}

std::string file_for(const Words& words) {
  if (const auto named = typed(kFlag, words)) return *named == "none" ? "" : *named;
  // A link that leads nowhere or to itself is a file that cannot be read: nothing is left out
  // quietly.
  std::error_code unknown;
  const std::filesystem::file_status name = std::filesystem::symlink_status(kFile, unknown);
  return std::filesystem::exists(name) ? kFile : "";
}

bool is_typed(const Option& option, const Words& words) {
  const auto is_there = [&](const std::string& flag) {
    return !flag.empty() && typed(flag, words).has_value();
  };
  return is_there(option.flag) || is_there(option.short_flag) || is_there(option.also);
}

bool is_typed(const std::string& flag, const std::vector<Option>& options, const Words& words) {
  return std::any_of(options.begin(), options.end(), [&](const Option& option) {
    return option.flag == flag && is_typed(option, words);
  });
}

/// True where the typed options allow a default of this option.
bool is_wanted(const Option& option, const std::vector<Option>& options, const Words& words) {
  if (is_typed(option, words) || is_typed(option.unless, options, words)) return false;
  return option.only_with.empty() || is_typed(option.only_with, options, words);
}

/// Values as they stand on a command line: a list in one word, of steps in several.
Words values_of(const io::Config& config, const std::string& key, const Option& option) {
  if (option.is_switch()) return config.flag(key) ? Words{""} : Words{};
  const Words all = config.words(key);
  return option.repeatable ? all : Words{fmt::format("{}", fmt::join(all, ","))};
}

/// The options of a verb, with variables of their own to try values on.
class Trial {
 public:
  explicit Trial(const Verb& verb) : action_(verb.declare(set_)) { declare_common(set_, context_); }

  const std::vector<Option>& options() const { return set_.options(); }

  /// Rejects what the option does not take, with the place in the file.
  static void take(const Option& option, const std::string& value, const std::string& place) {
    try {
      option.assign(value);
    } catch (const InputError& error) {
      throw InputError(place + ": " + error.what());
    } catch (const UsageError& error) {
      throw InputError(place + ": " + error.what());
    }
  }

 private:
  std::ostringstream nowhere_;
  Context context_{.out = nowhere_, .err = nowhere_};
  OptionSet set_;
  Action action_;  // holds the variables
};

/// Defaults for one verb. A key in the verb's own table overrides the same key at top level.
std::map<std::string, std::string> keys_for(const std::string& verb, const io::Config& config) {
  std::map<std::string, std::string> keys;  // by option
  for (const std::string& path : config.keys()) {
    if (path.find('.') == std::string::npos) keys.try_emplace(path, path);
    if (path.starts_with(verb + ".")) keys[path.substr(verb.size() + 1)] = path;
  }
  return keys;
}

void check_keys(const io::Config& config) {
  try {
    config.reject_unknown(known_keys());
  } catch (const InputError& error) {
    throw InputError(
        fmt::format("{}. Keys are the options of 'tabor options' without dashes, except those "
                    "that name files. {} none ignores the file",
                    error.what(), kFlag));
  }
}

}  // namespace

Words Defaults::words() const {
  Words all;
  all.reserve(used.size());
  for (const auto& [flag, value] : used) {
    all.push_back(value.empty() ? flag : fmt::format("{}={}", flag, value));
  }
  return all;
}

std::string Defaults::text() const { return fmt::format("{}", fmt::join(words(), " ")); }

Defaults defaults_for(const Verb& verb, const Words& words) {
  Defaults defaults{.file = file_for(words), .used = {}};
  if (defaults.file.empty()) return defaults;
  const io::Config config = io::Config::read(defaults.file);
  check_keys(config);
  const std::map<std::string, std::string> keys = keys_for(verb.name, config);
  const Trial trial(verb);
  for (const std::string& path : config.keys()) {  // steps act in the order of the file
    for (const Option& option : trial.options()) {
      if (!may_have_default(option) || !is_wanted(option, trial.options(), words)) continue;
      const auto key = keys.find(key_of(option.flag));
      if (key == keys.end() || key->second != path) continue;
      for (const std::string& value : values_of(config, path, option)) {
        Trial::take(option, value, config.place(path));
        defaults.used.emplace_back(option.flag, value);
      }
    }
  }
  return defaults;
}

}  // namespace tabor::cli
