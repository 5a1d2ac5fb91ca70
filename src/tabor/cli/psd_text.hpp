#pragma once

#include <string>
#include <vector>

#include "tabor/cases/spectra.hpp"
#include "tabor/cli/scan.hpp"

// Prints the spectra and correlations of `tabor psd`, of one scan or averaged over groups.
namespace tabor::cli {

/// Returns facts and a table, as text.
std::string text_of(const Scan& scan, const cases::SpectraRecord& curves);
/// Returns one row per group; a window makes rms heights smaller than Sq, and the heading says so.
std::string text_of(const std::vector<cases::GroupSpectra>& groups, bool has_window);

}  // namespace tabor::cli
