#pragma once

#include <optional>
#include <vector>

#include "tabor/cli/contact_request.hpp"

namespace tabor::cli {

/// A range of cutoffs over which the contact area hardly changes.
struct Plateau {
  double first = 0;          ///< cutoff, in waves per scan side
  double last = 0;           ///< the same
  double area_fraction = 0;  ///< mean over the range
};

/// The longest range, by the ratio of its ends, of at least three consecutive cutoffs whose areas
/// all lie within `tolerance` (relative) of their mean; nullopt if there is none. Cutoffs rise.
std::optional<Plateau> find_plateau(const std::vector<double>& cutoffs,
                                    const std::vector<double>& areas, double tolerance = 0.05);

/// Cutoffs as text, "64,128,256": plain rising numbers of waves per scan side.
std::vector<double> parse_cutoffs(const std::string& text);

/// `tabor contact --lowpass-scan`: real contact area, and friction if a shear strength [Pa] is
/// given, against the cutoff of a Hann low-pass (surfaces treated otherwise alike). Prints the
/// result and returns the exit code.
int run_lowpass_scan(const Scan& scan, const ContactRequest& request,
                     const std::vector<double>& cutoffs,
                     const std::optional<double>& shear_strength, Context& context);

}  // namespace tabor::cli
