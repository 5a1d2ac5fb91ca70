#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tabor/ehl/point/finish.hpp"
#include "tabor/ehl/point/point.hpp"
#include "tabor/ehl/program.hpp"

// A case of a point contact: from its keys to a problem, from a film to its numbers, texts and maps
// (docs/ehl_point.md).
namespace tabor::ehl {

/// Bodies, load, motion, liquid and grid; smooth. [groups] with Moes' M and L takes the place of
/// load and speed: a ball on a flat, steel and mineral oil unless the case says otherwise.
PointProblem read_point(const io::Config& config);

/// What a result says about the rough surface of its case.
struct RoughnessNotes {
  std::vector<std::string> warnings = {};
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

/// All keys of a case, and those of [roughness] alone.
CaseKeys point_keys();
CaseKeys point_roughness_keys();

/// Numbers, facts, warnings and maps of a film.
CaseResult point_result(const io::Config& config, const PointProblem& problem,
                        const PointResult& film, const CaseSetting& setting,
                        const RoughnessNotes& notes);

/// Adds the rough bodies without liquid: what the film tends to as the speed vanishes.
void add_dry_contact(const PointProblem& problem, const Observer& observer, CaseResult& result);

/// Whether the rough surface moves: motion.duration says for how long.
bool has_passage(const io::Config& config);

/// The film at the last instant, and what happened on the way. Throws InputError, naming the key,
/// for a case that cannot move.
CaseResult passage_result(const io::Config& config, const CaseSetting& setting);

/// Maps in /contact, curves through the centre in /along and /across, the slice-plane graph in
/// /slice_plane. `smooth`: the film without the roughness, shown behind it, or null.
void write_point(io::Hdf5Writer& writer, const PointProblem& problem, const PointResult& result,
                 const PointResult* smooth);

/// Cases one after the other: each film starts from the one before where that is near; a film of
/// touching solids is hardly found without. The film before goes into a file and comes back bit
/// for bit.
CaseChain make_point_chain();

}  // namespace tabor::ehl
