#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tabor/cli/contact_request.hpp"

// Implements `tabor contact --lowpass-scan`: real contact area against the cutoff of a low-pass.
namespace tabor::cli {

/// Parses cutoffs, "64,128,256": plain rising numbers of waves per scan side.
std::vector<double> parse_cutoffs(const std::string& text);

/// Runs `tabor contact --lowpass-scan`: real contact area, and friction if a shear strength [Pa] is
/// given, against the cutoff of a Hann low-pass (the surfaces are otherwise treated alike). Prints
/// the result and returns the exit code.
int run_lowpass_scan(const Scan& scan, const cases::CaseSettings& settings,
                     const std::vector<double>& cutoffs,
                     const std::optional<double>& shear_strength, const CsvRequest& csv,
                     Context& context);

}  // namespace tabor::cli
