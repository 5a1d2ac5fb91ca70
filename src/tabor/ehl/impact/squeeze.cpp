#include "tabor/ehl/impact/squeeze.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "tabor/core/checks.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/units.hpp"
#include "tabor/core/watch.hpp"
#include "tabor/numerics/root.hpp"

namespace tabor::ehl {

namespace {

using std::numbers::pi;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr int kIntervals = 200;          // of the integral of the pressure
constexpr int kBisections = 55;          // of the angle of the exit
constexpr double kFilmAccuracy = 1e-12;  // relative
constexpr int kStepsPerLayer = 2000;
constexpr int kFewestAtPeak = 15;  // instants; with fewer the force is wrong by a percent and more
constexpr int kMaxDoublings = 60;  // of the reach in which a film is looked for
constexpr double kMostSteps = 1e7;
constexpr double kLongest = 5;  // times the layer over the speed until we give up waiting

/// Integrals from -pi/2 of cos^2, sin cos^3 and cos^4.
struct Integrals {
  double sine, cosine, square, mixed, fourth;

  explicit Integrals(double angle) : sine(std::sin(angle)), cosine(std::cos(angle)) {
    const double from = angle + pi / 2;
    const double sine_of_double = 2 * sine * cosine;
    const double cosine_of_double = 1 - 2 * sine * sine;
    square = from / 2 + sine_of_double / 4;
    mixed = -cosine * cosine * cosine * cosine / 4;
    fourth = 3 * from / 8 + sine_of_double / 4 + sine_of_double * cosine_of_double / 16;
  }
};

/// The reduced pressure q over the angle: unit * (a I2 + b I13 + c I4), zero with its slope at the
/// exit.
class ReducedPressure {
 public:
  ReducedPressure(const SqueezeProblem& problem, double film, double film_speed)
      : length_(std::sqrt(2 * problem.radius * film)),
        slide_(6 * problem.sliding_speed * film),
        squeeze_(12 * film_speed * length_),
        unit_(problem.viscosity * length_ / (film * film * film)) {
    exit_ = find_exit();
    const double cosine = std::cos(exit_);
    // At pi/2 (no sliding) the constant vanishes.
    constant_ = slide_ == 0 ? 0 : -slide_ / (cosine * cosine) - squeeze_ * std::tan(exit_);
  }

  double exit() const { return exit_; }
  double length() const { return length_; }

  double at(const Integrals& integrals) const {
    return unit_ *
           (slide_ * integrals.square + squeeze_ * integrals.mixed + constant_ * integrals.fourth);
  }

 private:
  /// Where the film ends. Without sliding: nowhere while it closes, at once while it opens.
  double find_exit() const {
    if (slide_ == 0) return squeeze_ < 0 ? pi / 2 : -pi / 2;
    double inside = -pi / 2;
    double outside = pi / 2;
    for (int i = 0; i < kBisections; ++i) {
      const double middle = (inside + outside) / 2;
      (end_value(middle) > 0 ? inside : outside) = middle;
    }
    return inside;
  }

  /// q at an exit there, times cos^2: positive before the right place, negative behind it.
  double end_value(double angle) const {
    const Integrals integrals(angle);
    const double cosine = integrals.cosine;
    return cosine * cosine * (slide_ * integrals.square + squeeze_ * integrals.mixed) -
           (slide_ + squeeze_ * integrals.sine * cosine) * integrals.fourth;
  }

  double length_, slide_, squeeze_, unit_;
  double exit_ = 0, constant_ = 0;
};

void check(const SqueezeProblem& problem) {
  check_positive("mass of the roller", problem.mass);
  check_positive("effective radius", problem.radius);
  check_positive("spring", problem.spring);
  check_positive("speed of the roller", problem.speed);
  check_positive("viscosity", problem.viscosity);
  check_positive("layer", problem.layer);
  if (!(problem.sliding_speed >= 0) || !(problem.pressure_coefficient >= 0)) {
    throw InputError("sliding speed and pressure-viscosity coefficient", "a negative one",
                     "zero or more", "");
  }
}

/// Time marching: second-order differences for the film, the trapezoidal rule for the roller.
class Roller {
 public:
  explicit Roller(const SqueezeProblem& problem) : problem_(problem) {
    step_ = problem.time_step > 0 ? problem.time_step
                                  : problem.layer / (kStepsPerLayer * problem.speed);
  }

  SqueezeInstant start() const {
    SqueezeInstant at;
    at.film = problem_.layer;
    at.film_speed = at.roller_speed = -problem_.speed;
    at.force = squeeze_slide_load(problem_, at.film, at.film_speed);
    at.roller = at.film - at.force / problem_.spring;
    return at;
  }

