#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tabor/cli/ehl_keys.hpp"
#include "tabor/cli/verb.hpp"
#include "tabor/io/hdf5.hpp"
#include "tabor/io/json.hpp"
#include "tabor/io/toml.hpp"

namespace tabor::cli {

/// What an elastohydrodynamic program found out about one case.
struct EhlAnswer {
  io::Json scalars;  ///< the keys of its JSON object, in their order
  std::string text;  ///< for a person
  bool converged = false;
  std::vector<std::string> warnings = {};
  /// Writes histories and profiles into a result file that has its head and scalars already.
  std::function<void(io::Hdf5Writer&)> write = {};
};

/// A column of the table of a sweep or a study.
struct EhlColumn {
  std::string key;           ///< of the JSON object; "wear.mean_depth_m" of the object "wear" in it
  std::string heading;       ///< "force"
  std::string unit;          ///< "N", "" for a plain number
  bool is_optional = false;  ///< left out where no case has the key
  bool has_limit = true;     ///< on ever finer grids; a count of iterations has none
};

/// A study of how far a result depends on something that is not physics.
struct EhlStudy {
  std::string name;    ///< "grid"
  std::string key;     ///< of the case, "grid.nodes"
  std::string scalar;  ///< of the JSON object, where the value in force stands
  std::string unit;    ///< of both, "" for a whole number
  std::vector<double> factors;
  bool has_limit = true;         ///< values tend to a limit that can be extrapolated
  bool is_count = unit.empty();  ///< of nodes: the spacing is one over the cells between them
  int end_nodes = 0;             ///< nodes that are not cells
  int cells_by = 1;              ///< cells come in multiples of it
};

/// Solves a case. Throws InputError, and Interrupted instead of answering with what an interruption
/// left unfinished.
using EhlSolver = std::function<EhlAnswer(const io::Config& config, Context& context)>;

/// Solves the cases of a sweep one after the other, each of which may start from the one before.
struct EhlChain {
  EhlSolver solve;  ///< remembers what the next one may start from
  /// Puts that into a file and back, so that a sweep goes on where it was stopped.
  std::function<void(io::Hdf5Writer&)> write_start = {};
  std::function<void(const io::Hdf5Reader&)> read_start = {};
};

/// One sub-verb of `tabor ehl`.
struct EhlProgram {
  std::string name;
  std::string summary;
  EhlKeys keys;                         ///< of the case
  std::vector<std::string> files = {};  ///< keys that name a file, from where the case lies
  std::vector<EhlColumn> columns;
  std::vector<EhlStudy> studies;
  std::vector<std::string> methods;  ///< keys of references.bib
  EhlSolver solve;
  std::function<EhlChain()> make_chain = {};  ///< of a sweep; empty: each case by itself
  std::vector<std::string> downwards = {};    ///< keys whose largest value is the easiest
};

EhlProgram impact_program();
EhlProgram squeeze_program();
EhlProgram line_program();
EhlProgram point_program();

}  // namespace tabor::cli
