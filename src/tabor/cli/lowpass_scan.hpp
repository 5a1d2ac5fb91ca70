#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tabor/cli/contact_request.hpp"

namespace tabor::cli {

/// Cutoffs as text, "64,128,256": plain rising numbers of waves per scan side.
std::vector<double> parse_cutoffs(const std::string& text);

/// `tabor contact --lowpass-scan`: real contact area, and friction if a shear strength [Pa] is
/// given, against the cutoff of a Hann low-pass (surfaces treated otherwise alike). Prints the
/// result and returns the exit code.
int run_lowpass_scan(const Scan& scan, const analysis::CaseSettings& settings,
                     const std::vector<double>& cutoffs,
                     const std::optional<double>& shear_strength, const CsvRequest& csv,
                     Context& context);

}  // namespace tabor::cli