  double step() const { return step_; }

  /// The instant after `now`; `before` the one before it, or null. None where no film balances the
  /// roller, as its force or its motion leaves the range of numbers.
  std::optional<SqueezeInstant> after(const SqueezeInstant& now,
                                      const SqueezeInstant* before) const {
    const auto value = [&](double film) { return excess(film, now, before); };
    const std::optional<double> film = root(value, now);
    if (!film) return std::nullopt;
    SqueezeInstant next = at_film(*film, now, before);
    next.time = now.time + step_;
    return next;
  }

 private:
  SqueezeInstant at_film(double film, const SqueezeInstant& now,
                         const SqueezeInstant* before) const {
    SqueezeInstant next;
    next.film = film;
    next.film_speed =
        before ? (3 * film - 4 * now.film + before->film) / (2 * step_) : (film - now.film) / step_;
    next.force = squeeze_slide_load(problem_, film, next.film_speed);
    const double acceleration = (now.force + next.force) / (2 * problem_.mass) - problem_.gravity;
    next.roller_speed = now.roller_speed + step_ * acceleration;
    next.roller = now.roller + step_ * (now.roller_speed + next.roller_speed) / 2;
    return next;
  }

  /// h0 - (hr + W/k_e): grows with the film, -infinity where the film is too thin for any load.
  double excess(double film, const SqueezeInstant& now, const SqueezeInstant* before) const {
    if (film <= 0) return -kInfinity;
    const SqueezeInstant next = at_film(film, now, before);
    if (!std::isfinite(next.force)) return -kInfinity;
    return film - next.roller - next.force / problem_.spring;
  }

  /// The film at which a growing function is zero, which may be -infinity where it is too thin.
  template <typename Value>
  std::optional<double> root(const Value& value, const SqueezeInstant& now) const {
    double reach = std::max(std::abs(now.film_speed) * step_, 1e-3 * now.film);
    double high = now.film;
    for (int i = 0; !(value(high) >= 0); ++i) {
      if (i == kMaxDoublings) return std::nullopt;
      high += reach *= 2;
    }
    double low = std::max(0.0, high - 2 * reach);
    while (value(low) > 0) {  // ends at zero, where it is -infinity
      low = std::max(0.0, low - (reach *= 2));
    }
    return numerics::increasing_root(value, low, high, kFilmAccuracy);
  }

