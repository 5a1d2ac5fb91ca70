#pragma once

#include <string>

#include "tabor/core/convergence.hpp"
#include "tabor/study/study.hpp"
#include "tabor/topography/topography.hpp"

// Reads the scans of a study and treats them.
namespace tabor::study {

/// Reads and treats one scan. Throws InputError, also for a surface that still has holes. Throws
/// Error if the bytes that are read are not those of `scan_sha256`: the scan was replaced since the
/// sweep began, and its results would be stored as those of the earlier scan.
topography::Topography treated_surface(const Study& study, const Scan& scan,
                                       const std::string& scan_sha256, const Observer& observer);

}  // namespace tabor::study
