#include "tabor/ehl/impact/impact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tabor/core/checks.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/units.hpp"
#include "tabor/core/watch.hpp"
#include "tabor/ehl/film.hpp"
#include "tabor/ehl/impact/approach.hpp"
#include "tabor/ehl/impact/measures.hpp"
#include "tabor/ehl/plain.hpp"
#include "tabor/elastic/axisymmetric.hpp"
#include "tabor/reference/hertz.hpp"
#include "tabor/reference/impact.hpp"

namespace tabor::ehl {

namespace {

constexpr double kFirstStep = 1.0 / 64;  // of the nominal step
constexpr double kShortestStep = 1e-6;   // of the nominal step
constexpr double kGrowth = 1.5;          // of the step, after one that worked
constexpr double kChange = 3e-4;         // of the pressure against its trend, per step
constexpr double kLongestStep = 8;
constexpr double kNoForce = 1e-4;     // of the maximum: the impact is over
constexpr double kNoPressure = 1e-9;  // of the largest
constexpr double kNoSpeed = 1e-3;     // of the speed of approach: the ball has stopped
constexpr int kStepsPerImpact = 400;  // of a dry ball
// A time step above this share of the dry impact changes force and film by half a percent and more.
constexpr double kLongStep = 0.04;
constexpr double kWideDomain = 2;         // dry contact radii: less is warned of
constexpr double kLongestContacts = 100;  // dry contact times until we give up waiting

reference::DryImpact dry_impact(const ImpactProblem& problem) {
  return reference::hertz_impact(problem.radius, problem.effective_modulus, problem.mass,
                                 problem.speed);
}

void check_layer(const ImpactProblem& problem, double dry_radius) {
  const double wet = std::sqrt(2 * problem.radius * problem.layer);
  if (wet > dry_radius) return;
  throw InputError(
      "layer",
      fmt::format("{}, in which the ball is wet to a radius of {}", format_si(problem.layer, "m"),
                  format_si(wet, "m")),
      fmt::format("a radius above {}, that of the dry contact", format_si(dry_radius, "m")),
      "give a thicker layer or a slower ball, because such a thin layer is squeezed out");
}

void check_domain(double domain_radius, double dry_radius) {
  if (domain_radius > dry_radius) return;
  throw InputError(
      "domain of the film", format_si(domain_radius, "m"),
      fmt::format("more than the radius of the dry contact, {}", format_si(dry_radius, "m")),
      "give a larger domain, a thicker layer or a slower ball");
}

void check(const ImpactProblem& problem) {
  check_positive("radius of the ball", problem.radius, "m");
  check_positive("mass of the ball", problem.mass, "kg");
  check_positive("speed of the ball", problem.speed, "m/s");
  check_positive("effective modulus", problem.effective_modulus, "Pa");
  check_positive("layer", problem.layer, "m");
  if (problem.nodes < 10) {
    throw InputError("nodes", fmt::format("{}", problem.nodes), "10 or more", "");
  }
  const reference::DryImpact dry = dry_impact(problem);
  check_layer(problem, dry.max_radius);
  material::check_pressure(problem.lubricant, dry.max_pressure);
}

/// Time marching of one impact.
class Impact {
 public:
  Impact(const ImpactProblem& problem, const Observer& observer, bool keeps_factors)
      : problem_(problem),
        observer_(observer),
        keeps_factors_(keeps_factors),
        dry_(dry_impact(problem)) {
    nominal_step_ = problem.time_step > 0 ? problem.time_step : dry_.contact_time / kStepsPerImpact;
    result_.time_step = nominal_step_;
    result_.convergence = exact(kBallTolerance);
  }

  void solve() {
    BallState state = start();
    if (result_.end != ImpactEnd::sticks) march(std::move(state));
  }

  ImpactResult finished(bool stopped) {
    if (stopped) result_.convergence.status = Status::stopped;
    if (result_.history.empty()) record_touch();
    measure(problem_, result_);
    require_film();
    add_warnings();
    return std::move(result_);
  }

 private:
  /// The rigid stage, if there is one, and the film it leaves.
  BallState start() {
    BallState state;
    state.separation = problem_.layer;
    state.speed = -problem_.speed;
    if (problem_.start == ImpactStart::rigid) {
      const std::vector<Approach> path = rigid_approach(problem_);
      for (const Approach& at : path) record_rigid(at);
      state.separation = path.back().separation;
      state.speed = path.back().speed;
      state.time = path.back().time;
      if (state.speed == 0) {
        stick(fmt::format("the ball stopped {} above the flat before anything deformed",
                          format_si(state.separation, "m")));
        return state;
      }
    }
    result_.full_start_time = state.time;
    make_film(state.separation);
    state.pressure.resize(film_.grid.n_cells());
    for (Index i = 0; i < state.pressure.size(); ++i) {
      state.pressure[i] = problem_.start == ImpactStart::full
                              ? 0
                              : rigid_squeeze_pressure(problem_, state.separation, state.speed,
                                                       film_.grid.node[i + 1]);
    }
    state = completed(film_, std::move(state));
    if (problem_.start == ImpactStart::rigid) {
      state.separation -= state.film[0] - state.separation;
      state = completed(film_, std::move(state));
    }
    return state;
  }