  const SqueezeProblem& problem_;
  double step_ = 0;
};

double longest_time(const SqueezeProblem& problem) {
  return kLongest * problem.layer / problem.speed;
}

/// Throws for a step so short that the end is out of reach.
void check_step(const SqueezeProblem& problem, double step) {
  if (longest_time(problem) <= kMostSteps * step) return;
  throw InputError("time step", format_si(step, "s"),
                   "at least " + format_si(longest_time(problem) / kMostSteps, "s"), "");
}

/// Where a straight line between two instants passes zero.
double zero_between(double t0, double v0, double t1, double v1) {
  return t0 + (t1 - t0) * v0 / (v0 - v1);
}

/// Adds instants until the gap opens again; false if there is no next one.
bool follow(const SqueezeProblem& problem, const Roller& roller, Watch& watch,
            std::vector<SqueezeInstant>& history) {
  const double longest = longest_time(problem);
  double share = 0;  // of the way to a closed gap, whose end takes most of the time
  while (history.back().time < longest) {
    if (!std::isfinite(history.back().force)) return false;
    const std::size_t n = history.size();
    const auto next = roller.after(history[n - 1], n > 1 ? &history[n - 2] : nullptr);
    if (!next) return false;
    history.push_back(*next);
    share = std::max(share, 1 - next->film / problem.layer);
    watch.tell(share);
    if (next->film_speed > 0 && next->roller_speed > 0) return true;
  }
  return true;
}

void measure(SqueezeResult& result) {
  const std::vector<SqueezeInstant>& history = result.history;
  const auto strongest = std::max_element(
      history.begin(), history.end(),
      [](const SqueezeInstant& a, const SqueezeInstant& b) { return a.force < b.force; });
  const auto thinnest = std::min_element(
      history.begin(), history.end(),
      [](const SqueezeInstant& a, const SqueezeInstant& b) { return a.film < b.film; });
  const bool has_force = std::isfinite(strongest->force);
  result.max_force = has_force ? strongest->force : kNothing;
  result.time_max_force = has_force ? strongest->time : kNothing;
  result.min_film = thinnest->film;
  result.time_min_film = result.turning_time = kNothing;
  for (std::size_t i = 1; i < history.size(); ++i) {
    const SqueezeInstant& a = history[i - 1];
    const SqueezeInstant& b = history[i];
    if (a.film_speed < 0 && b.film_speed >= 0) {
      result.time_min_film = zero_between(a.time, a.film_speed, b.time, b.film_speed);
    }
    if (a.roller_speed < 0 && b.roller_speed >= 0) {
      result.turning_time = zero_between(a.time, a.roller_speed, b.time, b.roller_speed);
      result.gap_closing_at_turning = b.film_speed < 0;
    }
  }
  result.lag = result.time_min_film - result.time_max_force;
}

/// Where few instants make the peak of the force, it and the smallest film depend on the step.
Warnings warnings_of(const SqueezeProblem& problem, const SqueezeResult& result) {
  const auto n =
      std::count_if(result.history.begin(), result.history.end(),
                    [&](const SqueezeInstant& at) { return at.force >= result.max_force / 2; });
  if (n >= kFewestAtPeak || !std::isfinite(result.max_force)) return {};
  return {{"coarse-steps",
           fmt::format("Few instants make the peak of the force (above half of it: {}), so force "
                       "and film depend on the time step. Give steps of {} or less",
                       n, format_si(problem.layer / (kStepsPerLayer * problem.speed), "s")),
           static_cast<double>(kFewestAtPeak) / static_cast<double>(n)}};
}

}  // namespace

double squeeze_slide_load(const SqueezeProblem& problem, double film, double film_speed) {
  const ReducedPressure reduced(problem, film, film_speed);
  const double width = (reduced.exit() + pi / 2) / kIntervals;
  const double alpha = problem.pressure_coefficient;
  double sum = 0;
  for (int i = 1; i < kIntervals; ++i) {  // Simpson's rule; p / cos^2 vanishes at both ends
    const Integrals integrals(-pi / 2 + i * width);
    const double q = reduced.at(integrals);
    if (alpha * q >= 1) return kInfinity;
    const double pressure = alpha > 0 ? -std::log1p(-alpha * q) / alpha : q;
    sum += (i % 2 == 1 ? 4 : 2) * pressure / (integrals.cosine * integrals.cosine);
  }
  return width / 3 * reduced.length() * sum;
}

SqueezeResult solve_squeeze(const SqueezeProblem& problem, const Observer& observer) {
  check(problem);
  const Roller roller(problem);
  check_step(problem, roller.step());
  SqueezeResult result;
  result.history.push_back(roller.start());
  bool went_on = true;
  const auto work = [&](Watch& watch) { went_on = follow(problem, roller, watch, result.history); };
  const bool stopped = !finishes(observer, "squeeze", work);
  measure(result);
  result.convergence = {.certificate = kFilmAccuracy, .tolerance = kFilmAccuracy};
  const bool is_sound = went_on && std::isfinite(result.max_force);
  result.convergence.status = is_sound ? Status::converged : Status::stalled;
  if (is_sound) result.warnings = warnings_of(problem, result);
  if (stopped) {
    result.convergence.status = Status::stopped;
  } else if (!went_on) {
    result.reason = fmt::format(
        "no film balances the roller after {}: its force or its motion leaves the range of numbers",
        format_si(result.history.back().time, "s"));
  } else if (std::isnan(result.turning_time)) {
    result.reason = fmt::format("the roller had not turned after {}",
                                format_si(result.history.back().time, "s"));
  }
  return result;
}

double LinearSqueeze::angular_frequency() const {
  return std::sqrt(stiffness / mass - damping * damping / (4 * mass * mass));
}

double LinearSqueeze::phase() const {
  // tan(phi) = c w / (k - c^2/(2 m)): the quadrant matters when the damping is strong.
  return std::atan2(damping * angular_frequency(), stiffness - damping * damping / (2 * mass));
}

double LinearSqueeze::displacement(double time) const {
  const double w = angular_frequency();
  return speed / w * std::exp(-damping * time / (2 * mass)) * std::sin(w * time);
}

double LinearSqueeze::force(double time) const {
  const double w = angular_frequency();
  const double decay = damping / (2 * mass);
  const double x_speed =
      speed / w * std::exp(-decay * time) * (w * std::cos(w * time) - decay * std::sin(w * time));
  return stiffness * displacement(time) + damping * x_speed;
}

double LinearSqueeze::time_max_displacement() const {
  const double w = angular_frequency();
  return std::atan2(w, damping / (2 * mass)) / w;
}

double LinearSqueeze::time_max_force() const {
  return std::max(0.0, time_max_displacement() - phase() / angular_frequency());
}

}  // namespace tabor::ehl
