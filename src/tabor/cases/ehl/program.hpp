#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tabor/cases/ehl/surface.hpp"
#include "tabor/core/column.hpp"
#include "tabor/core/convergence.hpp"
#include "tabor/core/names.hpp"
#include "tabor/core/warning.hpp"
#include "tabor/io/hdf5/hdf5.hpp"
#include "tabor/io/text/toml.hpp"
#include "tabor/record/parameter.hpp"

// From a case, as a TOML file states it, to its numbers: impact, squeeze, line and point contact.
namespace tabor::ehl {

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

/// How a case ended.
enum class CaseStatus {
  converged,      ///< to the tolerance of its solver
  not_converged,  ///< its numbers are those of where the solver ended
  rejected        ///< it is invalid: it has no numbers, CaseResult::error says why
};

inline constexpr Names<CaseStatus, 3> kCaseStatus{{"converged", "not converged", "rejected"}};

/// Where a number of a record appears (Media of its column).
namespace media {
inline constexpr Media kCase = 1;        ///< JSON object and result file of a case: every number
inline constexpr Media kTable = 2;       ///< the table of many cases
inline constexpr Media kWhereKnown = 4;  ///< that table, where any of its cases knows the number
inline constexpr Media kLimit = 8;       ///< its limit on ever finer grids
}  // namespace media

/// A number of a case alone.
inline constexpr ColumnStyle kAlone{.media = media::kCase};
/// A number in the table of many cases, too.
inline constexpr ColumnStyle kInTable{.media = media::kCase | media::kTable | media::kLimit};
/// The same where any of the cases knows it.
inline constexpr ColumnStyle kInTableWhereKnown{.media = media::kCase | media::kWhereKnown |
                                                         media::kLimit};
/// A count in that table, which has no limit.
inline constexpr ColumnStyle kCountInTable{.media = media::kCase | media::kTable};

/// What a program found out about one case.
struct CaseResult {
  NamedCells numbers = {};        ///< of its record, in the order of its columns; SI
  std::vector<Facts> facts = {};  ///< for a person, in groups
  CaseStatus status = CaseStatus::not_converged;
  std::string error = {};  ///< of a case that was rejected
  Warnings warnings = {};
  /// Writes histories and profiles into a result file that has its head and numbers already.
  std::function<void(io::Hdf5Writer&)> write = {};

  bool converged() const { return status == CaseStatus::converged; }
  bool rejected() const { return status == CaseStatus::rejected; }
  /// The value of a column, "wear.mean_depth_m"; std::monostate where the record has none.
  Cell cell(std::string_view key) const;
  /// The number of a column; NaN where there is none.
  double number(std::string_view key) const { return number_in(cell(key)); }
};

/// Returns the status of a case whose solver ended so.
CaseStatus status_of(const Convergence& convergence);

/// The columns of a record without its type.
using CaseColumns = std::vector<ColumnHead>;
template <typename Record>
CaseColumns heads_of(const Columns<Record>& columns) {
  return {columns.begin(), columns.end()};
}

/// A study of how far a result depends on something that is not physics.
struct CaseStudy {
  std::string name;    ///< "grid"
  std::string key;     ///< of the case, "grid.nodes"
  std::string number;  ///< key of the column where the value in force stands
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
  std::vector<ParameterHead> keys;      ///< of the case; it reads no other ones
  Example example = {};                 ///< a case that computes in seconds
  std::vector<std::string> files = {};  ///< keys that name a file, from where the case lies
  CaseColumns columns;                  ///< of the record of a case
  std::vector<CaseStudy> studies;
  std::vector<std::string> methods;  ///< keys of references.bib
  CaseSolver solve;
  /// Reads all of a case but the files it names. Throws InputError for an invalid one.
  std::function<void(const io::Config&)> check = {};
  std::function<CaseChain()> make_chain = {};  ///< of a sweep; empty: each case by itself
  std::vector<std::string> downwards = {};     ///< keys whose largest value is the easiest
  /// Beginnings of keys whose values decide whether two cases may be neighbours in a chain.
  std::vector<std::string> chain_ends = {};
  /// Memory that a case takes [bytes]. Throws InputError for an invalid one.
  std::function<double(const io::Config&)> memory = {};
};

Program impact_program();   ///< a ball falls on a lubricated flat (docs/ehl.md)
Program squeeze_program();  ///< a roller closes on a sliding flat (docs/ehl.md)
Program line_program();     ///< line contact, smooth, rough or worn (docs/ehl_line.md)
Program point_program();    ///< point contact, smooth or rough (docs/ehl_point.md)

/// All programs in the order people meet them.
const std::vector<Program>& programs();

/// A case file to start from: the example's values, and every other key commented out with its
/// default or a value such as it may have; each with its unit, meaning and default.
std::string case_template(const Program& program);

/// Throws InputError for a key that no case of the program has, naming the nearest one or, if the
/// case is of another program, that one.
void reject_unknown_keys(const Program& program, const io::Config& config);

/// Throws InputError for a case that solve_case() would not begin: unknown keys, those that are
/// missing, values out of range or of another dimension. Files that it names are not read.
void check_case(const Program& program, const io::Config& config);

/// Throws InputError for a case that takes more memory than is free.
void check_memory_of_case(const Program& program, const io::Config& config);

/// Solves one case of a program whose keys it knows. Throws as CaseSolver, reject_unknown_keys()
/// and check_memory_of_case().
CaseResult solve_case(const Program& program, const io::Config& config,
                      const CaseSetting& setting = {});

}  // namespace tabor::ehl
