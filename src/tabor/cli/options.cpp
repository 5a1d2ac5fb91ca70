#include "tabor/cli/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"

namespace tabor::cli {

double finite_number(const std::string& flag, const std::string& text) {
  const std::optional<double> value = parse_number(text);
  if (!value || !std::isfinite(*value)) {
    throw UsageError(fmt::format("{}: got '{}'; expected a plain number", flag, text));
  }
  return *value;
}

std::uint64_t whole_number(const std::string& flag, const std::string& text) {
  const double value = finite_number(flag, text);
  // Above 2^53 a double no longer holds every whole number.
  if (value < 0 || value != std::floor(value) || value > 9007199254740992.0) {
    throw UsageError(fmt::format("{}: got '{}'; expected a whole number from 0", flag, text));
  }
  return static_cast<std::uint64_t>(value);
}

std::string chosen_word(const std::string& flag, const std::string& word,
                        const std::vector<std::string>& choices) {
  if (std::find(choices.begin(), choices.end(), word) != choices.end()) return word;
  throw UsageError(fmt::format("{}: got '{}'; expected {}{}", flag, word, fmt::join(choices, ", "),
                               suggestion(word, choices)));
}

Option& OptionSet::add(Option option) {
  if (option.group.empty()) option.group = group_;
  group_ = option.group;
  return options_.emplace_back(std::move(option));
}

Option& OptionSet::positional(const std::string& name, const std::string& help,
                              std::string& target) {
  Option& option = add({.flag = name, .help = help, .assign = [&](auto& word) { target = word; }});
  option.required = true;
  return option;
}

Option& OptionSet::positionals(const std::string& name, const std::string& help,
                               std::vector<std::string>& target) {
  Option& option =
      add({.flag = name, .help = help, .assign = [&](auto& word) { target.push_back(word); }});
  option.required = true;
  option.repeatable = true;
  return option;
}

Option& OptionSet::input(const std::string& name, const std::string& help, std::string& target) {
  Option& option = positional(name, help, target);
  option.names = FileRole::input;
  return option;
}

Option& OptionSet::output(const std::string& placeholder, const std::string& help,
                          const std::vector<std::string>& extensions,
                          std::optional<std::string>& target) {
  Option& option = text("--output", placeholder, help, target);
  option.short_flag = "-o";
  option.names = extensions.empty() ? FileRole::folder : FileRole::output;
  option.extensions = extensions;
  return option;
}

Option& OptionSet::toggle(const std::string& flag, const std::string& help, bool& target) {
  return add({.flag = flag, .help = help, .assign = [&](auto&) { target = true; }});
}

Option& OptionSet::text(const std::string& flag, const std::string& placeholder,
                        const std::string& help, std::optional<std::string>& target) {
  return add({.flag = flag,
              .placeholder = placeholder,
              .help = help,
              .assign = [&target, flag, placeholder](const std::string& word) {
                if (word.empty()) {
                  throw UsageError(fmt::format("{}: got ''; expected {}", flag, placeholder));
                }
                target = word;
              }});
}

Option& OptionSet::choice(const std::string& flag, const std::vector<std::string>& words,
                          const std::string& help, std::string& target) {
  return choice(flag, words, help, [&target](const std::string& word) { target = word; });
}

Option& OptionSet::choice(const std::string& flag, const std::vector<std::string>& words,
                          const std::string& help,
                          const std::function<void(const std::string&)>& take) {
  const auto assign = [flag, words, take](const std::string& word) {
    take(chosen_word(flag, word, words));
  };
  return add({.flag = flag,
              .placeholder = fmt::format("{}", fmt::join(words, "|")),
              .help = help,
              .words = words,
              .assign = assign});
}

Option& OptionSet::count(const std::string& flag, const std::string& help, std::uint64_t& target) {
  return add(
      {.flag = flag, .placeholder = "N", .help = help, .assign = [flag, &target](auto& word) {
         target = whole_number(flag, word);
       }});
}

Option& OptionSet::count(const std::string& flag, const std::string& help,
                         std::optional<std::uint64_t>& target) {
  return add(
      {.flag = flag, .placeholder = "N", .help = help, .assign = [flag, &target](auto& word) {
         target = whole_number(flag, word);
       }});
}

Option& OptionSet::number(const std::string& flag, const std::string& placeholder,
                          const std::string& help, double& target) {
  return add({.flag = flag,
              .placeholder = placeholder,
              .help = help,
              .assign = [flag, &target](auto& word) { target = finite_number(flag, word); }});
}

Option& OptionSet::number(const std::string& flag, const std::string& placeholder,
                          const std::string& help, std::optional<double>& target) {
  return add({.flag = flag,
              .placeholder = placeholder,
              .help = help,
              .assign = [flag, &target](auto& word) { target = finite_number(flag, word); }});
}

Option& OptionSet::quantity(const std::string& flag, const std::string& placeholder,
                            const std::string& help, Dimension dimension, double& target) {
  const auto assign = [flag, dimension, &target](auto& word) {
    target = parse_si(word, dimension, flag);
  };
  return add({.flag = flag, .placeholder = placeholder, .help = help, .assign = assign});
}

Option& OptionSet::quantity(const std::string& flag, const std::string& placeholder,
                            const std::string& help, Dimension dimension,
                            std::optional<double>& target) {
  const auto assign = [flag, dimension, &target](auto& word) {
    target = parse_si(word, dimension, flag);
  };
  return add({.flag = flag, .placeholder = placeholder, .help = help, .assign = assign});
}

Option& OptionSet::quantities(const std::string& flag, const std::string& placeholder,
                              const std::string& help, Dimension dimension,
                              std::vector<double>& target) {
  const auto assign = [flag, dimension, &target](auto& word) {
    target = parse_si_list(word, dimension, flag);
  };
  return add({.flag = flag, .placeholder = placeholder, .help = help, .assign = assign});
}

}  // namespace tabor::cli
