#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tabor/cases/ehl/point_record.hpp"
#include "tabor/cases/ehl/program.hpp"
#include "tabor/core/warning.hpp"
#include "tabor/ehl/point/finish.hpp"
#include "tabor/ehl/point/point.hpp"

// A case of a point contact: from its keys to a problem, from a film to its numbers, texts and maps
// (docs/ehl_point.md).
namespace tabor::ehl {

/// Bodies, load, motion, liquid and grid; smooth. [groups] with Moes' M and L takes the place of
/// load and speed: a ball on a flat, steel and mineral oil unless the case says otherwise.
PointProblem read_point(const io::Config& config);

/// What a result says about the rough surface of its case.
struct RoughnessNotes {
  Warnings warnings = {};
  std::string scan_sha256 = {};  ///< of the bytes of its scan; "" without one
};

/// The rough surface of a case.
struct PointRoughness {
  /// Heights [m] at the nodes of a problem once the surface has moved so far along the flow [m];
  /// empty if the case has none.
  std::function<Field(double moved)> heights = {};
  RoughnessNotes notes = {};
};

/// [roughness]: a scan, a bump, a generated finish, or their sum. A generated finish is long enough
/// to move by `travel` [m], of either sign.
PointRoughness read_point_roughness(const io::Config& config, const PointProblem& problem,
                                    double travel, const CaseSetting& setting);

/// The whole case: read_point() with the roughness where it lies at rest.
struct RoughPoint {
  PointProblem problem;
  RoughnessNotes notes = {};
};
RoughPoint read_rough_point(const io::Config& config, const CaseSetting& setting);

/// A solved case: its record, its warnings and its maps.
struct PointOutcome {
  PointProblem problem;
  PointRecord record;
  Warnings warnings = {};
  std::function<void(io::Hdf5Writer&)> write = {};
  std::optional<Convergence> transient = {};  ///< of a film under a moving roughness

  /// What decides about the whole case.
  const Convergence& convergence() const { return transient ? *transient : record.convergence; }
};

/// The outcome of a film.
PointOutcome outcome_of(const io::Config& config, const PointProblem& problem,
                        const PointResult& film, const CaseSetting& setting,
                        const RoughnessNotes& notes);

/// Adds the rough bodies without liquid: what the film tends to as the speed vanishes.
void add_dry_contact(const Observer& observer, PointOutcome& outcome);

/// The outcome as all programs return it.
CaseResult result_of(const PointOutcome& outcome);

/// True where the rough surface moves: motion.duration says for how long.
bool has_transient(const io::Config& config);

/// Solves the film under a moving roughness: its outcome at the last instant, and what happened on
/// the way. Throws InputError, naming the key, for a case that cannot move.
PointOutcome transient_outcome(const io::Config& config, const CaseSetting& setting);

/// Maps in /contact, curves through the centre in /along and /across, the slice-plane graph in
/// /slice_plane. `smooth`: the film without the roughness, shown behind it, or null.
void write_point(io::Hdf5Writer& writer, const PointProblem& problem, const PointResult& result,
                 const PointResult* smooth);

/// Cases one after the other: each film starts from the one before where that is near; a film of
/// touching solids is hardly found without. The film before goes into a file and comes back bit
/// for bit.
CaseChain make_point_chain();

}  // namespace tabor::ehl
