#include "tabor/friction/fluid_film.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tabor/core/error.hpp"
#include "tabor/core/loops.hpp"
#include "tabor/core/watch.hpp"
#include "tabor/friction/load_search.hpp"

namespace tabor::friction {
namespace {

/// Deflection in the middle of a square pixel under a uniform pressure, over p a/E*: Love 1929.
const double kPixelCompliance = 4 / std::numbers::pi * std::log(1 + std::sqrt(2.0));
constexpr double kMuch = 0.05;  // a change of the gap, over its mean
constexpr double kNear = 0.1;   // the largest error of a film from which the next one may start
constexpr double kLargestFeltShare = 0.9;  // of the load
constexpr double kLeastSolidShare = 1e-6;  // below it the surfaces are taken to just touch

double rms(const Field& field) {
  const double* value = field.data();
  const double squares = sum_over(field.size(), [=](Index i) { return value[i] * value[i]; });
  return std::sqrt(squares / static_cast<double>(field.size()));
}

double mean(const Field& field) { return sum(field) / static_cast<double>(field.size()); }

void check(const elastic::ElasticOperator& elasticity, const FluidFilmProblem& problem,
           const contact::State& dry) {
  const Grid& grid = elasticity.grid();
  if (!elasticity.drops_mean()) {
    throw InputError("fluid film", "a free half-space", "a periodic one",
                     "the film is solved on a patch that repeats");
  }
  if (!(problem.sliding_speed >= 0 && std::isfinite(problem.sliding_speed))) {
    throw InputError("sliding speed", fmt::format("{} m/s", problem.sliding_speed), "zero or more",
                     "flip the scan to slide the other way");
  }
  if (dry.pressure.rows() != grid.ny || dry.pressure.cols() != grid.nx) {
    throw InputError("fluid film: the dry contact is not on the grid of the elastic operator");
  }
  if (!(problem.tolerance > 0)) {
    throw InputError("tolerance", fmt::format("{}", problem.tolerance),
                     "a positive number such as 1e-3", "");
  }
}

class Solver {
 public:
  Solver(elastic::ElasticOperator& elasticity, const FluidFilmProblem& problem,
         const Observer& observer)
      : elasticity_(elasticity),
        problem_(problem),
        observer_(observer),
        load_(contact::prescribed_pressure(problem.contact, elasticity.grid())),
        roughness_(rms(problem.contact.height - mean(problem.contact.height))),
        felt_(Field::Zero(elasticity.grid().ny, elasticity.grid().nx)),
        deflection_(felt_) {}

  /// Advances `state`, which holds the dry contact, to the shared load.
  void run(FluidFilmState& state) {
    LoadSearch search;
    Convergence& convergence = state.convergence;
    if (observer_) told_ = [&](const Progress& inner) { return tells(inner, convergence); };
    do {
      flow(state);
      if (!convergence.failed() || convergence.iterations >= problem_.max_evaluations) return;
      feel(state);
      if (state.gap_error > kMuch && mean(felt_) < kLargestFeltShare * load_) {
        // The surface is still giving way: the solids carry what the pressure it has felt does not.
        close(std::sqrt(1 - mean(felt_) / load_), state);
      } else if (load_fits(state)) {
        close(position_, state);
      } else {
        const double carried = (state.solid_pressure + state.fluid_pressure) / load_;
        const double next = search.next(position_, std::log(std::max(carried, 1e-300)));
        if (search.met_a_jump()) {
          convergence.status = Status::stalled;
          return;
        }
        close(next, state);
      }
    } while (!convergence.stopped());
  }

 private:
  /// Contacts and films within tell how far the shared load is, not how far they are themselves.
  bool tells(const Progress& inner, const Convergence& convergence) const {
    const bool is_measured = std::isfinite(convergence.certificate);
    return !asks_to_stop(
        observer_, {.stage = inner.stage, .convergence = is_measured ? &convergence : nullptr});
  }

  bool load_fits(const FluidFilmState& state) const {
    return std::abs(state.load_error) <= problem_.tolerance;
  }

  /// The contact at a position of the search, on the surface as the film deforms it.
  void close(double position, FluidFilmState& state) {
    position_ = position;
    const Field height = problem_.contact.height - deflection_;
    state.solid_pressure = position > 0 ? load_ * position * position : 0;
    if (state.solid_pressure > kLeastSolidShare * load_) {
      contact::Problem solids = problem_.contact;
      solids.height = height;
      solids.control = contact::MeanPressure{state.solid_pressure};
      state.contact = contact::solve(elasticity_, solids, contact::Solver::fast, told_);
      if (state.contact.convergence.stopped()) state.convergence.status = Status::stopped;
      state.contact.displacement += deflection_;
      return;
    }
    state.solid_pressure = 0;
    const double lift = std::max(-position, 0.0) * length();
    state.contact.pressure.setZero();
    state.contact.mean_pressure = 0;
    state.contact.displacement = deflection_;
    state.contact.separation = lift + height.maxCoeff();
    state.contact.gap = state.contact.separation - height;
    state.contact.convergence = exact(problem_.contact.tolerance);
  }

  /// Scale of the distance between surfaces that do not touch.
  double length() const { return roughness_ > 0 ? roughness_ : mean(problem_.film); }

