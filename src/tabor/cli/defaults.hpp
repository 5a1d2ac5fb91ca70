#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tabor/cli/verb.hpp"

namespace tabor::cli {

/// What a file of defaults adds to one command line.
struct Defaults {
  std::string file;                                       ///< "" where there is none
  std::vector<std::pair<std::string, std::string>> used;  ///< flag, value; a switch has none

  /// As words of a command line, to stand before those that were typed.
  std::vector<std::string> words() const;
  /// "--material=aluminium-6016 --level=plane".
  std::string text() const;
};

/// Reads the file that `--defaults` names among `words`, or tabor.toml of the working folder, which
/// need not be there; `--defaults none` reads none. Its keys are options of any verb without their
/// dashes ("shear_strength = \"70 MPa\""), and those of one verb in a table of its name, which win.
/// Options that are typed win over the file; a material that is typed wins over all that the file
/// says of one. Throws InputError for keys that are no option or name files, and for values of
/// `verb`'s options that are not what these take.
Defaults defaults_for(const Verb& verb, const std::vector<std::string>& words);

}  // namespace tabor::cli
