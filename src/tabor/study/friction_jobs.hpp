#pragma once

#include <vector>

#include "tabor/study/case.hpp"
#include "tabor/study/job.hpp"
#include "tabor/study/store.hpp"

namespace tabor::study {

/// What a study needs of all its scans, for run_jobs(): of each scan its surface and its films,
/// then every contact with its rows. Where the oil flows, each film that flows comes with its row
/// after the contacts of its scan. A scan and a pressure are one part. Everything given must
/// outlive the jobs.
std::vector<Job> friction_jobs(const Store& store, const Study& study,
                               const std::vector<ScanTasks>& tasks);

}  // namespace tabor::study
