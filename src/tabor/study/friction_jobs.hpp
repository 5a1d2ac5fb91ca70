#pragma once

#include <vector>

#include "tabor/engine/job.hpp"
#include "tabor/engine/store.hpp"
#include "tabor/study/case.hpp"

namespace tabor::study {

/// Lists the jobs of a study for run_jobs(): for each scan its surface and its films, then every
/// contact with its rows. Where the oil flows, each flowing film comes with its row after the
/// contacts of its scan. A scan and a pressure are one part. Everything given must outlive the
/// jobs.
std::vector<engine::Job> friction_jobs(const engine::Store& store, const Study& study,
                                       const std::vector<ScanTasks>& tasks);

}  // namespace tabor::study
