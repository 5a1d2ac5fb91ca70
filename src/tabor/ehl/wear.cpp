#include "tabor/ehl/wear.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "tabor/core/error.hpp"
#include "tabor/ehl/line_film.hpp"

namespace tabor::ehl {
namespace {

constexpr int kMaxIterations = 40;

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
  const Eigen::ArrayXd x = line_nodes(problem.contact);
  if (!(problem.track_length >= x[x.size() - 1] - x[0])) {
    throw InputError("track", fmt::format("{} m", problem.track_length),
                     fmt::format("the domain of the film or more, {} m", x[x.size() - 1] - x[0]),
                     "a shorter domain or a longer track");
  }
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
  void move(Index nodes) { shift_ = (shift_ + nodes) % n_; }

  /// Height of the surface [m] under node i of the film.
  double height(Index i) const { return height_[under(i)] - depth_[under(i)]; }
  void wear(Index i, double depth) { depth_[under(i)] += depth; }

 private:
  Index under(Index i) const { return ((i - shift_) % n_ + n_) % n_; }

  Index n_;
  Index shift_ = 0;
  Eigen::ArrayXd height_, depth_;
};

/// The film over the track as it goes on.
class Wearing {
 public:
  explicit Wearing(const WearProblem& problem)
      : problem_(problem),
        film_(problem.contact),
        smooth_(film_.shape),
        spacing_(film_.x()[1] - film_.x()[0]),
        track_(problem, spacing_) {
    nodes_per_step_ = std::max<Index>(1, track_.size() / problem.steps_per_cycle);
    time_step_ = static_cast<double>(nodes_per_step_) * spacing_ / problem.contact.sliding_speed;
  }

  bool start(const Observer& observer) {
    lay_track();
    LineProblem rough = problem_.contact;
    rough.roughness = smooth_ - film_.shape;
    const LineResult steady = solve_line(rough, observer);
    state_.pressure = steady.pressure;
    state_.separation = steady.separation;
    state_.film = steady.film;
    state_.cavity.clear();
    for (Index i = 0; i < film_.n(); ++i) state_.cavity.push_back(!(steady.pressure[i] > 0));
    record(0);
    result_.newton_iterations = steady.newton_iterations;
    return steady.converged;
  }

  /// One step of the track; false if the film was not found.
  bool step() {
    LineStorage storage{.time_step = time_step_, .old_mass = film_.mass_of(state_)};
    track_.move(nodes_per_step_);
    lay_track();
    const LineFilm::Outcome outcome = film_.solve(state_, storage, kMaxIterations);
    result_.newton_iterations += outcome.iterations;
    if (!outcome.converged) return false;
    const double slid = problem_.cycles_each * problem_.contact.sliding_speed * time_step_;
    for (Index i = 0; i < film_.n(); ++i) {
      track_.wear(i, problem_.wear_coefficient * slid * std::max(0.0, state_.pressure[i]));
    }
    record(slid);
    return true;
  }

  Index n_steps() const {
    return (problem_.cycles * track_.size() + nodes_per_step_ - 1) / nodes_per_step_;
  }

  WearResult finish(bool converged) {
    result_.converged = converged;
    result_.track = Eigen::ArrayXd::LinSpaced(track_.size(), 0,
                                              spacing_ * static_cast<double>(track_.size() - 1));
    result_.depth = track_.depth();
    result_.worn_area = spacing_ * track_.depth().sum();
    result_.time_step = time_step_;
    return std::move(result_);
  }

 private:
  void lay_track() {
    for (Index i = 0; i < film_.n(); ++i) film_.shape[i] = smooth_[i] - track_.height(i);
  }

  void record(double slid) {
    LineResult now;
    now.x = film_.x();
    now.pressure = state_.pressure;
    now.film = state_.film;
    measure_line(problem_.contact, now);
    const double distance = (result_.history.empty() ? 0 : result_.history.back().distance) + slid;
    result_.history.push_back({.time = distance / problem_.contact.sliding_speed,
                               .distance = distance,
                               .mean_depth = track_.depth().mean(),
                               .max_depth = track_.depth().maxCoeff(),
                               .min_film = now.min_film,
                               .max_pressure = now.max_pressure,
                               .friction_coefficient = now.friction_coefficient});
  }

  const WearProblem& problem_;
  LineFilm film_;
  Eigen::ArrayXd smooth_;  // gap of the undeformed bodies without the track's heights [m]
  double spacing_;
  Track track_;
  Index nodes_per_step_ = 1;
  double time_step_ = 0;
  LineState state_;
  WearResult result_;
};

}  // namespace

WearResult solve_wear(const WearProblem& problem, const Observer& observer) {
  check(problem);
  Wearing wearing(problem);
  bool converged = wearing.start(observer);
  const Index n_steps = wearing.n_steps();
  for (Index i = 0; i < n_steps && converged; ++i) {
    report_progress(observer, "wear", static_cast<double>(i) / static_cast<double>(n_steps));
    converged = wearing.step();
  }
  return wearing.finish(converged);
}

}  // namespace tabor::ehl
