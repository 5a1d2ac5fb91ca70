#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "tabor/core/convergence.hpp"
#include "tabor/ehl/surface.hpp"
#include "tabor/io/hdf5.hpp"
#include "tabor/io/json.hpp"
#include "tabor/io/toml.hpp"

// From a case, as a TOML file states it, to its numbers: impact, squeeze, line and point contact.
namespace tabor::ehl {

/// One key of a case. A program reads no other ones than those of its table.
struct CaseKey {
  std::string name;          ///< "ball.radius"
  std::string unit = {};     ///< "m"; "" for plain numbers and words
  std::string usual = {};    ///< its value if it is not given, or what takes its place
  std::string meaning = {};  ///< one sentence at most
};
using CaseKeys = std::vector<CaseKey>;

/// In place of the usual value of a key that every case must have.
inline constexpr const char* kRequired = "required";

/// Key lists one after the other.
CaseKeys joined(CaseKeys keys, const std::vector<CaseKeys>& more);

/// Values of keys as TOML writes them: {"ball.radius", "\"10 mm\""}.
using Example = std::vector<std::pair<std::string, std::string>>;

/// What a case is solved with, beside itself.
struct CaseSetting {
  Observer observer = {};
  std::uint64_t seed = 1;       ///< of generated surfaces whose case names none
  SurfaceSource surfaces = {};  ///< for [roughness]; a case that needs it throws InputError without
};

/// One line for a person: "smallest film", "182 nm".
struct Fact {
  std::string label;
  std::string value;
};
using Facts = std::vector<Fact>;

/// What a program found out about one case.
struct CaseResult {
  io::Json scalars = io::Json::object();  ///< the keys of its JSON object, in their order, SI
  std::vector<Facts> facts = {};          ///< for a person, in groups
  bool converged = false;
  std::vector<std::string> warnings = {};
  /// Writes histories and profiles into a result file that has its head and scalars already.
  std::function<void(io::Hdf5Writer&)> write = {};
};

/// A column of the table of many cases.
struct CaseColumn {
  std::string key;           ///< of the JSON object; "wear.mean_depth_m" of the object "wear" in it
  std::string heading;       ///< "force"
  std::string unit;          ///< "N", "" for a plain number
  bool is_optional = false;  ///< left out where no case has the key
  bool has_limit = true;     ///< on ever finer grids; a count of iterations has none
};

/// A study of how far a result depends on something that is not physics.
struct CaseStudy {
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

/// Solves a case. Throws InputError, and Interrupted instead of returning what an interruption left
/// unfinished; not converging is returned.
using CaseSolver = std::function<CaseResult(const io::Config& config, const CaseSetting& setting)>;

/// Solves cases one after the other, each of which may start from the one before.
struct CaseChain {
  CaseSolver solve;  ///< remembers what the next one may start from
  /// Puts that into a file and back, to the last bit.
  std::function<void(io::Hdf5Writer&)> write_start = {};
  std::function<void(const io::Hdf5Reader&)> read_start = {};
};

/// One kind of case: its keys, how it is solved, and what comes out.
struct Program {
  std::string name;
  std::string summary;
  CaseKeys keys;                        ///< of the case
  Example example = {};                 ///< a case that computes in seconds
  std::vector<std::string> files = {};  ///< keys that name a file, from where the case lies
  std::vector<CaseColumn> columns;
  std::vector<CaseStudy> studies;
  std::vector<std::string> methods;  ///< keys of references.bib
  CaseSolver solve;
  std::function<CaseChain()> make_chain = {};  ///< of a sweep; empty: each case by itself
  std::vector<std::string> downwards = {};     ///< keys whose largest value is the easiest
  /// Beginnings of keys whose values decide whether two cases may be neighbours in a chain.
  std::vector<std::string> chain_ends = {};
  /// Memory that a case takes [bytes]. Throws InputError for an invalid one.
  std::function<std::size_t(const io::Config&)> memory = {};
};

Program impact_program();   ///< a ball falls on a lubricated flat (docs/ehl.md)
Program squeeze_program();  ///< a roller closes on a sliding flat (docs/ehl.md)
Program line_program();     ///< line contact, smooth, rough or worn (docs/ehl_line.md)
Program point_program();    ///< point contact, smooth or rough (docs/ehl_point.md)

/// All programs in the order people meet them.
const std::vector<Program>& programs();

/// A case file to start from: the example's values, and every other key commented out, each with
/// its unit, meaning and usual value.
std::string case_template(const Program& program);

/// Throws InputError for a key that no case of the program has, naming the nearest one or, if the
/// case is of another program, that one.
void reject_unknown_keys(const Program& program, const io::Config& config);

/// Solves one case of a program whose keys it knows. Throws as CaseSolver and
/// reject_unknown_keys().
CaseResult solve_case(const Program& program, const io::Config& config,
                      const CaseSetting& setting = {});

}  // namespace tabor::ehl
