#include "tabor/contact/separation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tabor/contact/start.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/loops.hpp"
#include "tabor/core/units.hpp"
#include "tabor/elastic/half_space.hpp"
#include "tabor/numerics/bracketed_secant.hpp"

namespace tabor::contact {
namespace {

constexpr double kRoughTolerance = 1e-3;  // certificate while the pressure is far off
constexpr double kRoughAccuracy = 1e-2;   // of ln P
constexpr double kAccuracy = 10;          // of ln P, times the tolerance
constexpr double kHertzSlope = 2.0 / 3;   // of ln(approach) against ln P
constexpr double kLongestStep = 3.5;      // of ln P
constexpr double kLeastApproach = 1e-12;  // of the one asked for
constexpr double kNearCap = 1e-6;         // a mean pressure this close to the cap saturates all
constexpr double kFiner = 1e-3;           // accuracy while gaps are not closed to their limit
constexpr double kFalseContact = 1000;    // as in Conditions
constexpr int kMostSolutions = 60;

/// True where the pressure is right for its load; at another separation than the solver's own, gaps
/// tell the rest.
bool is_certified(const State& state) {
  return !state.convergence.stopped() &&
         state.convergence.certificate <= state.convergence.tolerance;
}

/// Where to look for the mean pressure.
struct Guess {
  double log_pressure;      // ln P
  double slope;             // of ln(approach) against ln P there
  PressureList start = {};  // a pressure like it; empty: none
  bool stopped = false;     // by the observer, on a coarser grid
};

/// Search on one grid. approach: of the flat, from where it first touches [m].
class Search {
 public:
  Search(elastic::ElasticOperator& elasticity, const LoadProblem& problem, double separation,
         Solver solver, const Observer& observer)
      : elasticity_(elasticity),
        problem_(problem),
        solver_(solver),
        observer_(observer),
        highest_(extent_of(problem.height).highest),
        separation_(separation),
        approach_(highest_ - separation),
        log_limit_(std::log((1 - kNearCap) * problem.caps.mean(problem.height.size()))) {}

  /// Finds ln P within an accuracy, from a guess that it improves.
  State run(Guess& guess, double tolerance, double accuracy);

  /// Puts pixels on the bound that the flat presses them against, where that is all they lack.
  void settle(State& state);

  /// True where the surface carries no more, and the flat is still not as near as it should be.
  bool is_out_of_reach() const { return is_out_of_reach_; }
  const Convergence& work() const { return work_; }

 private:
  bool is_near(const State& state) const;
  State solve_at(double mean_pressure, const PressureList& start, double tolerance);
  double error_of(const State& state) const;

