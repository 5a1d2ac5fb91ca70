#include "tabor/ehl/line/wear.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tabor/core/error.hpp"
#include "tabor/core/watch.hpp"
#include "tabor/ehl/line/film.hpp"

namespace tabor::ehl {
namespace {

constexpr int kMaxIterations = 40;
constexpr int kMaxHalvings = 6;  // of a time step

void check(const WearProblem& problem) {
  check_line(problem.contact);
  const auto require = [](bool holds, const char* what, double got, const char* expected) {
    if (!holds) throw InputError(what, fmt::format("{}", got), expected, "");
  };
  require(problem.wear_coefficient >= 0 && std::isfinite(problem.wear_coefficient),
          "wear coefficient [m^2/N]", problem.wear_coefficient, "zero or more");
  require(problem.contact.sliding_speed > 0, "sliding speed [m/s]", problem.contact.sliding_speed,
          "more than zero: the track runs");
  require(problem.cycles >= 1, "cycles", static_cast<double>(problem.cycles), "1 or more");
  require(problem.cycles_each >= 1, "cycles that each stands for", problem.cycles_each,
          "1 or more");
  require(problem.steps_per_cycle >= 1, "steps per cycle",
          static_cast<double>(problem.steps_per_cycle), "1 or more");
  require(!(problem.contact.asperities.boundary_film > 0), "boundary film of a worn track [m]",
          problem.contact.asperities.boundary_film,
          "none: asperities are followed in steady films");
  require(problem.stroke >= 0 && std::isfinite(problem.stroke), "stroke [m]", problem.stroke,
          "zero or more");
  const Eigen::ArrayXd x = line_nodes(problem.contact);
  const double needed = x[x.size() - 1] - x[0] + problem.stroke;
  if (!(problem.track_length >= needed)) {
    throw InputError("track", fmt::format("{} m", problem.track_length),
                     fmt::format("the domain of the film and the stroke or more, {} m", needed),
                     "a shorter domain or a longer track");
  }
  if (problem.stroke > 0 && x[x.size() - 1] < -(1 - 1e-9) * x[0]) {
    throw InputError("outlet of a film that goes to and fro",
                     fmt::format("{} m", problem.contact.outlet),
                     fmt::format("as long as the inlet, {} m", -x[0]),
                     "leave it out, because the outlet becomes the inlet on the way back");
  }
}

/// With the domain and the track that a stroke needs, where none are given.
WearProblem completed(WearProblem problem) {
  if (!(problem.stroke > 0)) return problem;
  check_line(problem.contact);
  if (!(problem.contact.outlet > 0)) {
    problem.contact.inlet = -line_nodes(problem.contact)[0];
    problem.contact.outlet = problem.contact.inlet;
  }
  if (!(problem.track_length > 0)) {
    const Eigen::ArrayXd x = line_nodes(problem.contact);
    const double spacing = x[1] - x[0];
    const double each_side = std::ceil(problem.stroke / 2 / spacing) + 1;
    problem.track_length = x[x.size() - 1] - x[0] + spacing * (1 + 2 * each_side);
  }
  return problem;
}

/// A step that moves the track further than this share of the contact, or of a wave, blurs it.
constexpr double kLargestMove = 0.25;

Warnings warnings_of(const WearProblem& problem, double time_step) {
  const double move = problem.contact.sliding_speed * time_step;
  double length = hertz_of(problem.contact).half_width;
  if (problem.wave_amplitude > 0 && problem.n_waves > 0) {
    length = std::min(length, problem.track_length / static_cast<double>(problem.n_waves));
  }
  const bool varies = problem.stroke > 0 || problem.wave_amplitude > 0;
  if (!varies || move <= kLargestMove * length) return {};
  const double factor = move / (kLargestMove * length);
  return {
      {"coarse-steps",
       fmt::format("A step moves the track by {:.2g} of a half width or wave, which blurs the "
                   "film. Give {:.0f} steps per cycle",
                   move / length, std::ceil(factor * static_cast<double>(problem.steps_per_cycle))),
       factor}};
}

/// The worn surface and where it is.
class Track {
 public:
  Track(const WearProblem& problem, double spacing)
      : n_(static_cast<Index>(std::llround(problem.track_length / spacing))),
        depth_(Eigen::ArrayXd::Zero(n_)) {
    const double phase =
        2 * std::numbers::pi * static_cast<double>(problem.n_waves) / static_cast<double>(n_);
    height_ = problem.wave_amplitude *
              (phase * Eigen::ArrayXd::LinSpaced(n_, 0, static_cast<double>(n_ - 1))).sin();
  }

