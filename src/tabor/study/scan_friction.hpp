#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tabor/cases/density_curve.hpp"
#include "tabor/cases/records.hpp"
#include "tabor/cases/settings.hpp"
#include "tabor/engine/run_options.hpp"
#include "tabor/topography/topography.hpp"

// Computes the friction of one surface without a store: its rain, its contacts and what follows
// from both are jobs of the one engine. The rain runs on one thread; contacts are solved beside it.
namespace tabor::study {

/// State of one pressure with one density. The references are valid during the call that hands the
/// state on.
struct FrictionState {
  const cases::FrictionRecord& friction;
  const cases::ContactRecord& contact;  ///< its maps if asked for
  cases::Oil oil;                       ///< its film, and what it does beside wetting
};

/// Maps of contacts in the states that are handed on. Each contact waits for the rain in memory:
/// with 9 bytes per pixel for friction alone, with 25 for all maps.
enum class ContactMaps { dropped, kept };

/// Wet shares on pixels twice as large (area averages), which take a quarter of the work.
struct CoarsePixels {
  double pixel_x = 0;  ///< [m]
  /// [pressure][density]; none where it was not asked for, or the scan has less than 32 pixels
  /// along a side.
  std::vector<std::vector<double>> lubricated_shares;
};

/// Kinds of jobs that this adds to the graph: the calls of `receive`, and the coarse pixels.
inline constexpr const char* kHandOn = "hand on";
inline constexpr const char* kCoarsePixels = "coarse pixels";

/// Result of friction_of() beside the states that it hands on.
struct ScanFrictionResult {
  /// Friction against density, one for each pressure; none where the oil flows, where all densities
  /// are zero, or where it does not run downhill.
  std::vector<cases::DensityCurve> density_curves;
  CoarsePixels coarse = {};
  /// Wall time of the jobs by kind, added up over each kind: those of kFrictionJobs
  /// (friction_graph.hpp), kHandOn and kCoarsePixels. Some run side by side.
  std::map<std::string, double> seconds = {};
};

/// Computes the friction of one surface. Hands on every pressure with every density, the densities
/// of the first pressure first, one at a time and not always by the same thread. Each density is
/// rained once and each pressure solved once. Records do not depend on the number of jobs or
/// threads; a shard and retry mean nothing here. Throws InputError for invalid settings and
/// surfaces, Interrupted where the observer stops it (what was handed on before is whole), and
/// whatever `receive` throws.
ScanFrictionResult friction_of(const topography::Topography& surface,
                               const cases::CaseSettings& settings,
                               const std::function<void(const FrictionState&)>& receive,
                               ContactMaps maps = ContactMaps::kept,
                               const engine::RunOptions& options = {},
                               bool compares_pixels = false);

}  // namespace tabor::study
