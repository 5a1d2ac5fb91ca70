#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tabor/cases/records.hpp"
#include "tabor/cases/settings.hpp"
#include "tabor/topography/topography.hpp"

// Solves contacts behind low-passes of rising cutoff, to show how far they depend on the finest
// wavelength of the surface.
namespace tabor::cases {

/// Contact of the surface behind one low-pass.
struct LowpassRecord {
  std::string filter;                       ///< "lowpass=hann:64/L"
  double cutoff = 0;                        ///< waves per scan side
  double wavelength = 0;                    ///< [m]
  double rms_slope = 0;                     ///< of the filtered surface
  ContactRecord contact;                    ///< its warnings are those of the friction, too
  std::optional<double> friction_dry = {};  ///< where a shear strength is given
  bool dry_at_bound = false;
};
const Columns<LowpassRecord>& lowpass_columns();

/// Solves contacts under all pressures behind a Hann low-pass of each cutoff, in that order;
/// `receive` is also given the place of the pressure in the list. Dry friction where `friction` is
/// given. Throws as contact_states().
void lowpass_states(const topography::Topography& surface, const ContactSettings& settings,
                    const std::vector<double>& mean_pressures, const std::vector<double>& cutoffs,
                    const std::optional<FrictionSettings>& friction,
                    const std::function<void(LowpassRecord&&, std::size_t pressure)>& receive,
                    const Observer& observer = {});

}  // namespace tabor::cases
