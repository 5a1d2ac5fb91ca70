#pragma once

#include <string>
#include <vector>

#include "tabor/cli/verb.hpp"

// Prints the help texts for a terminal from the description of the verbs (reference.hpp).
namespace tabor::cli {

/// A command that a newcomer tries in the first hour, with what it shows.
struct FirstStep {
  std::string command;  ///< "tabor info SCAN"
  std::string purpose;
};
const std::vector<FirstStep>& first_steps();

std::string greeting();  ///< `tabor` alone
std::string overview();  ///< `tabor --help`
/// Returns the text of `tabor VERB --help`, with what the verb adds for a word after it.
std::string help_of(const Verb& verb, const std::string& word = "");

}  // namespace tabor::cli