  /// The film in the gap of `state`, and what follows from it.
  void flow(FluidFilmState& state) {
    ++state.convergence.iterations;
    // While errors are large, the oil starts from its deposit: where it went must not matter.
    const bool has_guess = state.convergence.certificate < kNear;
    const reynolds::PatchProblem patch = patch_of(state);
    state.film = has_guess ? steady_film(patch, problem_.film, state.film, told_)
                           : steady_film(patch, problem_.film, told_);
    if (state.film.convergence.stopped()) {
      state.convergence.status = Status::stopped;
      return;
    }
    state.fluid_pressure = state.film.mean_pressure;
    state.mean_gap = mean(state.contact.gap.max(0.0));
    state.load_error = (state.solid_pressure + state.fluid_pressure) / load_ - 1;
    state.gap_error = unfelt(state);
    state.pressure_error = mean((state.film.pressure - felt_).abs()) / load_;
    state.viscous_stress = viscous_stress(state);
    // A few pixels of a high pressure may hardly change the gap's rms and yet most of the load.
    state.convergence.certificate =
        std::max({std::abs(state.load_error), state.gap_error, state.pressure_error});
    const bool fits = load_fits(state) && state.gap_error <= problem_.tolerance &&
                      state.pressure_error <= problem_.tolerance;
    if (fits && state.film.convergence.converged() && state.contact.convergence.converged()) {
      state.convergence.status = Status::converged;
    }
  }

  reynolds::PatchProblem patch_of(const FluidFilmState& state) const {
    reynolds::PatchProblem patch;
    patch.grid = elasticity_.grid();
    patch.gap = state.contact.gap;
    patch.entrainment_speed = problem_.sliding_speed / 2;
    patch.viscosity = material::ambient_viscosity(problem_.lubricant.viscosity);
    patch.pressure_resolution = 0.1 * problem_.tolerance * load_;
    if (is_plain()) return patch;
    patch.viscosity_along = patch.viscosity_across = Field(patch.grid.ny, patch.grid.nx);
    for_each(patch.gap.size(), [&](Index i) {
      const double gap = std::max(patch.gap(i), patch.thinnest_film);
      const material::FlowViscosity met = material::flow_viscosity(
          problem_.lubricant.shear, viscosity_at(felt_(i)), problem_.sliding_speed / gap, felt_(i));
      patch.viscosity_along(i) = met.along.value;
      patch.viscosity_across(i) = met.across.value;
    });
    return patch;
  }

  bool is_plain() const {
    return law_of(problem_.lubricant.viscosity) == material::ViscosityLaw::constant &&
           law_of(problem_.lubricant.shear) == material::ShearLaw::newtonian;
  }

  double viscosity_at(double pressure) const {
    return material::viscosity_at(problem_.lubricant.viscosity, pressure).value;
  }

  /// How far the gap is from the one that this pressure makes, over its mean.
  double unfelt(const FluidFilmState& state) {
    if (state.fluid_pressure == 0 && (felt_ == 0).all()) return 0;
    Field moved(felt_.rows(), felt_.cols());
    const Field change = state.film.pressure - felt_;
    elasticity_.apply(change, moved);
    return rms(moved) / state.mean_gap;
  }

  /// The surface gives way to the film's pressure: at once where it is stiff, in part where a
  /// pixel's own deflection would change its gap, and with it the pressure (about as gap^-2), much.
  void feel(const FluidFilmState& state) {
    const double side = std::sqrt(elasticity_.grid().pixel_area());
    caution_ *= state.gap_error > last_gap_error_ ? 2 : 0.7;
    caution_ = std::max(caution_, 0.5);
    last_gap_error_ = state.gap_error;
    const double softness =
        2 * caution_ * kPixelCompliance * side / elasticity_.effective_modulus();
    for_each(felt_.size(), [&](Index i) {
      const double pressure = state.film.pressure(i);
      const double gap = std::max(state.contact.gap(i), 1e-9);
      const double share = 1 / (1 + softness * std::max(pressure, felt_(i)) / gap);
      felt_(i) += std::max(share, 0.05) * (pressure - felt_(i));
    });
    elasticity_.apply(felt_, deflection_);
  }

  /// On the flat: shear of the carried oil, and h/2 dp/dx, whose sum over a patch that repeats is
  /// the power that the driven flow dissipates over the speed.
  double viscous_stress(const FluidFilmState& state) const {
    if (problem_.sliding_speed == 0) return 0;
    const double carried = sum_over(felt_.size(), [&](Index i) {
      const double fill = state.film.fill(i);
      if (!(fill > 0)) return 0.0;
      const double pressure = state.film.pressure(i);
      return fill * material::shear_stress(problem_.lubricant.shear, viscosity_at(pressure),
                                           problem_.sliding_speed / state.contact.gap(i), pressure)
                        .value;
    });
    return carried / static_cast<double>(felt_.size()) +
           state.film.dissipation / problem_.sliding_speed;
  }

  elastic::ElasticOperator& elasticity_;
  const FluidFilmProblem& problem_;
  const Observer& observer_;
  Observer told_;  // what contacts and films are given in its place
  double load_;
  double roughness_;
  Field felt_;        // the fluid's pressure that the surface has given way to [Pa]
  Field deflection_;  // by it [m]
  double position_ = 1;
  double caution_ = 1;
  double last_gap_error_ = std::numeric_limits<double>::infinity();
};

}  // namespace

FluidFilmState solve_fluid_film(elastic::ElasticOperator& elasticity,
                                const FluidFilmProblem& problem, const contact::State& dry,
                                const Observer& observer) {
  check(elasticity, problem, dry);
  FluidFilmState state;
  state.contact = dry;
  state.solid_pressure = contact::prescribed_pressure(problem.contact, elasticity.grid());
  state.convergence.tolerance = problem.tolerance;
  const auto work = [&](Watch&) { Solver(elasticity, problem, observer).run(state); };
  if (!finishes(observer, "film", work)) state.convergence.status = Status::stopped;
  return state;
}

}  // namespace tabor::friction
