#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tabor/cli/verb.hpp"

// Reads tabor.toml, the file of default options, for one command line.
namespace tabor::cli {

/// Options that a file of defaults adds to one command line.
struct Defaults {
  std::string file;                                       ///< "" where there is none
  std::vector<std::pair<std::string, std::string>> used;  ///< flag, value; a switch has none

  /// Returns them as words, to stand before the typed words of the command line.
  std::vector<std::string> words() const;
  /// Returns them as text: "--material=aluminium-6016 --level=plane".
  std::string text() const;
};

/// Reads the file that `--defaults` names among `words`, or tabor.toml of the working folder, which
/// need not be there; `--defaults none` reads none. Its keys are options of any verb without their
/// dashes ("shear_strength = \"70 MPa\""). A key in the verb's own table overrides the same key at
/// top level. A typed option overrides the file; a typed material overrides all values of a
/// material in the file. Throws InputError for keys that are no option or name files, and for
/// invalid values of `verb`'s options.
Defaults defaults_for(const Verb& verb, const std::vector<std::string>& words);

}  // namespace tabor::cli
