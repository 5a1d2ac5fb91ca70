#pragma once

#include <filesystem>
#include <optional>

#include "tabor/results/result_maps.hpp"

namespace tabor::study {

/// Lists the maps of a result file of contact, lubricate, friction or ehl point, or of one scan of
/// a study: its folder or its results.h5, whose states are the rows of the scan in results.csv.
/// `scan` counts from 0 and may be left out where there is one. Throws InputError with the scans to
/// choose from, and for a file that is no result.
results::ResultMaps read_maps(const std::filesystem::path& result,
                              std::optional<std::size_t> scan = {});

}  // namespace tabor::study
