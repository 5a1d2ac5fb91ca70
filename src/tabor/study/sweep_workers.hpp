#pragma once

#include <vector>

#include "tabor/core/resources.hpp"
#include "tabor/study/sweep.hpp"

namespace tabor::study {

/// Works through the plans with several workers at a time and counts in `outcome` what was
/// computed. Throws what stopped it, after every worker has ended. `since_start` tells the time
/// that the sweep has taken.
void compute_missing(const Store& store, const Study& study, const std::vector<ScanUnits>& units,
                     const std::vector<ScanPlan>& plans, const SweepOptions& options,
                     const Stopwatch& since_start, Outcome& outcome);

}  // namespace tabor::study
