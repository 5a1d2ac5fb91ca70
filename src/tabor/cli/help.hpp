#pragma once

#include <string>

#include "tabor/cli/verb.hpp"

// Makes the help texts and docs/options.md from the declared options of the verbs.
namespace tabor::cli {

std::string overview();  ///< `tabor --help`
/// Returns the text of `tabor VERB --help`, with what the verb adds for a word after it.
std::string help_of(const Verb& verb, const std::string& word = "");
/// Breaks a text at blanks so that it fits the screen; all lines but the first are indented.
std::string wrapped(const std::string& text, std::size_t indent);
std::string options_markdown();  ///< docs/options.md, from the same declarations

}  // namespace tabor::cli
