#pragma once

#include <memory>
#include <string>

#include "tabor/cli/options.hpp"
#include "tabor/record/parameter.hpp"

// Options that are made from tables of parameters.
namespace tabor::cli {

/// The option that names a material of the library, which gives some of the others.
inline constexpr const char* kMaterial = "--material";

/// All of the option of a parameter but what it assigns. `has_default`: its example is its default.
Option option_of(const ParameterHead& parameter, bool has_default);

/// "0.225 Pa s" -> "0.225Pa*s", "2e-8 1/Pa" -> "2e-8/Pa", which need no quotes in a shell.
std::string in_a_shell(std::string text);

/// The word behind an option; a switch that begins with "--not-" turns off.
std::unique_ptr<Given> given(const std::string& flag, const std::string& word);

/// Declares the option of one parameter of `settings`.
template <typename Settings>
Option& declare(OptionSet& set, const Parameter<Settings>& parameter, Settings& settings) {
  Option option = option_of(parameter, parameter.has_default());
  option.assign = [&settings, &parameter, flag = option.flag](const std::string& word) {
    parameter.read(settings, *given(flag, word));
  };
  return set.add(std::move(option));
}

}  // namespace tabor::cli
