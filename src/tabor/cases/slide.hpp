#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tabor/cases/records.hpp"
#include "tabor/cases/settings.hpp"
#include "tabor/sliding/slider.hpp"
#include "tabor/topography/topography.hpp"

// Slides a rough tool over a sheet and reports friction, ploughing and the sheet along the way.
namespace tabor::cases {

/// Settings of sliding beside those of contact, film and friction.
struct SlideSettings {
  double distance = 0;               ///< of sliding [m]
  std::optional<double> step = {};   ///< [m], whole pixels; absent: as the step certificate asks
  std::optional<double> every = {};  ///< distance between states [m]; absent: a twentieth
  sliding::Displaced displaced = sliding::Displaced::near;
  double reach = 2e-6;  ///< of Displaced::near [m]
};
const Parameters<SlideSettings>& slide_parameters();

/// State of a sheet under a tool after some distance. Ploughing is a mean since the state before.
struct SlideRecord {
  double distance = 0;  ///< [m]
  contact::Summary contact;
  double friction_dry = kNoValue;  ///< with ploughing
  double friction_ploughing = kNoValue;
  double friction_ploughing_lower = kNoValue;
  double friction_ploughing_upper = kNoValue;
  double step_certificate = kNoValue;
  double lubricated_share = kNoValue;
  double friction_lubricated = kNoValue;  ///< with ploughing; the film stays where it was laid
  double moved_volume = 0;                ///< over the nominal area, so far [m]
  double lost_volume = 0;                 ///< of it, that left the sheet [m]
  double rms_height = 0;                  ///< Sq of the sheet [m]
  double mean_roughness = 0;              ///< Sa [m]
  double certificate = kNoValue;
  bool converged = false;  ///< this contact and all before
};
const Columns<SlideRecord>& slide_columns();

/// A sheet before and after sliding.
struct SlideResult {
  double step = 0;          ///< that was taken [m]
  std::uint64_t steps = 0;  ///< so many
  std::vector<SlideRecord> states;
  topography::Topography after;  ///< the sheet, unloaded
  Warnings warnings;
  std::vector<std::string> references;
  bool converged = false;
};

/// Warns of steps that are too long for the tool, and of a sheet that is worn off by more than its
/// roughness bears. `rms_height` [m]: of the sheet before.
Warnings of_sliding(const sliding::Ploughing& all, double mean_pressure, double rms_height);

/// Returns the first objection to sliding, if any: to one pressure and density, a tool and a
/// saturation pressure, to lengths that do not fit.
std::optional<Objection> objection(const SlideSettings& settings, const CaseSettings& all,
                                   const Spelling& spelling);

/// Slides the tool of the settings over the surface under their one pressure. With a density, oil
/// is rained on the sheet before and stays on its pixels. `receive` gets each state when it is
/// computed. Throws InputError for invalid settings and surfaces, Interrupted where the observer
/// asks to stop.
SlideResult slide(const topography::Topography& surface, const CaseSettings& settings,
                  const SlideSettings& sliding,
                  const std::function<void(const SlideRecord&)>& receive = {},
                  const Observer& observer = {});

}  // namespace tabor::cases