  Index size() const { return n_; }
  const Eigen::ArrayXd& depth() const { return depth_; }
  void move_to(Index nodes) { shift_ = nodes % n_; }

  /// Height of the surface [m] under node i of the film.
  double height(Index i) const { return height_[under(i)] - depth_[under(i)]; }
  void wear(Index i, double depth) { depth_[under(i)] += depth; }

 private:
  Index under(Index i) const { return ((i - shift_) % n_ + n_) % n_; }

  Index n_;
  Index shift_ = 0;
  Eigen::ArrayXd height_, depth_;
};

/// Where the track is at a time [s].
class Motion {
 public:
  Motion(const WearProblem& problem, Index n_track, double spacing)
      : speed_(problem.contact.sliding_speed), stroke_(problem.stroke), spacing_(spacing) {
    if (stroke_ > 0) {
      rate_ = 2 * speed_ / stroke_;
      time_step_ = 2 * std::numbers::pi / rate_ / static_cast<double>(problem.steps_per_cycle);
      n_steps_ = problem.cycles * problem.steps_per_cycle;
      end_ = static_cast<double>(n_steps_) * time_step_;
      origin_ = -(n_track - problem.contact.nodes) / 2;
      return;
    }
    const Index nodes_per_step = std::max<Index>(1, n_track / problem.steps_per_cycle);
    time_step_ = static_cast<double>(nodes_per_step) * spacing / speed_;
    end_ = static_cast<double>(problem.cycles) * problem.track_length / speed_;
    n_steps_ = static_cast<Index>(std::ceil(end_ / time_step_ * (1 - 1e-12)));
  }

  double time_step() const { return time_step_; }
  Index n_steps() const { return n_steps_; }
  /// [s] at which a step ends, counted from 0; the last one may be shorter, so that the track runs
  /// as far as asked.
  double end_of(Index step) const {
    return step + 1 == n_steps_ ? end_ : static_cast<double>(step + 1) * time_step_;
  }
  /// [m] from where it began.
  double place(double time) const {
    return stroke_ > 0 ? stroke_ / 2 * std::sin(rate_ * time) : speed_ * time;
  }
  /// Nodes by which the track lies to the right of the film's first one.
  Index node(double time) const {
    return origin_ + static_cast<Index>(std::llround(place(time) / spacing_));
  }
  /// [m] slid between two times, the way back counting like the way there.
  double slid(double begin, double end) const {
    if (!(stroke_ > 0)) return speed_ * (end - begin);
    const auto travelled = [&](double time) {
      const double turns = std::floor(rate_ * time / std::numbers::pi + 0.5);
      const double sign = static_cast<Index>(turns) % 2 == 0 ? 1 : -1;
      return stroke_ * turns + sign * place(time);
    };
    return travelled(end) - travelled(begin);
  }

 private:
  double speed_;      // [m/s] in the middle of the stroke
  double stroke_;     // [m]
  double spacing_;    // [m]
  double rate_ = 0;   // [1/s]
  double time_step_;  // [s]
  Index n_steps_ = 0;
  double end_ = 0;    // [s]
  Index origin_ = 0;  // the film begins in the middle of a track that goes to and fro
};

/// The film over the track as it goes on.
class Wearing {
 public:
  explicit Wearing(const WearProblem& problem)
      : problem_(problem),
        film_(problem.contact),
        smooth_(film_.conditions().shape),
        conditions_(film_.conditions()),
        spacing_(film_.x()[1] - film_.x()[0]),
        track_(problem, spacing_),
        motion_(problem, track_.size(), spacing_) {}

  /// Follows the track to its end.
  void run(const Observer& observer, Watch& watch) {
    start(observer);
    for (Index i = 0; i < motion_.n_steps() && result_.convergence.converged(); ++i) {
      watch.tell(static_cast<double>(i) / static_cast<double>(motion_.n_steps()));
      advance(motion_.end_of(i), 0);
    }
  }

