#pragma once

#include <string>

#include "tabor/cli/verb.hpp"

namespace tabor::cli {

std::string overview();  ///< `tabor --help`
/// `tabor VERB --help`, with what the verb adds for a word behind it.
std::string help_of(const Verb& verb, const std::string& word = "");
std::string options_markdown();  ///< docs/options.md, from the same declarations

}  // namespace tabor::cli
