#include "tabor/contact/trapped/trapped_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "tabor/contact/conditions.hpp"
#include "tabor/contact/scale.hpp"
#include "tabor/contact/search_direction.hpp"
#include "tabor/contact/trapped/liquid_energy.hpp"
#include "tabor/contact/trapped/pouring.hpp"
#include "tabor/core/large_pages.hpp"

namespace tabor::contact {
namespace {

/// A map of value(pixel), written on all threads.
template <typename Value>
Field map_of(Index ny, Index nx, const Value& value) {
  auto map = uninitialised_map<Field>(ny, nx);
  for_each(map.size(), [&](Index i) { map(i) = value(i); });
  return map;
}

constexpr double kLeastStep = 0.05;  // of tau
constexpr double kMostStep = 20;
// Factor of the steps of pistons: longer where the minimum along a step lies behind its end.
constexpr double kLeastPiston = 0.25, kMostPiston = 32;
constexpr double kLonger = 1.5, kShorter = 0.5;
// Share of the last step in the next one: less is not worth a projection, more leads astray.
constexpr double kLeastMomentum = 0.05, kMostMomentum = 1;
constexpr double kShort = 0.5;    // of a step to its minimum: it was too long
constexpr double kMargin = 0.05;  // of the length scale

/// How a step is taken: along the direction of solid contact, or pixel by pixel.
enum class Metric { preconditioned, scalar };

class TwoMetricGradient {
 public:
  TwoMetricGradient(elastic::ElasticOperator& elasticity, const LoadProblem& problem,
                    const SealedPockets& liquid)
      : elasticity_(elasticity),
        problem_(problem),
        liquid_(liquid),
        pockets_(liquid.pockets),
        cap_(problem.caps.for_all()),
        load_(problem.mean_pressure * static_cast<double>(problem.height.size())),
        gap_scale_(load_ * length_scale(elasticity, problem)),
        conditions_(elasticity, problem, liquid),
        energy_(pockets_, liquid.bulk_modulus, cap_, load_),
        pouring_(pockets_, liquid.bulk_modulus, cap_),
        direction_(elasticity) {
    convergence_.tolerance = problem.tolerance;
    const double pixel = std::sqrt(elasticity.grid().pixel_area());
    const double stiffest = 1.04 * elasticity.effective_modulus() / pixel;
    for (std::size_t k = 0; k < pockets_.size(); ++k) {
      const double side = pixel * std::sqrt(static_cast<double>(pockets_.n_pixels(k)));
      piston_.push_back(std::min(stiffest, 3 * std::pow(std::numbers::pi, 1.5) *
                                               elasticity.effective_modulus() / (16 * side)));
    }
  }

  SealedState run(const State& start, const std::vector<double>& levels, const Observer& observer);

 private:
  void refresh();
  void collect_outside(double lambda);
  void certify();
  bool ends(const Observer& observer);
  bool meets_conditions();
  void choose_active_set();
  void find_direction();
  void choose_step();
  double project_step(Metric metric, double momentum = 0);
  double conjugate_share() const;
  double add_momentum(double slope);
  bool move();
  void accept(double length);

  double r(std::size_t pixel) const { return now_.v.data()[pixel] - now_.lambda; }
  /// Change of the pressures that the trial asks for [Pa]; `k`, `j` count pixels outside and inside
  /// pockets.
  double change_outside(std::size_t k) const {
    return trial_.outside[k] - now_.pressure.data()[outside_[k]];
  }
  double change_inside(std::size_t j) const {
    return trial_.inside[j] - now_.pressure.data()[pockets_.pixels[j]];
  }
  /// Sum of the trial's changes times a map.
  double along_trial(const FieldF& map) const {
    return sum_over(outside_.size(),
                    [&](std::size_t k) {
                      return change_outside(k) * static_cast<double>(map.data()[outside_[k]]);
                    }) +
           sum_over(pockets_.pixels.size(), [&](std::size_t j) {
             return change_inside(j) * static_cast<double>(map.data()[pockets_.pixels[j]]);
           });
  }

