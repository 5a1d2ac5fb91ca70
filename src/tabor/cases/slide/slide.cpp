#include "tabor/cases/slide/slide.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tabor/cases/slide/sheet.hpp"
#include "tabor/cases/slide/slide_runner.hpp"
#include "tabor/cases/warnings.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/units.hpp"
#include "tabor/core/watch.hpp"
#include "tabor/friction/wet_contact.hpp"
#include "tabor/metrology/areal/parameters.hpp"
#include "tabor/sliding/squeezed.hpp"

namespace tabor::cases {
namespace {

constexpr double kUsualStates = 20;     // of one distance
constexpr double kCheckpointCost = 10;  // times as long computing as writing, at least

}  // namespace

SlideRunner::SlideRunner(const topography::Topography& surface, const CaseSettings& settings,
                         const SlideSettings& sliding, const SlideRun& wanted,
                         const Observer& observer)
    : surface_(surface),
      settings_(settings),
      sliding_(sliding),
      wanted_(wanted),
      observer_(observer),
      elasticity_(make_operator(settings.contact, surface.grid)),
      tool_(make_tool(settings.contact.tool, surface.grid, observer)),
      contact_(settings.contact),
      distance_(distance_of(sliding, tool_, dx())),
      film_(rain()),
      slider_(*elasticity_, problem_of()),
      steadiness_(tool_.grid.lx) {
  result_.after = surface;
  result_.warnings = of_surface(surface);
  add(of_tool(surface, tool_), result_.warnings);
  if (film_) add(film_->warnings, result_.warnings);
  result_.references = references_of(settings, sliding);
  if (has_squeezed()) squeezed_ = film_->film.thickness;
  if (!wanted.checkpoint.empty()) {
    checkpoint_.emplace(wanted.checkpoint, identity_of(surface, settings, sliding, tool_));
  }
}

sliding::Problem SlideRunner::problem_of() const {
  sliding::Problem problem{.sheet = surface_.height,
                           .tool = tool_.height,
                           .place = places_of(settings_.contact.tool, tool_).front(),
                           .mean_pressure = pressure(),
                           .saturation_pressure = settings_.contact.pressure_cap(),
                           .hardening = sliding_.hardening.value_or(0),
                           .displaced = sliding_.displaced,
                           .reach = std::max(sliding_.reach, 2 * dx()),
                           .wear_coefficient = sliding_.wear_coefficient.value_or(0),
                           .tolerance = settings_.contact.tolerance};
  if (film_ && settings_.trapped.is_asked()) {
    problem.oil = sliding::TrappedOil{.film = film_->film.thickness,
                                      .bulk_modulus = settings_.trapped.bulk_modulus,
                                      .periodic = settings_.contact.is_periodic()};
  }
  return problem;
}

std::optional<FilmRecord> SlideRunner::rain() const {
  if (settings_.film.lubricant_densities.empty()) return std::nullopt;
  return film_state(surface_, settings_.film, observer_).front();
}

/// Adds up a step, and lets its contact squeeze oil out.
void SlideRunner::take(const sliding::Ploughing& step) {
  since_ += step;
  all_ += step;
  converged_ = converged_ && slider_.state().convergence.converged() &&
               slider_.displacing().convergence.converged();
  if (step.distance > 0) ++result_.steps;
  if (sliding_.hardening) contact_.saturation_pressure = slider_.highest_cap();
  after_contact(step);
}

/// Squeezes oil out, and follows how steady sliding is.
void SlideRunner::after_contact(const sliding::Ploughing& step) {
  if (has_squeezed()) before_squeezing_ = std::move(squeezed_);
  if (sliding_.until_steady && step.distance > 0) {
    steadiness_.add(all_.distance - step.distance,
                    {.distance = step.distance,
                     .moved = step.moved,
                     .friction = friction_now(step) * step.distance});
  }
  if (!has_squeezed()) return;
  const contact::TrappedState* trapped = slider_.trapped();
  Mask sealed;
  if (trapped != nullptr) sealed = trapped->liquid_pressure > 0;
  sliding::Squeezed squeezed =
      sliding::squeeze(before_squeezing_, slider_.displacing().gap,
                       trapped != nullptr ? &sealed : nullptr, surface_.grid, settings_.film.edge);
  squeezed_ = std::move(squeezed.film);
  away_ += squeezed.without_space + squeezed.lost;
  if (traps_squeezed()) slider_.lay_oil(squeezed_);
}

/// Friction of the last step, of oil that stays where it is.
double SlideRunner::friction_now(const sliding::Ploughing& step) {
  SlideRecord one;
  one.contact = slider_.summary();
  const double ploughing = step.friction(step.work, pressure());
  one.friction_dry = dry_friction_of(one) + ploughing;
  if (!film_) return one.friction_dry;
  add_oil(one, ploughing);
  return has_kept() ? one.friction_lubricated : one.friction_squeezed;
}

void SlideRunner::add_oil(SlideRecord& one, double ploughing) {
  contact::Summary solids;
  if (slider_.trapped() != nullptr) solids = slider_.summary_of_solids();
  const auto share_under = [&](const Field& film) {
    return friction::lubricated_share(slider_.touching(), film, settings_.friction.dry_below);
  };
  const auto friction_with = [&](double share, std::optional<TrappedFriction>& trapped) {
    if (slider_.trapped() == nullptr) {
      return estimate_of(one.contact, share, contact_, settings_.friction).friction_lubricated +
             ploughing;
    }
    with_oil_.solids = solids;
    with_oil_.liquid = slider_.trapped()->liquid;
    with_oil_.lubricated_share = share;
    with_oil_.convergence = slider_.trapped()->contact.convergence;
    trapped = trapped_friction(with_oil_, pressure(), contact_, settings_.friction);
    return trapped->friction_solid + trapped->friction_boundary + ploughing;
  };
  if (has_kept()) {
    one.lubricated_share = share_under(film_->film.thickness);
    one.friction_lubricated = friction_with(one.lubricated_share, one.trapped);
  }
  if (!has_squeezed()) return;
  std::optional<TrappedFriction> unused;
  one.squeezed_share = share_under(before_squeezing_);
  one.friction_squeezed = friction_with(one.squeezed_share, has_kept() ? unused : one.trapped);
}

SlideRecord SlideRunner::record() {
  SlideRecord one;
  one.distance = all_.distance;
  one.contact = slider_.summary();
  one.friction_ploughing = since_.friction(since_.work, pressure());
  one.friction_ploughing_lower = since_.friction(since_.lower, pressure());
  one.friction_ploughing_upper = since_.friction(since_.upper, pressure());
  one.step_certificate = since_.certificate(pressure());
  const double ploughing = since_.distance > 0 ? one.friction_ploughing : 0;
  one.friction_dry = dry_friction_of(one) + ploughing;
  one.highest_saturation_pressure = contact_.saturation_pressure.value_or(kNoValue);
  if (film_) {
    one.mean_film = film_->mean_film_left();
    add_oil(one, ploughing);
  }
  if (has_squeezed()) {
    one.squeezed_film = squeezed_.mean();
    one.squeezed_away = away_;
  }
  one.moved_volume = all_.moved;
  one.lost_volume = all_.lost;
  one.worn_volume = all_.worn;
  one.certificate = slider_.displacing().convergence.certificate;
  one.converged = converged_;
  return one;
}

/// Measures the sheet as it is now, and its spectra.
void SlideRunner::measure_sheet(SlideRecord& one) {
  result_.after.height = slider_.sheet();
  measure(result_.after.height, one);
  result_.spectra.push_back(spectra_of_sheet(result_.after));
}

/// True for the first and the last state, and for the one that a distance of the settings is
/// nearest to.
bool SlideRunner::has_maps() const {
  if (!wanted_.wants_maps) return false;
  if (result_.steps == 0 || ends()) return true;
  const double half = 0.5 * step();
  return std::any_of(sliding_.maps_at.begin(), sliding_.maps_at.end(), [&](double place) {
    return std::abs(place - all_.distance) <= half * (1 + 1e-9);
  });
}

SlideMaps SlideRunner::maps() const {
  const contact::State& contact = slider_.displacing();
  SlideMaps maps;
  maps.sheet = slider_.sheet();
  maps.pressure = contact.pressure;
  maps.gap = contact.gap;
  maps.state = state_map(slider_.touching(), contact.pressure, slider_.caps());
  maps.saturation_pressure = slider_.caps_map();
  if (has_squeezed()) maps.squeezed = before_squeezing_;
  if (slider_.trapped() != nullptr) maps.liquid_pressure = slider_.trapped()->liquid_pressure;
  return maps;
}

void SlideRunner::hand_over(std::size_t state, const SlideMaps* maps) const {
  if (!wanted_.receive) return;
  wanted_.receive({.numbers = result_.states[state],
                   .spectra = result_.spectra[state],
                   .maps = maps,
                   .film = has_kept() ? &film_->film.thickness : nullptr});
}

/// Records the state that is reached.
void SlideRunner::keep_state() {
  SlideRecord one = record();
  measure_sheet(one);
  result_.states.push_back(one);
  since_ = {};
  const std::size_t state = result_.states.size() - 1;
  if (!has_maps()) return hand_over(state, nullptr);
  const SlideMaps kept = maps();
  with_maps_.push_back(state);
  if (checkpoint_ && !ends()) checkpoint_->save_maps(state, kept);
  hand_over(state, &kept);
}

bool SlideRunner::ends() const {
  if (result_.interrupted) return true;
  return pixels_ > 0 && (result_.steps >= planned_steps() || result_.steady.value_or(false));
}

/// Goes on from the checkpoint, if there is one.
bool SlideRunner::goes_on() {
  std::optional<ReachedSlide> reached;
  if (checkpoint_) reached = checkpoint_->load();
  if (!reached) return false;
  slider_.go_on_from(std::move(reached->slider));
  since_ = reached->since;
  all_ = reached->all;
  result_.steps = reached->steps;
  pixels_ = static_cast<Index>(reached->pixels);
  converged_ = reached->converged;
  squeezed_ = std::move(reached->squeezed);
  if (traps_squeezed()) slider_.lay_oil(squeezed_);
  away_ = reached->away;
  steadiness_ = Steadiness(tool_.grid.lx, std::move(reached->periods));
  result_.states = std::move(reached->states);
  result_.spectra = std::move(reached->spectra);
  with_maps_ = std::move(reached->with_maps);
  for (std::size_t state = 0; state < result_.states.size(); ++state) {
    const bool has = std::find(with_maps_.begin(), with_maps_.end(), state) != with_maps_.end();
    const SlideMaps kept = has ? checkpoint_->load_maps(state) : SlideMaps{};
    hand_over(state, has ? &kept : nullptr);
  }
  return true;
}

void SlideRunner::save() {
  if (!checkpoint_) return;
  const double begin = watch_.seconds();
  checkpoint_->save({.slider = slider_.reached(),
                     .since = since_,
                     .all = all_,
                     .steps = result_.steps,
                     .pixels = static_cast<std::uint64_t>(pixels_),
                     .converged = converged_,
                     .squeezed = squeezed_,
                     .away = away_,
                     .periods = steadiness_.periods(),
                     .states = result_.states,
                     .spectra = result_.spectra,
                     .with_maps = with_maps_});
  saved_at_ = watch_.seconds();
  saving_took_ = saved_at_ - begin;
}

void SlideRunner::save_if_due() {
  const double period = std::max(wanted_.checkpoint_period, kCheckpointCost * saving_took_);
  if (watch_.seconds() - saved_at_ >= period) save();
}

/// Takes the first step: that of the settings, else a quarter of the length of the contact patches,
/// halved until the step certificate is small.
void SlideRunner::find_step() {
  const sliding::Slider::Reached pressed = slider_.reached();
  auto pixels = static_cast<Index>(std::llround(
      sliding_.step ? *sliding_.step / dx() : 0.25 * mean_patch_length(slider_.touching())));
  pixels = std::clamp<Index>(pixels, 1, pixels_to_slide());
  while (true) {
    const double begin = watch_.seconds();
    const sliding::Ploughing step = slider_.advance(pixels, observer_);
    const bool is_fine = !(step.certificate(pressure()) > kFineStep);
    if (sliding_.step || is_fine || pixels == 1) {
      pixels_ = pixels;
      take(step);
      return tell_plan(watch_.seconds() - begin);
    }
    slider_.go_on_from(pressed);
    pixels /= 2;
  }
}

void SlideRunner::tell_plan(double seconds_of_a_step) {
  is_told_ = true;
  if (!wanted_.plan) return;
  const std::uint64_t n_left = planned_steps() - std::min(planned_steps(), result_.steps);
  wanted_.plan({.steps = planned_steps(),
                .steps_left = n_left,
                .step = step(),
                .seconds = seconds_of_a_step * static_cast<double>(n_left),
                .gone_before = result_.steps > 1 ? all_.distance : 0});
}

/// Presses, and takes the first step.
void SlideRunner::begin() {
  const sliding::Ploughing pressed = slider_.press(observer_);
  take(pressed);
  keep_state();
  find_step();
}

/// Distance of the state after the last one [m].
double SlideRunner::next_state() const {
  const double every = sliding_.every.value_or(distance_ / kUsualStates);
  const double half = 0.5 * step();
  const double last = result_.states.back().distance + half;
  double next = every * (std::floor(last / every) + 1);
  for (const double place : sliding_.maps_at) {
    if (place > last) next = std::min(next, place);
  }
  return next;
}

/// One more step. A step that is stopped has changed nothing: it is taken again when the run goes
/// on.
void SlideRunner::advance() {
  try {
    advance_one();
  } catch (const Interrupted&) {
    save();
    if (checkpoint_ || !wanted_.ends_when_stopped) throw;
    result_.interrupted = true;
    return;
  }
  look();
}

void SlideRunner::advance_one() {
  const std::string stage =
      fmt::format("slide, {} of {}", format_si(all_.distance, "m"), format_si(distance_, "m"));
  const double share = static_cast<double>(result_.steps) / static_cast<double>(planned_steps());
  if (asks_to_stop(observer_, {.stage = stage, .fraction = share, .whole = share})) {
    throw Interrupted();
  }
  const Observer asked = [this](const Progress&) { return !asks_to_stop(observer_, {}); };
  const double begin = watch_.seconds();
  const sliding::Ploughing step = slider_.advance(pixels_of_next_step(), asked);
  take(step);
  if (!is_told_) tell_plan(watch_.seconds() - begin);
}

/// Warns of the way, and of the last contact on it.
void SlideRunner::warn() {
  add(of_sliding(all_, pressure(), metrology::rms_height(surface_), tool_.grid.lx, result_.steady),
      result_.warnings);
  if (!converged_) {
    result_.warnings.push_back({"not-converged", "Some contacts along the way are NOT CONVERGED",
                                slider_.displacing().convergence.certificate});
  }
  const SlideRecord& last = result_.states.back();
  ContactRecord contact;
  contact.summary = last.contact;
  const double wet = has_kept() ? last.lubricated_share : has_squeezed() ? last.squeezed_share : 0;
  if (slider_.state().convergence.converged() && !result_.interrupted) {
    add(of_contact(surface_, contact_, slider_.state(), last.contact), result_.warnings);
  }
  dry_friction(contact, wet, 0, contact_, settings_.friction, result_.warnings);
  if (last.trapped) add(of_trapped(with_oil_), result_.warnings);
  if (film_) add(of_film_in_gap(film_->mean_film_left(), last.contact.mean_gap), result_.warnings);
}

/// Keeps a state where one is due, and tells whether sliding has become steady.
void SlideRunner::look() {
  if (sliding_.until_steady) result_.steady = steadiness_.is_steady();
  const double half = 0.5 * step();
  if (ends() || all_.distance >= next_state() - half) keep_state();
}

SlideResult SlideRunner::run() {
  result_.before = spectra_of_sheet(surface_);
  if (sliding_.until_steady) result_.steady = false;
  if (!goes_on()) {
    begin();
    look();
  }
  const Unwatched until_the_end;  // a step asks the observer itself, and ends whole or not at all
  while (!ends()) {
    if (checkpoint_) save_if_due();
    advance();
  }
  result_.step = step();
  result_.tool_length = tool_.grid.lx;
  result_.tool_rms_height = tool_.rms_height;
  result_.after.height = slider_.sheet();
  result_.after.history.push_back(
      fmt::format("slide: {} under {} in {} steps, {:.4g} m moved", format_si(all_.distance, "m"),
                  format_si(pressure(), "Pa"), result_.steps, all_.moved));
  result_.converged = converged_;
  warn();
  if (checkpoint_) checkpoint_->remove();
  return std::move(result_);
}

SlideResult slide(const topography::Topography& surface, const CaseSettings& settings,
                  const SlideSettings& sliding, const SlideRun& run, const Observer& observer) {
  return SlideRunner(surface, settings, sliding, run, observer).run();
}

}  // namespace tabor::cases