  elastic::ElasticOperator& elasticity_;
  const LoadProblem& problem_;
  Solver solver_;
  const Observer& observer_;
  double highest_;
  double separation_;  // asked for [m]
  double approach_;    // the same from the highest point [m]
  double log_limit_;   // of ln P
  bool is_out_of_reach_ = false;
  Convergence work_;
};

State Search::solve_at(double mean_pressure, const PressureList& start, double tolerance) {
  const LoadProblem problem{problem_.height, mean_pressure, problem_.caps,
                            start,           tolerance,     problem_.max_iterations};
  State state = solve_load(elasticity_, problem, solver_, observer_);
  work_ = after(work_, state.convergence);
  return state;
}

/// Returns ln(approach / the one asked for), which rises with the pressure: in Hertz' contact as a
/// straight line.
double Search::error_of(const State& state) const {
  return std::log(std::max(kLeastApproach, (highest_ - state.separation) / approach_));
}

/// True where the state counts as converged at the separation that was asked for.
bool Search::is_near(const State& state) const {
  return state.gap_error + std::abs(state.separation - separation_) <= state.gap_limit;
}

State Search::run(Guess& guess, double tolerance, double accuracy) {
  numerics::BracketedSecant secant(guess.slope, kLongestStep);
  double place = std::min(guess.log_pressure, log_limit_);
  for (int n = 1;; ++n) {
    State state = solve_at(std::exp(place), guess.start, tolerance);
    if (!is_certified(state)) return state;
    const double error = error_of(state);
    is_out_of_reach_ = place == log_limit_ && error < 0;
    const double next = std::min(secant.next(place, error), log_limit_);
    guess = {.log_pressure = next, .slope = secant.slope(), .start = state.pressure};
    const double step = std::abs(next - place);
    const bool is_done = step <= (is_near(state) ? 1 : kFiner) * accuracy;
    if (is_out_of_reach_ || is_done || n == kMostSolutions) return state;
    place = next;
  }
}

// Where all contact is saturated, the load is that of a whole number of pixels and one load holds
// the flat anywhere in an interval: the search ends within rounding of that load.
void Search::settle(State& state) {
  if (is_near(state)) return;
  const Grid& grid = elasticity_.grid();
  const double compliance =
      elastic::love_coefficient(0, 0, grid.dx(), grid.dy(), elasticity_.effective_modulus());
  Field settled = state.pressure;
  for_each(settled.size(), [&](Index i) {
    double& p = settled(i);
    const double cap = problem_.caps(i);
    if (!touches(p) || at_cap(p, cap)) return;
    const double gap = state.displacement(i) - problem_.height(i) + separation_;
    if (gap > kFalseContact * p * compliance) p = 0;
    if (-gap > kFalseContact * (cap - p) * compliance) p = cap;
  });
  if ((settled == 0).all()) return;
  state.pressure = std::move(settled);
  state.mean_pressure = sum(state.pressure) / static_cast<double>(state.pressure.size());
  elasticity_.apply(state.pressure, state.displacement);
  LoadProblem carried = problem_;
  carried.mean_pressure = state.mean_pressure;
  state.convergence.certificate = certificate_of(elasticity_, carried, state);
  state.convergence.operator_applications = 1;
  state.convergence.fft_pairs = 1;
  state.convergence.iterations = 0;
  work_ = after(work_, state.convergence);
}

/// Returns the pressure of pixels that each follow their own overlap, divided by what a patch of
/// them is softer.
double lone_pixel_pressure(const elastic::ElasticOperator& elasticity, const LoadProblem& problem,
                           double separation) {
  const double* height = problem.height.data();
  const Index n = problem.height.size();
  const double overlap =
      sum_over(n, [=](Index i) { return std::max(height[i] - separation, 0.0); }) /
      static_cast<double>(n);
  const Index n_overlapping = count_where(n, [=](Index i) { return height[i] > separation; });
  const Grid& grid = elasticity.grid();
  const double compliance =
      elastic::love_coefficient(0, 0, grid.dx(), grid.dy(), elasticity.effective_modulus());
  return overlap / compliance / (1 + std::sqrt(static_cast<double>(n_overlapping)));
}

/// Returns where to begin: at the mean of the pressure to start from, else at what a grid of half
/// the resolution finds (recursively), else at a rule of thumb. Adds the work of the coarse grids
/// to fft_pairs, weighted by their share of pixels.
Guess first_guess(const elastic::ElasticOperator& elasticity, const LoadProblem& problem,
                  double separation, const Observer& observer, double& fft_pairs) {
  const auto n = static_cast<double>(problem.height.size());
  if (!problem.start.empty()) {
    const double load = sum(problem.start.map());
    if (load > 0) return {std::log(load / n), kHertzSlope, problem.start};
  }
  const Field height = has_coarser(elasticity.grid()) ? halved(problem.height) : Field();
  if (height.size() == 0 || extent_of(height).highest <= separation) {
    return {std::log(lone_pixel_pressure(elasticity, problem, separation)), kHertzSlope};
  }
  const auto coarse = elasticity.on_grid(coarser(elasticity.grid()));
  const LoadProblem coarse_problem{height,
                                   0,
                                   problem.caps.mean(problem.height.size()),
                                   problem.start,
                                   kRoughTolerance,
                                   problem.max_iterations};
  double coarse_pairs = 0;
  Guess guess = first_guess(*coarse, coarse_problem, separation, observer, coarse_pairs);
  Search search(*coarse, coarse_problem, separation, Solver::fast, observer);
  if (!guess.stopped) {
    guess.stopped = search.run(guess, kRoughTolerance, kRoughAccuracy).convergence.stopped();
  }
  fft_pairs += (coarse_pairs + search.work().fft_pairs) * static_cast<double>(height.size()) / n;
  guess.start = guess.stopped
                    ? problem.start
                    : doubled(guess.start.map(), problem.height.rows(), problem.height.cols());
  return guess;
}

}  // namespace

State solve_separation(elastic::ElasticOperator& elasticity, const LoadProblem& problem,
                       double separation, Solver solver, const Observer& observer) {
  double coarse_pairs = 0;
  Guess guess = first_guess(elasticity, problem, separation, observer, coarse_pairs);
  const Observer stop = [](const Progress&) { return false; };
  Search search(elasticity, problem, separation, solver, guess.stopped ? stop : observer);
  State state;
  if (problem.tolerance < kRoughTolerance) {
    state = search.run(guess, kRoughTolerance, kRoughAccuracy);
  }
  if (!state.convergence.stopped()) {
    state = search.run(guess, problem.tolerance, kAccuracy * problem.tolerance);
  }
  if (is_certified(state)) search.settle(state);
  if (search.is_out_of_reach()) {
    throw InputError(
        "separation", format_si(separation, "m"),
        "more than " + format_si(state.separation, "m") + ", where every pixel saturates",
        "raise the separation or the saturation pressure");
  }
  if (!state.convergence.stopped()) {
    LoadProblem found = problem;
    found.mean_pressure = state.mean_pressure;
    finish_state(elasticity, found, separation, state);
    if (is_certified(state)) {
      state.convergence.status =
          state.gap_error <= state.gap_limit ? Status::converged : Status::stalled;
    }
  }
  Convergence whole = search.work();
  whole.status = state.convergence.status;
  whole.fft_pairs += coarse_pairs;
  state.convergence = whole;
  return state;
}

}  // namespace tabor::contact
