#pragma once

#include <functional>
#include <vector>

#include "tabor/analysis/density_curve.hpp"
#include "tabor/analysis/records.hpp"
#include "tabor/analysis/settings.hpp"
#include "tabor/study/run_options.hpp"
#include "tabor/topography/topography.hpp"

// Friction of one surface without a store: its rain, its contacts and what follows from both are
// jobs of the one engine. The rain is one thread's work, so that contacts are solved beside it.
namespace tabor::study {

/// One pressure with one density. The references hold during the call that hands the state on.
struct FrictionState {
  const analysis::FrictionRecord& friction;
  const analysis::ContactRecord& contact;  ///< its maps if asked for
  const analysis::FilmRecord& film;
  const analysis::FluidRecord* fluid;  ///< null where the oil does not flow
};

/// Whether whoever receives the states looks at the maps of contacts. Each contact waits for the
/// rain in memory: with 9 bytes per pixel for what friction needs of it, with 25 for all maps.
enum class ContactMaps { dropped, kept };

/// What friction_of() returns beside the states it hands on.
struct ScanFrictionResult {
  /// Friction against density, one for each pressure; none where the oil flows, where all densities
  /// are zero, or where it does not run downhill.
  std::vector<analysis::DensityCurve> density_curves;
};

/// Hands on every pressure with every density, the densities of the first pressure first, one at a
/// time and not always by the same thread. Each density is rained once and each pressure solved
/// once. Records do not depend on the number of jobs or threads; a shard and retry mean nothing
/// here. Throws InputError for invalid settings and surfaces, Interrupted where the
/// observer stops it (what was handed on before is whole), and whatever `receive` throws.
ScanFrictionResult friction_of(const topography::Topography& surface,
                               const analysis::CaseSettings& settings,
                               const std::function<void(const FrictionState&)>& receive,
                               ContactMaps maps = ContactMaps::kept,
                               const RunOptions& options = {});

}  // namespace tabor::study
