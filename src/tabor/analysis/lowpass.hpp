#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tabor/analysis/records.hpp"
#include "tabor/analysis/settings.hpp"
#include "tabor/topography/topography.hpp"

// How far the contact depends on the finest wavelength of the surface.
namespace tabor::analysis {

/// The contact of the surface behind one low-pass.
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

/// Contacts under all pressures behind a Hann low-pass of each cutoff, in that order; `receive` is
/// given the place of the pressure in the list, too. Dry friction where `friction` is given. Throws
/// as contact_states().
void lowpass_states(const topography::Topography& surface, const ContactSettings& settings,
                    const std::vector<double>& mean_pressures, const std::vector<double>& cutoffs,
                    const std::optional<FrictionSettings>& friction,
                    const std::function<void(LowpassRecord&&, std::size_t pressure)>& receive,
                    const Observer& observer = {});

}  // namespace tabor::analysis