  elastic::ElasticOperator& elasticity_;
  const LoadProblem& problem_;
  const SealedPockets& liquid_;
  const Pockets& pockets_;
  double cap_;        // [Pa]
  double load_;       // sum of pressures [Pa]
  double gap_scale_;  // of the duality gap [Pa m]
  IterateConditions conditions_;
  LiquidEnergy energy_;
  Pouring pouring_;
  SearchDirection direction_;
  Convergence convergence_;

  Iterate now_;
  double next_lambda_ = 0;      // that of the last step
  std::vector<double> piston_;  // t_k [Pa/m]
  double piston_factor_ = 1;
  double slower_ = 1;  // factor of steps that are taken pixel by pixel

  FieldF work_;       // r on the active set, then dp, then S dp
  FieldF response_;   // S dp of the last step [m]
  FieldF previous_;   // direction of the last step [Pa], 0 where it moved nothing
  FieldF change_;     // dp of the last step [Pa]
  PixelList active_;  // solid contact that may move
  std::vector<std::uint8_t> is_active_;  // of all pixels
  PixelList outside_;                    // pixels outside pockets that may move
  double outside_below_ = 0;             // all whose v lies below are among them [m]
  Wanted trial_;
  std::vector<double> trial_levels_;
  double step_ = 1;             // tau
  double step_curvature_ = 0;   // of the step before, on solid contact [Pa m]
  double whole_curvature_ = 0;  // of the step before, <dp, S dp> [Pa m]
  double refresh_below_ = kFirstRefresh;
  bool residual_is_fresh_ = false;
  double best_certificate_ = std::numeric_limits<double>::infinity();
  int best_iteration_ = 0;
  int n_compact_steps_ = 0;
};

/// v = S p - h in double precision.
void TwoMetricGradient::refresh() {
  elasticity_.apply(now_.pressure, now_.v);
  for_each(now_.v.size(), [&](Index i) { now_.v(i) -= problem_.height(i); });
  convergence_.operator_applications += 1;
  convergence_.fft_pairs += 1;
  residual_is_fresh_ = true;
}

/// Pixels outside pockets that carry pressure, or that a change of the separation might press.
void TwoMetricGradient::collect_outside(double lambda) {
  const double highest = lambda + kMargin * gap_scale_ / load_;
  outside_ = list_where(now_.pressure.size(), [&](Index i) {
    return pockets_.of[static_cast<std::size_t>(i)] == kNoPocket &&
           (touches(now_.pressure(i)) || now_.v(i) < highest);
  });
  outside_below_ = highest;
}

/// The certificate by the best of a few multipliers; the best stays.
void TwoMetricGradient::certify() {
  collect_outside(now_.lambda);
  const double centre = conditions_.multiplier(now_, outside_);
  const double before = now_.lambda;
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](double lambda) {
    if (!std::isfinite(lambda)) return;
    if (lambda > outside_below_) {  // pixels that are not among those outside would count
      collect_outside(lambda);
    }
    const double gap =
        energy_.duality_gap(now_.pressure, now_.v, outside_, lambda, now_.levels, liquid_.seals);
    if (gap < least) {
      least = gap;
      now_.lambda = lambda;
    }
  };
  consider(centre);
  if (std::isfinite(cap_)) {
    if (convergence_.iterations > 0) {
      consider(before);
      consider(next_lambda_);
    }
  } else {
    consider(extent_of(now_.v).lowest);
    if (std::isfinite(centre)) now_.lambda = centre;  // the bound alone needs the lowest
  }
  convergence_.certificate = std::max(0.0, least / gap_scale_);
  if (convergence_.certificate < best_certificate_) {
    best_certificate_ = convergence_.certificate;
    best_iteration_ = convergence_.iterations;
  }
}

bool TwoMetricGradient::meets_conditions() {
  constexpr int most_rounds = 5;
  for (int round = 0; round < most_rounds; ++round) {
    if (!(convergence_.certificate <= problem_.tolerance)) return false;
    const double moved = conditions_.settle(now_);
    if (moved > kMostSettled) return false;
    if (moved == 0) return conditions_.gap_error(now_) <= conditions_.gap_limit();
    refresh();
    certify();
  }
  return conditions_.gap_error(now_) <= conditions_.gap_limit();
}

bool TwoMetricGradient::ends(const Observer& observer) {
  if (meets_conditions()) {
    convergence_.status = Status::converged;
  } else if (convergence_.iterations - best_iteration_ > kPatience) {
    convergence_.status = Status::stalled;
  }
  const bool is_last = convergence_.status != Status::iteration_limit ||
                       convergence_.iterations >= problem_.max_iterations;
  if (!asks_to_stop(observer, {.stage = "trapped oil", .convergence = &convergence_})) {
    return is_last;
  }
  convergence_.status = Status::stopped;
  return true;
}

/// Solid contact inside its bounds, or pressed off the bound that it is at. Pixels at the level of
/// liquid move with the liquid.
void TwoMetricGradient::choose_active_set() {
  for (const std::uint32_t i : active_) is_active_[i] = 0;
  active_ = list_where(now_.pressure.size(), [&](Index i) {
    const auto pixel = static_cast<std::size_t>(i);
    const double p = now_.pressure(i);
    const double residual = r(pixel);
    if (p >= cap_ && residual <= 0) return false;
    if (pockets_.of[pixel] != kNoPocket) return !at_level(p, conditions_.level_under(now_, pixel));
    return touches(p) || residual < 0;
  });
  for (const std::uint32_t i : active_) is_active_[i] = 1;
}

void TwoMetricGradient::find_direction() {
  for_each(work_.size(), [&](Index i) { work_(i) = 0; });
  for_each(active_.size(),
           [&](std::size_t k) { work_.data()[active_[k]] = static_cast<float>(r(active_[k])); });
  direction_.find(
      active_, work_, step_, cap_, [&](std::size_t k) { return now_.pressure.data()[active_[k]]; },
      [&](std::size_t k) { return conditions_.level_under(now_, active_[k]); });
}

/// tau = <dp, S dp> / <S dp, M S dp> on solid contact; M S dp is the change of the direction.
void TwoMetricGradient::choose_step() {
  const auto response = [&](std::size_t k) { return response_.data()[active_[k]]; };
  const auto previous = [&](std::size_t k) { return previous_.data()[active_[k]]; };
  const double curvature = direction_.curvature_of_change(response, previous);
  if (step_curvature_ > 0 && curvature > 0) {
    step_ = std::clamp(step_curvature_ / curvature, kLeastStep, kMostStep);
  }
}

/// Share of the last step that makes the trial conjugate to it: <S dp_last, trial + share dp_last>
/// vanishes.
double TwoMetricGradient::conjugate_share() const {
  if (!(whole_curvature_ > 0)) return 0;
  return std::min(-along_trial(response_) / whole_curvature_, kMostMomentum);
}

/// Adds that share to a trial which leads downhill, as the conjugate gradients of the dry solver
/// do; not where it then leads uphill. Returns the slope, as project_step().
double TwoMetricGradient::add_momentum(double slope) {
  const double share = conjugate_share();
  if (!(share > kLeastMomentum)) return slope;
  const double with_momentum = project_step(Metric::preconditioned, share);
  return with_momentum < 0 ? with_momentum : project_step(Metric::preconditioned);
}

/// Tries a step and a share of the last one: trial_ and trial_levels_, dp into work_. Returns the
/// slope of the energy along it [Pa m]; a positive one where nothing could be tried.
double TwoMetricGradient::project_step(Metric metric, double momentum) {
  const std::vector<float>& direction = direction_.whole();
  const double alone = direction_.diagonal() * slower_;
  if (metric != Metric::scalar) {
    for_each(active_.size(), [&](std::size_t k) { work_.data()[active_[k]] = direction[k]; });
  }
  const auto carried_on = [&](std::size_t i) {
    return momentum > 0 ? momentum * static_cast<double>(change_.data()[i]) : 0.0;
  };
  trial_.outside.resize(outside_.size());
  for_each(outside_.size(), [&](std::size_t k) {
    const std::size_t i = outside_[k];
    const double change = metric == Metric::scalar || !is_active_[i]
                              ? alone * r(i)
                              : step_ * static_cast<double>(work_.data()[i]);
    trial_.outside[k] = now_.pressure.data()[i] - change + carried_on(i);
  });
  trial_.inside.resize(pockets_.pixels.size());
  std::vector<double> steps(pockets_.size());
  for_each(pockets_.size(), [&](std::size_t k) {
    steps[k] = metric == Metric::scalar ? alone : piston_[k] * piston_factor_;
    for (std::size_t j = pockets_.first[k]; j < pockets_.first[k + 1]; ++j) {
      const std::size_t i = pockets_.pixels[j];
      const double change = metric == Metric::scalar || !is_active_[i]
                                ? steps[k] * r(i)
                                : step_ * static_cast<double>(work_.data()[i]);
      trial_.inside[j] = now_.pressure.data()[i] - change + carried_on(i);
    }
  });
  trial_.step = alone;
  const double moving =
      sum_over(outside_.size(), [&](std::size_t k) { return now_.pressure.data()[outside_[k]]; }) +
      sum_over(pockets_.pixels.size(),
               [&](std::size_t j) { return now_.pressure.data()[pockets_.pixels[j]]; });
  trial_levels_ = now_.levels;
  const auto shift = pouring_.project(steps, liquid_.seals, moving, trial_, trial_levels_);
  if (!shift) return 1;
  next_lambda_ = now_.lambda - *shift / alone;
  for_each(work_.size(), [&](Index i) { work_(i) = 0; });
  const auto change_of = [&](std::size_t i, double trial) {
    const double change = trial - now_.pressure.data()[i];
    work_.data()[i] = static_cast<float>(change);
    return change * r(i);
  };
  const double slope =
      sum_over(outside_.size(),
               [&](std::size_t k) { return change_of(outside_[k], trial_.outside[k]); }) +
      sum_over(pockets_.pixels.size(),
               [&](std::size_t j) { return change_of(pockets_.pixels[j], trial_.inside[j]); });
  return slope + energy_.of_liquid(trial_levels_) - energy_.of_liquid(now_.levels);
}

/// Returns false if no step leads downhill.
bool TwoMetricGradient::move() {
  slower_ = 1;
  double slope = project_step(Metric::preconditioned);
  if (slope < 0) {
    slope = add_momentum(slope);
  } else {
    direction_.drop_long_waves();
    slope = project_step(Metric::preconditioned);
    n_compact_steps_ += 1;
  }
  constexpr int most_halvings = 10;
  for (int i = 0; slope >= 0 && i < most_halvings; ++i) {
    slope = project_step(Metric::scalar);
    if (slope >= 0) slower_ *= 0.5;
    direction_.clear();
  }
  if (slope >= 0) return false;
  elasticity_.apply(work_, work_);
  convergence_.operator_applications += 1;
  convergence_.fft_pairs += 1;
  const double curvature = along_trial(work_);
  const double free_length = curvature > 0 ? -slope / curvature : 2;
  const double length = std::min(1.0, free_length);
  whole_curvature_ = length * length * curvature;
  accept(length);
  piston_factor_ = std::clamp(piston_factor_ * (free_length > 1        ? kLonger
                                                : free_length < kShort ? kShorter
                                                                       : 1.0),
                              kLeastPiston, kMostPiston);
  return true;
}

/// p += length dp, v += length S dp; a whole step lands on the bounds exactly.
void TwoMetricGradient::accept(double length) {
  // The part of the curvature that solid contact has: where the last step began.
  for_each(previous_.size(), [&](Index i) { previous_(i) = 0; });
  for_each(active_.size(),
           [&](std::size_t k) { previous_.data()[active_[k]] = direction_.whole()[k]; });
  for_each(change_.size(), [&](Index i) { change_(i) = 0; });
  const auto factor = static_cast<float>(length);
  for_each(response_.size(), [&](Index i) {
    response_(i) = work_(i) * factor;
    now_.v(i) += static_cast<double>(response_(i));
  });
  const auto stepped = [length](double before, double trial) {
    return length == 1 ? trial : before + length * (trial - before);
  };
  step_curvature_ = sum_over(outside_.size(), [&](std::size_t k) {
    double& p = now_.pressure.data()[outside_[k]];
    const double after = std::clamp(stepped(p, trial_.outside[k]), 0.0, cap_);
    const double change = after - p;
    change_.data()[outside_[k]] = static_cast<float>(change);
    p = after;
    return change * static_cast<double>(response_.data()[outside_[k]]);
  });
  step_curvature_ += sum_over(pockets_.pixels.size(), [&](std::size_t j) {
    const std::size_t i = pockets_.pixels[j];
    double& p = now_.pressure.data()[i];
    const double after = std::clamp(stepped(p, trial_.inside[j]), 0.0, cap_);
    const double change = after - p;
    change_.data()[i] = static_cast<float>(change);
    p = after;
    return is_active_[i] ? change * static_cast<double>(response_.data()[i]) : 0.0;
  });
  now_.levels = length == 1 ? trial_levels_ : energy_.best_levels(now_.pressure, liquid_.seals);
  residual_is_fresh_ = false;
}

SealedState TwoMetricGradient::run(const State& start, const std::vector<double>& levels,
                                   const Observer& observer) {
  const Index ny = problem_.height.rows();
  const Index nx = problem_.height.cols();
  now_.pressure = map_of(ny, nx, [&](Index i) { return start.pressure(i); });
  now_.v = map_of(ny, nx, [&](Index i) { return start.displacement(i) - problem_.height(i); });
  residual_is_fresh_ = true;
  if (conditions_.let_down(levels, now_.pressure)) refresh();
  now_.levels = energy_.best_levels(now_.pressure, liquid_.seals);
  now_.lambda = -start.separation;
  certify();
  SealedState state;
  const bool has_no_level =
      std::all_of(now_.levels.begin(), now_.levels.end(), [](double m) { return m == 0; });
  if (has_no_level && convergence_.certificate <= problem_.tolerance) {
    state.contact = start;
    state.levels = now_.levels;
    state.is_start = true;
    return state;
  }
  for (FieldF* map : {&work_, &response_, &previous_, &change_}) {
    *map = uninitialised_map<FieldF>(ny, nx);
    for_each(map->size(), [map](Index i) { (*map)(i) = 0; });
  }
  is_active_.assign(static_cast<std::size_t>(now_.pressure.size()), 0);
  while (true) {
    if (convergence_.iterations > 0) certify();
    if (convergence_.certificate <= std::max(refresh_below_, problem_.tolerance) &&
        !residual_is_fresh_) {
      refresh_below_ = std::min(refresh_below_, convergence_.certificate) * kNextRefresh;
      refresh();
      certify();
    }
    if (ends(observer)) break;
    choose_active_set();
    find_direction();
    if (convergence_.iterations > 0) choose_step();
    if (!move()) {
      convergence_.status = Status::stalled;
      break;
    }
    convergence_.iterations += 1;
  }
  if (!residual_is_fresh_) {
    refresh();
    certify();
    if (!convergence_.stopped() && meets_conditions()) convergence_.status = Status::converged;
  }
  State& contact = state.contact;
  contact.gap_error = conditions_.gap_error(now_);
  contact.gap_limit = conditions_.gap_limit();
  contact.separation = -now_.lambda;
  contact.mean_pressure = problem_.mean_pressure;
  contact.convergence = convergence_;
  contact.compact_steps = n_compact_steps_;
  contact.gap = map_of(ny, nx, [&](Index i) { return now_.v(i) - now_.lambda; });
  for_each(now_.v.size(), [&](Index i) { now_.v(i) += problem_.height(i); });
  contact.displacement = std::move(now_.v);
  contact.pressure = std::move(now_.pressure);
  state.levels = now_.levels;
  return state;
}

}  // namespace

SealedState solve_sealed(elastic::ElasticOperator& elasticity, const LoadProblem& problem,
                         const SealedPockets& liquid, const State& start,
                         const std::vector<double>& levels, const Observer& observer) {
  return TwoMetricGradient(elasticity, problem, liquid).run(start, levels, observer);
}

}  // namespace tabor::contact
