#pragma once

#include <string>

// Prints the description of the verbs (reference.hpp) as Markdown.
namespace tabor::cli {

std::string options_markdown();  ///< docs/options.md

}  // namespace tabor::cli
