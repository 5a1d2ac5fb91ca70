#pragma once

#include <filesystem>
#include <string>
#include <vector>

// Finds the interpreter and the part of the Python package behind the verbs `report` and `view`.
namespace tabor::cli {

/// Returns the interpreter for a verb: that of TABOR_PYTHON; or of the environment made for
/// reports, beside an installed program or in the build folder of the sources; or of Debian. Throws
/// InputError where there is none.
std::filesystem::path python_program(const std::string& verb);

/// Returns the words with which the interpreter runs the part `tabor/VERB` of the package, alone:
/// neither the current folder nor variables of the environment nor packages of the user say what is
/// run. Throws InputError where the part is not beside the program.
std::vector<std::string> isolated_python(const std::string& verb);

}  // namespace tabor::cli
