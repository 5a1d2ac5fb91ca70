#include "tabor/contact/polonsky_keer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "tabor/contact/conditions.hpp"
#include "tabor/contact/projection.hpp"
#include "tabor/contact/start.hpp"
#include "tabor/core/loops.hpp"

namespace tabor::contact {
namespace {

/// Fields and scalars of the iteration, named as in the paper where it names them.
class ConjugateGradient {
 public:
  ConjugateGradient(elastic::ElasticOperator& elasticity, const LoadProblem& problem)
      : elasticity_(elasticity),
        problem_(problem),
        conditions_(elasticity, problem),
        caps_(problem.caps) {}

  State run(const Observer& observer);

 private:
  bool is_free(Index i) const { return touches(pressure_(i)) && !at_cap(pressure_(i), caps_(i)); }
  double mean_over_free(const Field& field) const;
  double level() const;
  Conditions::Settled settle(Convergence& convergence);
  double update_direction();
  double damping(const Convergence& convergence);
  void step(double length);

  elastic::ElasticOperator& elasticity_;
  const LoadProblem& problem_;
  Conditions conditions_;
  Caps caps_;                 // [Pa]
  Field pressure_;            // [Pa]
  Field gap_;                 // g = S p - z, about its mean over free pixels [m]
  Field direction_;           // t
  Field response_;            // r = S t
  double conjugacy_ = 0;      // delta: 0 restarts the conjugate directions
  double previous_norm_ = 1;  // G of the iteration before
  double step_length_ = 1;    // tau of the iteration before [Pa/m]
  double damping_ = 1;        // share of tau that is taken
  double best_certificate_ = std::numeric_limits<double>::infinity();
  int best_iteration_ = 0;
};

double ConjugateGradient::mean_over_free(const Field& field) const {
  double total = 0;
  double n = 0;
  for (Index i = 0; i < field.size(); ++i) {  // raw loop: blocks would change the last digits
    if (is_free(i)) {
      total += field(i);
      n += 1;
    }
  }
  return n > 0 ? total / n : 0;
}

/// Separation in the units of gap_: the mean over the free pixels; with a cap, where there may be
/// none, the level at which a step along the gap carries the load.
double ConjugateGradient::level() const {
  if (!caps_.bound()) return mean_over_free(gap_);
  std::vector<double> trial(static_cast<std::size_t>(gap_.size()));
  for_each(gap_.size(), [&](Index i) {
    trial[static_cast<std::size_t>(i)] = pressure_(i) - step_length_ * gap_(i);
  });
  const double load = problem_.mean_pressure * static_cast<double>(gap_.size());
  return -shift_for_load(trial, load, caps_) / step_length_;
}

/// Certifies the pressure. If that is good enough, moves pixels that are hardly inside their bounds
/// onto them, and returns true if the answer is converged.
Conditions::Settled ConjugateGradient::settle(Convergence& convergence) {
  const auto n = static_cast<std::size_t>(pressure_.size());
  const std::span<const double> gap(gap_.data(), n);
  convergence.certificate = conditions_.certificate(
      {{pressure_.data(), pressure_.data() + n}, {gap.begin(), gap.end()}}, caps_);
  if (!(convergence.certificate <= problem_.tolerance)) return Conditions::Settled::not_yet;
  const std::span<double> pressure(pressure_.data(), n);
  const Conditions::Settled settled = conditions_.settle(pressure, gap, caps_);
  if (settled == Conditions::Settled::already && conditions_.gaps_close(pressure, gap, caps_)) {
    convergence.status = Status::converged;
  }
  return settled;
}

/// t = g + delta G / G_old t on the free pixels; returns the step length <g, t> / <r, t>.
double ConjugateGradient::update_direction() {
  double norm = 0;
  for (Index i = 0; i < gap_.size(); ++i) {  // raw loop: as that of mean_over_free
    norm += is_free(i) ? gap_(i) * gap_(i) : 0;
  }
  const double ratio = conjugacy_ * norm / previous_norm_;
  for_each(gap_.size(),
           [&](Index i) { direction_(i) = is_free(i) ? gap_(i) + ratio * direction_(i) : 0; });
  previous_norm_ = norm;
  elasticity_.apply(direction_, response_);
  response_ -= mean_over_free(response_);
  const double curvature = (response_ * direction_).sum();
  const double slope = (gap_ * direction_).sum();
  return curvature > 0 ? slope / curvature : 0;
}

/// Share of the step to take: halved each time that many iterations brought no better certificate.
/// With a cap, steps of full length can go round in circles.
double ConjugateGradient::damping(const Convergence& convergence) {
  constexpr int patience = 100;
  if (convergence.certificate < best_certificate_) {
    best_certificate_ = convergence.certificate;
    best_iteration_ = convergence.iterations;
  } else if (convergence.iterations - best_iteration_ > patience) {
    damping_ /= 2;
    best_iteration_ = convergence.iterations;
  }
  return damping_;
}

/// Moves the free pixels along t and those that violate the contact conditions along g, then
/// restores bounds and load.
void ConjugateGradient::step(double length) {
  const auto violates = [&](Index i) {
    return !is_free(i) && (touches(pressure_(i)) ? gap_(i) > 0 : gap_(i) < 0);
  };
  conjugacy_ = count_where(gap_.size(), violates) > 0 ? 0 : 1;
  for_each(gap_.size(), [&](Index i) {
    if (is_free(i)) {
      pressure_(i) -= length * direction_(i);
    } else if (violates(i)) {
      pressure_(i) -= length * gap_(i);
    }
    // What is beyond the cap stays there until the load is restored: that keeps it at the cap.
    pressure_(i) = std::max(pressure_(i), 0.0);
  });
  fit_to_load(pressure_, problem_.mean_pressure, caps_);
}

State ConjugateGradient::run(const Observer& observer) {
  State state;
  Convergence& convergence = state.convergence;
  convergence.tolerance = problem_.tolerance;
  if (!problem_.start.empty()) {
    pressure_ = problem_.start.map();
    fit_to_load(pressure_, problem_.mean_pressure, caps_);
  } else {
    pressure_ =
        Field::Constant(problem_.height.rows(), problem_.height.cols(), problem_.mean_pressure);
  }
  gap_.resizeLike(pressure_);
  direction_ = Field::Zero(pressure_.rows(), pressure_.cols());
  response_.resizeLike(pressure_);
  step_length_ = elasticity_.effective_modulus() / elasticity_.grid().dx();
  while (true) {
    elasticity_.apply(pressure_, gap_);
    convergence.operator_applications += 1;
    state.displacement = gap_;
    gap_ -= problem_.height;
    if (settle(convergence) == Conditions::Settled::now) {
      conjugacy_ = 0;
      continue;
    }
    if (asks_to_stop(observer, {.stage = "contact (Polonsky-Keer)", .convergence = &convergence})) {
      convergence.status = Status::stopped;
    }
    if (!convergence.failed() || convergence.iterations >= problem_.max_iterations) break;
    gap_ -= level();
    const double length = update_direction();
    convergence.operator_applications += 1;
    // A pixel alone tells nothing about the step length: a shorter one ends going to and fro.
    step_length_ = length > 0 ? length : step_length_ / 2;
    step(step_length_ * damping(convergence));
    convergence.iterations += 1;
  }
  convergence.fft_pairs = convergence.operator_applications;
  state.pressure = std::move(pressure_);
  return state;
}

}  // namespace

State solve_polonsky_keer(elastic::ElasticOperator& elasticity, const LoadProblem& problem,
                          const Observer& observer) {
  return ConjugateGradient(elasticity, problem).run(observer);
}

}  // namespace tabor::contact
