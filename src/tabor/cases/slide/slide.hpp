#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tabor/cases/records.hpp"
#include "tabor/cases/settings.hpp"
#include "tabor/cases/tool.hpp"
#include "tabor/core/names.hpp"
#include "tabor/sliding/slider.hpp"
#include "tabor/topography/topography.hpp"

// Slides a rough tool over a sheet and reports friction, ploughing and the sheet along the way.
namespace tabor::cases {

/// Fate of the oil on a sheet that a tool slides over.
enum class SlidingOil {
  both,     ///< oil that stays on its pixels and oil that is squeezed out: two bounds of friction
  kept,     ///< it stays on its pixels: the lower bound alone
  squeezed  ///< contacts squeeze it out: the upper bound alone; what is left may be trapped
};
inline constexpr auto kSlidingOils = names<SlidingOil>("both", "kept", "squeezed");

/// Step certificate of a step that is short enough.
inline constexpr double kFineStep = 0.3;
/// Passes of the tool after which sliding that is to become steady ends all the same.
inline constexpr double kMostPasses = 20;

/// Settings of sliding beside those of contact, film and friction.
struct SlideSettings {
  std::optional<double> distance = {};  ///< of sliding [m]; absent with until_steady: at most
                                        ///< kMostPasses lengths of the tool
  std::optional<double> step = {};      ///< [m], whole pixels; absent: as the step certificate asks
  std::optional<double> every = {};     ///< distance between states [m]; absent: a twentieth
  sliding::Displaced displaced = sliding::Displaced::near;
  double reach = 2e-6;                          ///< of Displaced::near [m]
  std::optional<double> wear_coefficient = {};  ///< k of Archard [1/Pa]; absent: no wear
  std::optional<double> hardening = {};  ///< rise of p_sat over the depth that a pixel has yielded
                                         ///< [Pa/m]; absent: none
  SlidingOil liquid = SlidingOil::both;
  bool until_steady = false;         ///< ends before the distance, once nothing changes any more
  std::vector<double> maps_at = {};  ///< distances whose maps are stored, beside both ends [m]
};
const Parameters<SlideSettings>& slide_parameters();

/// State of a sheet under a tool after some distance. Ploughing is a mean since the state before.
struct SlideRecord {
  double distance = 0;  ///< [m]
  contact::Summary contact;
  double highest_saturation_pressure = kNoValue;  ///< of a pixel [Pa]
  double mean_film = kNoValue;                    ///< of the oil that was rained [m]
  double friction_dry = kNoValue;                 ///< with ploughing
  double friction_ploughing = kNoValue;
  double friction_ploughing_lower = kNoValue;
  double friction_ploughing_upper = kNoValue;
  double step_certificate = kNoValue;
  double lubricated_share = kNoValue;     ///< where the oil stays on its pixels
  double friction_lubricated = kNoValue;  ///< the same, with ploughing: a lower bound
  double squeezed_share = kNoValue;       ///< lubricated share where contacts squeeze the oil out
  double friction_squeezed = kNoValue;    ///< the same, with ploughing: an upper bound
  double squeezed_film = kNoValue;        ///< mean of that oil on the sheet [m]
  double squeezed_away = kNoValue;        ///< mean of the oil that found no space there [m]
  double moved_volume = 0;                ///< over the nominal area, so far [m]
  double lost_volume = 0;                 ///< of it, that left the sheet [m]
  double worn_volume = 0;                 ///< that wear took off beside it [m]
  double rms_height = 0;                  ///< Sq of the sheet [m]
  double mean_roughness = 0;              ///< Sa [m]
  double core_height = 0;                 ///< Sk [m]
  double peak_height = 0;                 ///< Spk [m]
  double dale_height = 0;                 ///< Svk [m]
  double certificate = kNoValue;
  bool converged = false;                       ///< this contact and all before
  std::optional<TrappedFriction> trapped = {};  ///< absent where trapped oil carries nothing
};

/// Returns the distance in force, at most [m], over pixels of this length. Throws InputError for
/// one below a pixel, or out of all proportion, and for steps below a pixel.
double distance_of(const SlideSettings& sliding, const Tool& tool, double dx);

/// Parts of a slide that not every one has, and their columns.
struct SlideParts {
  bool kept = true;      ///< oil stays on its pixels
  bool squeezed = true;  ///< oil is squeezed out
  bool trapped = true;   ///< trapped oil carries load
  bool lost = true;      ///< material leaves the sheet
  bool worn = true;
  bool hardened = true;  ///< where the sheet yields its saturation pressure rises
};
SlideParts parts_of(const CaseSettings& settings, const SlideSettings& sliding);
Columns<SlideRecord> slide_columns(const SlideParts& parts = {});

/// Power spectral densities C1D of a sheet along x and y.
struct SheetSpectra {
  std::vector<double> q_x, density_x;  ///< [rad/m], [m^3]
  std::vector<double> q_y, density_y;
};

/// Maps of a state.
struct SlideMaps {
  Field sheet;     ///< after the contact, unloaded [m]
  Field pressure;  ///< [Pa]
  Field gap;       ///< [m]
  ByteMap state;   ///< 0 no contact, 1 contact below saturation, 2 saturated
  Field squeezed;  ///< oil as the contact meets it, where contacts squeeze it out [m]; or empty
  Field liquid_pressure;      ///< of trapped oil [Pa]; or empty
  Field saturation_pressure;  ///< of each pixel, where the sheet hardens [Pa]; or empty
};

/// A state as it is computed, or read again where a run goes on.
struct SlideState {
  const SlideRecord& numbers;
  const SheetSpectra& spectra;
  const SlideMaps* maps = nullptr;  ///< null where none are stored
  const Field* film = nullptr;      ///< oil that stays on its pixels [m]; null without
};

/// What is known of a run once its first step is made.
struct SlidePlan {
  std::uint64_t steps = 0;       ///< of the whole run
  std::uint64_t steps_left = 0;  ///< of them
  double step = 0;               ///< [m]
  double seconds = 0;            ///< that the steps are expected to take, from the first
  double gone_before = 0;        ///< distance of the run that this one goes on from [m]
};

/// What a caller wants of a run.
struct SlideRun {
  std::function<void(const SlidePlan&)> plan = {};      ///< told before the long part
  std::function<void(const SlideState&)> receive = {};  ///< gets each state
  bool wants_maps = false;
  /// Folder that keeps the run while it lasts, so that a killed one goes on; empty: none.
  std::filesystem::path checkpoint = {};
  double checkpoint_period = 10;  ///< seconds between two of them, at least
  /// A run that the observer stops ends with its last state, in place of throwing Interrupted, if
  /// it has one and no checkpoint.
  bool ends_when_stopped = false;
};

/// A sheet before and after sliding.
struct SlideResult {
  double step = 0;             ///< that was taken [m]
  std::uint64_t steps = 0;     ///< so many
  double tool_length = 0;      ///< period of the tool along x [m]
  double tool_rms_height = 0;  ///< [m]
  std::vector<SlideRecord> states;
  SheetSpectra before;                ///< spectra of the sheet before
  std::vector<SheetSpectra> spectra;  ///< of each state
  topography::Topography after;       ///< the sheet, unloaded
  std::optional<bool> steady = {};    ///< where it was asked for
  Warnings warnings;
  std::vector<std::string> references;
  bool converged = false;
  bool interrupted = false;  ///< the observer ended it
};

/// Warns of steps that are too long for the tool, of a sheet that is worn off by more than its
/// roughness bears, of a tool that has passed too often, and of sliding that is not steady where it
/// was to be. `rms_height` [m]: of the sheet before.
Warnings of_sliding(const sliding::Ploughing& all, double mean_pressure, double rms_height,
                    double tool_length, std::optional<bool> steady = {});

/// Returns the first objection to sliding, if any: to one pressure and density, a tool and what
/// changes the sheet, to lengths that do not fit.
std::optional<Objection> objection(const SlideSettings& settings, const CaseSettings& all,
                                   const Spelling& spelling);

/// Returns what to cite, as keys of references.bib.
std::vector<std::string> references_of(const CaseSettings& settings, const SlideSettings& sliding);

/// Slides the tool of the settings over the surface under their one pressure. With a density, oil
/// is rained on the sheet before. Throws InputError for invalid settings and surfaces, and for the
/// checkpoint of another run; Interrupted where the observer asks to stop.
SlideResult slide(const topography::Topography& surface, const CaseSettings& settings,
                  const SlideSettings& sliding, const SlideRun& run = {},
                  const Observer& observer = {});

}  // namespace tabor::cases
