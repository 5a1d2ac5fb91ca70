#pragma once

#include <string>

#include "tabor/cli/verb.hpp"

namespace tabor::cli {

std::string overview();                 ///< `tabor --help`
std::string help_of(const Verb& verb);  ///< `tabor VERB --help`
std::string options_markdown();         ///< docs/options.md, from the same declarations

}  // namespace tabor::cli