  WearResult finish(bool stopped) {
    if (stopped) result_.convergence.status = Status::stopped;
    result_.track = Eigen::ArrayXd::LinSpaced(track_.size(), 0,
                                              spacing_ * static_cast<double>(track_.size() - 1));
    result_.depth = track_.depth();
    result_.worn_area = spacing_ * track_.depth().sum();
    result_.time_step = motion_.time_step();
    result_.warnings = warnings_of(problem_, motion_.time_step());
    return std::move(result_);
  }

 private:
  void start(const Observer& observer) {
    lay_track(0);
    LineProblem rough = problem_.contact;
    rough.roughness = smooth_ - conditions_.shape;
    const LineResult steady = solve_line(rough, observer);
    state_.pressure = steady.pressure;
    state_.separation = steady.separation;
    state_.film = steady.film;
    state_.cavity.clear();
    for (Index i = 0; i < film_.n(); ++i) state_.cavity.push_back(!(steady.pressure[i] > 0));
    record(0, problem_.contact.sliding_speed);
    result_.convergence = steady.convergence;
  }

  /// To a time [s], in halves of the way if the film is not found at once.
  bool advance(double end, int n_halvings) {
    const double begin = time_;
    const double share = (motion_.place(end) - motion_.place(begin)) /
                         problem_.contact.sliding_speed / (end - begin);
    const LineStorage storage{.time_step = end - begin, .old_mass = film_.mass_of(state_)};
    const LineState old = state_;
    lay_track(end);
    conditions_.speed = share * problem_.contact.entrainment_speed;
    const LineFilm::Outcome outcome = film_.solve(state_, conditions_, storage, kMaxIterations);
    result_.convergence = after(result_.convergence, outcome.convergence);
    if (!outcome.convergence.converged()) {
      if (n_halvings == kMaxHalvings) {
        result_.convergence.status = Status::stalled;
        return false;
      }
      state_ = old;
      lay_track(begin);
      return advance((begin + end) / 2, n_halvings + 1) && advance(end, n_halvings + 1);
    }
    const double slid = problem_.cycles_each * motion_.slid(begin, end);
    for (Index i = 0; i < film_.n(); ++i) {
      track_.wear(i, problem_.wear_coefficient * slid * std::max(0.0, state_.pressure[i]));
    }
    time_ = end;
    record(slid, share * problem_.contact.sliding_speed);
    return true;
  }

  void lay_track(double time) {
    track_.move_to(motion_.node(time));
    for (Index i = 0; i < film_.n(); ++i) conditions_.shape[i] = smooth_[i] - track_.height(i);
  }

  void record(double slid, double speed) {
    LineResult now;
    now.x = film_.x();
    now.pressure = state_.pressure;
    now.film = state_.film;
    LineProblem contact = problem_.contact;
    contact.sliding_speed = speed;
    measure_line(contact, now);
    const double distance = (result_.history.empty() ? 0 : result_.history.back().distance) + slid;
    result_.history.push_back({.time = problem_.cycles_each * time_,
                               .distance = distance,
                               .mean_depth = track_.depth().mean(),
                               .max_depth = track_.depth().maxCoeff(),
                               .sliding_speed = speed,
                               .min_film = now.min_film,
                               .max_pressure = now.max_pressure,
                               .friction_coefficient = now.friction_coefficient});
  }

  const WearProblem& problem_;
  LineFilm film_;
  Eigen::ArrayXd smooth_;      // gap of the undeformed bodies without the track's heights [m]
  LineConditions conditions_;  // where the track is now
  double spacing_;
  Track track_;
  Motion motion_;
  double time_ = 0;  // [s] computed
  LineState state_;
  WearResult result_;
};

}  // namespace

WearResult solve_wear(const WearProblem& given, const Observer& observer) {
  const WearProblem problem = completed(given);
  check(problem);
  Wearing wearing(problem);
  const auto work = [&](Watch& watch) { wearing.run(observer, watch); };
  const bool stopped = !finishes(observer, "wear", work);
  return wearing.finish(stopped);
}

}  // namespace tabor::ehl
