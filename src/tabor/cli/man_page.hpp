#pragma once

#include <string>
#include <vector>

#include "tabor/cli/verb.hpp"

// Prints the description of the program and its verbs (reference.hpp) as manual pages.
namespace tabor::cli {

/// A page of section 1 in the man macros of roff.
struct ManPage {
  std::string name;  ///< "tabor-contact"
  std::string text;

  std::string file() const { return name + ".1"; }
};

ManPage man_page();                  ///< of the program
ManPage man_page(const Verb& verb);  ///< of one verb
std::vector<ManPage> man_pages();    ///< the program and every verb

}  // namespace tabor::cli
