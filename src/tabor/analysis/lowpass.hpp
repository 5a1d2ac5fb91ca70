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

}  // namespace tabor::analysis