  /// All that is wet, unless the problem says otherwise.
  double domain_radius(double separation) const {
    if (problem_.domain_radius > 0) return problem_.domain_radius;
    const double depth =
        problem_.start == ImpactStart::full ? problem_.layer : problem_.layer - separation;
    return std::sqrt(2 * problem_.radius * depth);
  }

  void make_film(double separation) {
    const double radius = domain_radius(separation);
    check_domain(radius, dry_.max_radius);
    result_.domain_radius = radius;
    film_.grid = reynolds::disc_grid(radius, problem_.nodes);
    result_.radius = film_.grid.node.tail(problem_.nodes + 1);
    film_.shape = result_.radius.square() / (2 * problem_.radius);
    film_.compliance = elastic::AxisymmetricHalfSpace(result_.radius, problem_.effective_modulus)
                           .matrix()
                           .leftCols(problem_.nodes);
    film_.lubricant = problem_.lubricant;
    film_.mass = problem_.mass;
    film_.gravity = problem_.gravity;
    film_.length_scale = problem_.layer;
    film_.pressure_scale = dry_.max_pressure;
  }

  void march(BallState now) {
    BallStepper stepper(film_, !keeps_factors_);
    std::optional<BallState> before;
    double step = kFirstStep * nominal_step_;
    record(now);
    while (!is_over(now)) {
      std::optional<BallState> next = stepper.step(now, before ? &*before : nullptr, step);
      if (!next) {
        ++result_.n_cut_steps;
        step /= 2;
        if (step >= kShortestStep * nominal_step_) continue;
        result_.convergence.status = Status::stalled;
        result_.reason = fmt::format("no step converged after {}", format_si(now.time, "s"));
        break;
      }
      ++result_.n_steps;
      count(stepper);
      before = std::move(now);
      now = std::move(*next);
      keep_profiles(*before, now);
      record(now);
      report_progress(observer_, "impact", std::numeric_limits<double>::quiet_NaN());
      step = next_step(step, stepper.prediction_error());
    }
    count(stepper);
  }

  /// What the steps so far have cost and proved.
  void count(const BallStepper& stepper) {
    result_.count = stepper.count();
    Convergence& convergence = result_.convergence;
    convergence.iterations = result_.count.newton_iterations;
    convergence.operator_applications = result_.count.n_products;
    convergence.certificate = std::max(convergence.certificate, stepper.error());
  }

  /// Longer steps where the pressure follows its trend, never shorter than the nominal step for not
  /// doing so: that one is the user's choice.
  double next_step(double step, double prediction_error) const {
    const double wanted =
        step * std::clamp(std::sqrt(kChange / prediction_error), 1 / kGrowth, kGrowth);
    return std::clamp(wanted, std::min(kGrowth * step, nominal_step_),
                      kLongestStep * nominal_step_);
  }

  bool is_over(const BallState& now) {
    highest_force_ = std::max(highest_force_, now.force);
    const bool carries_nothing = highest_force_ > 0 && now.force < kNoForce * highest_force_;
    if (carries_nothing && now.speed > 0 && result_.n_steps > 0) {
      result_.end = ImpactEnd::rebound;
      return true;
    }
    const double waited = now.time - result_.full_start_time;
    const bool stopped = std::abs(now.speed) < kNoSpeed * problem_.speed;
    if ((carries_nothing && stopped && result_.n_steps > 100) ||
        waited > kLongestContacts * dry_.contact_time) {
      stick(fmt::format("the ball did not come back: {} after touching the layer it moves at {}",
                        format_si(now.time, "s"), format_si(now.speed, "m/s")));
      return true;
    }
    return false;
  }

  void stick(const std::string& reason) {
    result_.end = ImpactEnd::sticks;
    result_.reason = reason;
  }

  /// The moment when the ball touches the layer.
  void record_touch() {
    result_.history.push_back({.speed = -problem_.speed,
                               .separation = problem_.layer,
                               .central_film = problem_.layer,
                               .min_film = problem_.layer});
  }

