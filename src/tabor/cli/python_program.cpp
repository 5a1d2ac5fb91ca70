#include "tabor/cli/python_program.hpp"

#include <cstdlib>
#include <optional>

#include "tabor/core/error.hpp"
#include "tabor/io/files/subprocess.hpp"

namespace tabor::cli {

namespace {

namespace fs = std::filesystem;

/// The folder two above the program: the prefix of an installed one, the build folder of another.
fs::path own_prefix() {
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error).parent_path().parent_path();
}

/// That of a complete environment made for reports: beside an installed program, or in the build
/// folder of the source tree (tools/check/setup.sh). It has Bokeh, which Debian has not.
std::optional<fs::path> report_python() {
  std::error_code error;
  for (const fs::path& folder : {own_prefix() / "share/tabor/report",
                                 fs::path(TABOR_SOURCE_PYTHON).parent_path() / "build/report"}) {
    if (fs::exists(folder / "complete", error) && fs::exists(folder / "bin/python3", error)) {
      return folder / "bin/python3";
    }
  }
  return std::nullopt;
}

/// The packages of the build folder and of a wheel, which holds the program, have the compiled
/// module; those beside an installed program and in the source tree have not, and `view` then takes
/// the one that the interpreter has.
fs::path file_of(const std::string& verb) {
  std::error_code error;
  for (const fs::path& folder : {own_prefix() / "python", own_prefix() / "share/tabor/python",
                                 own_prefix().parent_path(), fs::path(TABOR_SOURCE_PYTHON)}) {
    fs::path file = folder / "tabor" / verb / "__main__.py";
    if (fs::exists(file, error)) return file;
  }
  throw InputError("tabor " + verb, "no Python package tabor/" + verb + " beside the program", "",
                   "install tabor with 'cmake --install'");
}

}  // namespace

fs::path python_program(const std::string& verb) {
  if (const char* chosen = std::getenv("TABOR_PYTHON")) {
    if (fs::path(chosen).has_parent_path()) return chosen;
    if (const auto found = io::find_program(chosen)) return *found;
    throw InputError("TABOR_PYTHON", "'" + std::string(chosen) + "'", "a program in PATH", "");
  }
  if (const auto own = report_python()) return *own;
  // Debian's own interpreter is where apt puts numpy, h5py and matplotlib.
  if (fs::exists("/usr/bin/python3")) return "/usr/bin/python3";
  if (const auto found = io::find_program("python3")) return *found;
  throw InputError("tabor " + verb, "no python3", "Python 3.9 or newer", "apt install python3");
}

std::vector<std::string> isolated_python(const std::string& verb) {
  // -X utf8: names of files are bytes in any locale.
  return {"-I", "-B", "-X", "utf8", "-W", "ignore", file_of(verb).string()};
}

}  // namespace tabor::cli
