#pragma once

#include <string>

// Prints the description of the verbs (reference.hpp) as scripts with which shells complete verbs,
// options, values to choose from and files.
namespace tabor::cli {

std::string bash_completion();
std::string zsh_completion();
std::string fish_completion();

/// Returns the first clause of a help text, which stands beside a word in zsh and fish.
std::string first_clause(const std::string& help);

}  // namespace tabor::cli