  void record_rigid(const Approach& at) {
    const double pressure = rigid_squeeze_pressure(problem_, at.separation, at.speed, 0);
    result_.history.push_back(
        {.time = at.time,
         .force = at.force,
         .speed = at.speed,
         .separation = at.separation,
         .central_film = at.separation,
         .min_film = at.separation,
         .central_pressure = pressure,
         .max_pressure = pressure,
         .film_radius = std::sqrt(2 * problem_.radius * (problem_.layer - at.separation))});
  }

  void record(const BallState& state) {
    // The end of the rigid stage is the beginning of the full one.
    if (!result_.history.empty() && result_.history.back().time == state.time) return;
    result_.history.push_back({.time = state.time,
                               .force = state.force,
                               .speed = state.speed,
                               .separation = state.separation,
                               .central_film = state.film[0],
                               .min_film = smallest_film(state.film),
                               .deformation = state.film[0] - state.separation,
                               .central_pressure = state.pressure[0],
                               .max_pressure = state.pressure.maxCoeff(),
                               .film_radius = film_radius(state.pressure)});
  }

  /// Up to the first torn ring, counted from the centre. Rings outside it may hold specks of
  /// pressure as small as what Newton's method leaves.
  double film_radius(const Eigen::ArrayXd& pressure) const {
    const double nothing = kNoPressure * pressure.maxCoeff();
    Index n_full = 0;
    while (n_full < pressure.size() && pressure[n_full] > nothing) ++n_full;
    return film_.grid.face[n_full];
  }

  /// Profiles at the asked times between two states, by linear interpolation; or all.
  void keep_profiles(const BallState& before, const BallState& now) {
    if (problem_.keeps_all_profiles) return keep_profile(before, now, now.time);
    for (; n_profiles_ < problem_.profile_times.size(); ++n_profiles_) {
      const double time = problem_.profile_times[n_profiles_];
      if (time > now.time) return;
      if (time >= before.time) keep_profile(before, now, time);
    }
  }

  void keep_profile(const BallState& before, const BallState& now, double time) {
    const double share = (time - before.time) / (now.time - before.time);
    ImpactProfile profile;
    profile.time = time;
    profile.film = (1 - share) * before.film + share * now.film;
    profile.pressure = Eigen::ArrayXd::Zero(now.film.size());
    profile.pressure.head(now.pressure.size()) =
        (1 - share) * before.pressure + share * now.pressure;
    result_.profiles.push_back(std::move(profile));
  }

  /// A film that is not above zero, between instants or at one, is no solution: the numbers are
  /// those of a coarse grid.
  void require_film() {
    if (!result_.convergence.converged() || result_.min_film > 0) return;
    result_.convergence.status = Status::stalled;
    result_.reason = fmt::format(
        "the smallest film, {}, is not above zero; use more nodes or shorter time steps",
        format_si(result_.min_film, "m"));
    measure(problem_, result_);  // without a rebound
  }

  void add_warnings() {
    // The spike at the end is narrower than any grid: what counts is the centre under load.
    double pressure = 0;
    for (const ImpactInstant& at : result_.history) {
      if (at.force >= result_.max_force / 2) pressure = std::max(pressure, at.central_pressure);
    }
    result_.warnings = material::warnings(problem_.lubricant, pressure);
    if (const double share = nominal_step_ / dry_.contact_time; share > kLongStep) {
      result_.warnings.push_back(
          {"coarse-steps",
           fmt::format("A time step is {:.2g} of the time of the dry impact, so force, film and "
                       "rebound depend on it. Give steps of {} or less",
                       share, format_si(dry_.contact_time / kStepsPerImpact, "s")),
           share / kLongStep});
    }
    const double radii = result_.domain_radius / dry_.max_radius;
    if (result_.end != ImpactEnd::rebound || radii >= kWideDomain) return;
    result_.warnings.push_back(
        {"short-domain",
         fmt::format("The film reaches {:.2g} radii of the dry contact, so rebound and force "
                     "depend on the domain",
                     radii),
         1 / radii});
  }

  const ImpactProblem& problem_;
  const Observer& observer_;
  bool keeps_factors_;
  reference::DryImpact dry_;
  double nominal_step_ = 0;
  BallFilm film_;
  ImpactResult result_;
  std::size_t n_profiles_ = 0;
  double highest_force_ = 0;
};

ImpactResult solve(const ImpactProblem& problem, const Observer& observer, bool keeps_factors) {
  check(problem);
  Impact impact(problem, observer, keeps_factors);
  const bool stopped = !finishes(observer, "impact", [&](Watch&) { impact.solve(); });
  return impact.finished(stopped);
}

}  // namespace

ImpactResult solve_impact(const ImpactProblem& problem, const Observer& observer) {
  return solve(problem, observer, true);
}

ImpactResult solve_impact_plainly(const ImpactProblem& problem) {
  return solve(problem, {}, false);
}

}  // namespace tabor::ehl
