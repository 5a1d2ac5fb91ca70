#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "tabor/cases/slide/checkpoint.hpp"
#include "tabor/cases/slide/slide.hpp"
#include "tabor/cases/slide/steadiness.hpp"
#include "tabor/cases/states.hpp"
#include "tabor/cases/tool.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/sliding/slider.hpp"

// Slides a tool over a sheet, state by state: what slide() makes and forgets.
namespace tabor::cases {

/// What slides, and the numbers of its states.
class SlideRunner {
 public:
  SlideRunner(const topography::Topography& surface, const CaseSettings& settings,
              const SlideSettings& sliding, const SlideRun& wanted, const Observer& observer);

  SlideResult run();

 private:
  sliding::Problem problem_of() const;
  std::optional<FilmRecord> rain() const;
  bool has_kept() const { return film_ && sliding_.liquid != SlidingOil::squeezed; }
  bool has_squeezed() const { return film_ && sliding_.liquid != SlidingOil::kept; }
  /// True where what contacts leave of the oil may be trapped, not what was rained.
  bool traps_squeezed() const { return film_ && !has_kept() && settings_.trapped.is_asked(); }

  bool goes_on();
  void begin();
  void find_step();
  void take(const sliding::Ploughing& step);
  void after_contact(const sliding::Ploughing& step);
  void keep_state();
  bool ends() const;
  void save();
  void save_if_due();
  void advance();
  void advance_one();
  void look();
  double next_state() const;
  void tell_plan(double seconds_of_a_step);

  SlideRecord record();
  double dry_friction_of(const SlideRecord& one) const {
    return estimate_of(one.contact, 0, contact_, settings_.friction).friction_dry;
  }
  void add_oil(SlideRecord& one, double ploughing);
  void measure_sheet(SlideRecord& one);
  double friction_now(const sliding::Ploughing& step);
  bool has_maps() const;
  SlideMaps maps() const;
  void hand_over(std::size_t state, const SlideMaps* maps) const;
  void warn();

  double dx() const { return surface_.grid.dx(); }
  double step() const { return static_cast<double>(pixels_) * dx(); }
  double pressure() const { return settings_.mean_pressures.front(); }
  /// The distance in whole pixels, of which the last step may be shorter than the others.
  Index pixels_to_slide() const { return static_cast<Index>(std::llround(distance_ / dx())); }
  std::uint64_t planned_steps() const {
    return static_cast<std::uint64_t>((pixels_to_slide() + pixels_ - 1) / pixels_);
  }
  Index pixels_of_next_step() const {
    const auto slid = static_cast<Index>(std::llround(all_.distance / dx()));
    return std::clamp<Index>(pixels_to_slide() - slid, 1, pixels_);
  }

  const topography::Topography& surface_;
  const CaseSettings& settings_;
  const SlideSettings& sliding_;
  const SlideRun& wanted_;
  const Observer& observer_;
  std::unique_ptr<elastic::ElasticOperator> elasticity_;
  Tool tool_;
  ContactSettings contact_;  // of the last contact, with the highest p_sat of its pixels
  double distance_;          // at most [m]
  std::optional<FilmRecord> film_;
  sliding::Slider slider_;
  Steadiness steadiness_;
  std::optional<SlideCheckpoint> checkpoint_;
  Index pixels_ = 0;          // of a step
  sliding::Ploughing since_;  // the last state
  sliding::Ploughing all_;
  Field squeezed_;          // oil that contacts squeeze out, after the last of them [m]
  Field before_squeezing_;  // the same as the last contact met it [m]
  double away_ = 0;         // of it, that found no space [m]
  TrappedRecord with_oil_;  // numbers of the last contact with trapped oil
  bool converged_ = true;
  bool is_told_ = false;  // how long it takes
  std::vector<std::uint64_t> with_maps_;
  Stopwatch watch_;
  double saved_at_ = 0;     // [s]
  double saving_took_ = 0;  // [s]
  SlideResult result_;
};

}  // namespace tabor::cases
