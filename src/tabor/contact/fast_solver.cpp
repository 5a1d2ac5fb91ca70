#include "tabor/contact/fast_solver.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "tabor/contact/candidate_set.hpp"
#include "tabor/contact/conditions.hpp"
#include "tabor/contact/listed_caps.hpp"
#include "tabor/contact/projection.hpp"
#include "tabor/contact/search_direction.hpp"
#include "tabor/contact/start.hpp"
#include "tabor/core/large_pages.hpp"
#include "tabor/core/loops.hpp"

namespace tabor::contact {
namespace {

// Length of a step over what its direction wanted: below, the direction followed pixels whose
// gap is far too large to be felt by others, and the next one looks at each pixel alone.
constexpr double kLeastLength = 1e-4;

/// A map of zeros, written on all threads.
FieldF zeros(Index ny, Index nx) {
  auto map = uninitialised_map<FieldF>(ny, nx);
  float* values = map.data();
  for_each(map.size(), [=](Index i) { values[i] = 0; });
  return map;
}

/// Projected gradient on the pressure with one operator application an iteration:
///
///     p <- clip(p - tau M (v - sep) - shift, 0, p_sat),    v = S p - z
///
/// M: Preconditioner with LongWaves on the pixels that may move; sep: separation for which the
/// diagonally preconditioned step carries the load; tau: second Barzilai & Borwein (1988) step in
/// the metric of M; shift: exact load. v follows by S dp in single precision, p and v are stored in
/// double and v is computed afresh when the certificate has become small (docs/theory.md, "Fast
/// solver").
class ProjectedGradient {
 public:
  ProjectedGradient(elastic::ElasticOperator& elasticity, const LoadProblem& problem)
      : elasticity_(elasticity),
        problem_(problem),
        caps_(problem.caps),
        conditions_(elasticity, problem),
        load_(conditions_.load()),
        direction_(elasticity) {
    convergence_.tolerance = problem.tolerance;
  }

  State run(const Observer& observer);

 private:
  void refresh();
  void certify();
  bool meets_conditions();
  bool ends(const Observer& observer);
  void find_separation();
  void choose_active_set();
  void find_direction();
  void choose_step();
  double project_step();
  bool move();
  void accept(double length);
  template <typename Residual, typename Update>
  void collect(const Residual& residual, FieldF* change, const Update& update);
  ListedCaps caps_of_candidates() const { return {caps_, candidates_.pixels}; }
  double pressure(std::size_t k) const { return candidates_.values.pressure[places_[k]]; }
  double residual(std::size_t k) const { return candidates_.values.residual[places_[k]]; }

  elastic::ElasticOperator& elasticity_;
  const LoadProblem& problem_;
  Caps caps_;  // of the map [Pa]
  Conditions conditions_;
  double load_;                // sum of pressures [Pa]
  SearchDirection direction_;  // M (v - sep) [Pa]
  Convergence convergence_;

  Field residual_;  // v = S p - z [m]
  FieldF work_;     // v - sep on the active set, then dp, then S dp; 0 elsewhere but for S dp
  CandidateSet candidates_;
  // On the active set, in its order:
  PixelList places_;           // among the candidates
  PixelList active_;           // pixels
  std::vector<double> trial_;  // pressures tried [Pa]
  double separation_ = 0;      // [m], in the units of v
  double relaxed_shift_ = 0;   // of trial_, by which it carries the load [Pa]
  bool goes_alone_ = false;    // the next direction leaves neighbours alone
  double step_ = 1;            // tau
  double step_curvature_ = 0;  // <dp, S dp> of the step before [Pa m]
  double refresh_below_ = kFirstRefresh;
  bool residual_is_fresh_ = false;
  int n_compact_steps_ = 0;
  double best_certificate_ = std::numeric_limits<double>::infinity();
  int best_iteration_ = 0;
};

/// v = S p - z in double precision.
void ProjectedGradient::refresh() {
  spread_pressure(candidates_, residual_);
  elasticity_.apply(residual_, residual_);
  double* v = residual_.data();
  const double* height = problem_.height.data();
  collect([&](std::uint32_t pixel) { return v[pixel] - height[pixel]; }, nullptr,
          [=](Index i) { v[i] -= height[i]; });
  convergence_.operator_applications += 1;
  convergence_.fft_pairs += 1;
  residual_is_fresh_ = true;
}

/// Brings v up to date by update(pixel) and collects the candidates in the same pass.
/// residual(pixel) is what v will be, change the S dp that it changes by.
template <typename Residual, typename Update>
void ProjectedGradient::collect(const Residual& residual, FieldF* change, const Update& update) {
  direction_.free_memory();
  release(trial_);
  for_each(candidates_.size(), [&](std::size_t k) {
    candidates_.values.residual[k] = residual(candidates_.pixels[k]);
  });
  const double threshold =
      candidate_threshold(candidates_, load_, caps_, step_ * direction_.diagonal());
  collect_candidates(residual_, change, threshold, update, candidates_);
}

void ProjectedGradient::certify() {
  convergence_.certificate = conditions_.certificate(candidates_.values, caps_of_candidates());
  if (convergence_.certificate < best_certificate_) {
    best_certificate_ = convergence_.certificate;
    best_iteration_ = convergence_.iterations;
  }
}

/// True if the answer is good enough; moves pixels that are hardly inside their bounds onto them.
bool ProjectedGradient::meets_conditions() {
  std::vector<double>& pressure = candidates_.values.pressure;
  const std::vector<double>& residual = candidates_.values.residual;
  auto settled = Conditions::Settled::now;
  while (settled == Conditions::Settled::now && convergence_.certificate <= problem_.tolerance) {
    settled = conditions_.settle(pressure, residual, caps_of_candidates());
    if (settled == Conditions::Settled::now) {
      refresh();
      certify();
    }
  }
  return settled == Conditions::Settled::already &&
         conditions_.gaps_close(pressure, residual, caps_of_candidates());
}

/// sep with sum clip(p - t (v - sep), 0, p_sat) = load, t the diagonal step. It is the mean of v
/// over an elastic contact and the threshold of the bearing area in a saturated one.
void ProjectedGradient::find_separation() {
  const double diagonal_step = step_ * direction_.diagonal();
  const std::vector<double>& pressure = candidates_.values.pressure;
  const std::vector<double>& residual = candidates_.values.residual;
  trial_.resize(pressure.size());
  for_each(trial_.size(),
           [&](std::size_t k) { trial_[k] = pressure[k] - diagonal_step * residual[k]; });
  relaxed_shift_ = shift_for_load(trial_, load_, caps_of_candidates());
  separation_ = -relaxed_shift_ / diagonal_step;
}

/// Pixels that may move: inside the bounds, or relaxed off the bound they are at. The relaxed
/// pressure, not v - sep, whose last digits say nothing where heights are far larger than
/// displacements.
void ProjectedGradient::choose_active_set() {
  places_ = list_where(static_cast<Index>(candidates_.size()), [&](Index i) {
    const auto k = static_cast<std::size_t>(i);
    const double p = candidates_.values.pressure[k];
    const double relaxed = trial_[k] - relaxed_shift_;
    const double cap = caps_(candidates_.pixels[k]);
    return (touches(p) || touches(relaxed)) && (p < cap || relaxed < cap);
  });
  active_.resize(places_.size());
  for_each(active_.size(), [&](std::size_t k) { active_[k] = candidates_.pixels[places_[k]]; });
}

void ProjectedGradient::find_direction() {
  for_each(active_.size(), [&](std::size_t k) {
    work_.data()[active_[k]] = static_cast<float>(residual(k) - separation_);
  });
  if (goes_alone_) return direction_.find_alone(active_, work_);
  direction_.find(
      active_, work_, step_, ListedCaps(caps_, active_), [&](std::size_t k) { return pressure(k); },
      [](std::size_t) { return 0.0; });
}

/// tau = <dp, S dp> / <S dp, M S dp>; M S dp is the change of the direction since the last step.
void ProjectedGradient::choose_step() {
  const auto response = [&](std::size_t k) { return candidates_.response[places_[k]]; };
  const auto previous = [&](std::size_t k) { return candidates_.direction[places_[k]]; };
  const double curvature = direction_.curvature_of_change(response, previous);
  if (step_curvature_ > 0 && curvature > 0) step_ = step_curvature_ / curvature;
}

/// Tries a step along the direction: trial_ within bounds and load, dp into work_. Returns the
/// slope of the energy along dp [Pa m].
double ProjectedGradient::project_step() {
  const double active_load = sum_over(active_.size(), [&](std::size_t k) { return pressure(k); });
  trial_.resize(active_.size());
  for_each(active_.size(), [&](std::size_t k) {
    trial_[k] = pressure(k) - step_ * static_cast<double>(direction_.whole()[k]);
  });
  project_on_load(trial_, active_load, ListedCaps(caps_, active_));
  return sum_over(active_.size(), [&](std::size_t k) {
    const double change = trial_[k] - pressure(k);
    work_.data()[active_[k]] = static_cast<float>(change);
    return change * (residual(k) - separation_);
  });
}

/// Projects the step on bounds and load, applies the operator to it, and shortens it to the minimum
/// of the energy along it where it overshoots. Returns false if nothing moved.
bool ProjectedGradient::move() {
  double slope = project_step();
  if (slope >= 0) {  // bounds can turn a corrected direction uphill: leave long waves alone
    direction_.drop_long_waves();
    slope = project_step();
    n_compact_steps_ += 1;
  }
  const auto change = [&](std::size_t k) { return trial_[k] - pressure(k); };
  if (sum_over(active_.size(), [&](std::size_t k) { return std::abs(change(k)); }) == 0) {
    return false;
  }
  elasticity_.apply(work_, work_);
  convergence_.operator_applications += 1;
  convergence_.fft_pairs += 1;

  const double curvature = sum_over(active_.size(), [&](std::size_t k) {
    return change(k) * static_cast<double>(work_.data()[active_[k]]);
  });
  const double length = (slope < 0 && slope + 0.5 * curvature > 0) ? -slope / curvature : 1.0;
  accept(length);
  goes_alone_ = length < kLeastLength;
  step_ = goes_alone_ ? 1 : step_;
  step_curvature_ = goes_alone_ ? 0 : length * length * curvature;
  return true;
}

/// p += length * dp and v += length * S dp; a whole step lands on the bounds exactly.
void ProjectedGradient::accept(double length) {
  std::fill(candidates_.direction.begin(), candidates_.direction.end(), 0.0F);
  for_each(active_.size(), [&](std::size_t k) {
    double& p = candidates_.values.pressure[places_[k]];
    p = length == 1 ? trial_[k] : std::clamp(p + length * (trial_[k] - p), 0.0, caps_(active_[k]));
    candidates_.direction[places_[k]] = direction_.whole()[k];
  });
  const auto factor = static_cast<float>(length);
  double* v = residual_.data();
  float* response = work_.data();
  collect(
      [&](std::uint32_t pixel) { return v[pixel] + static_cast<double>(response[pixel] * factor); },
      &work_,
      [=](Index i) {
        response[i] *= factor;
        v[i] += static_cast<double>(response[i]);
      });
  residual_is_fresh_ = false;
}

/// True where this iteration is the last; the status then says why.
bool ProjectedGradient::ends(const Observer& observer) {
  if (convergence_.stopped()) return true;  // on a coarser grid
  if (meets_conditions()) {
    convergence_.status = Status::converged;
  } else if (convergence_.iterations - best_iteration_ > kPatience) {
    convergence_.status = Status::stalled;
  }
  const bool is_last = convergence_.status != Status::iteration_limit ||
                       convergence_.iterations >= problem_.max_iterations;
  if (!asks_to_stop(observer, {.stage = "contact", .convergence = &convergence_})) return is_last;
  convergence_.status = Status::stopped;
  return true;
}

State ProjectedGradient::run(const Observer& observer) {
  const Index ny = problem_.height.rows();
  const Index nx = problem_.height.cols();
  residual_ = starting_pressure(elasticity_, problem_, observer, convergence_);
  candidates_ = pressed_pixels(residual_);
  refresh();
  work_ = zeros(ny, nx);

  while (true) {
    certify();
    if (convergence_.certificate <= std::max(refresh_below_, problem_.tolerance) &&
        !residual_is_fresh_) {
      // Single precision alone reports certificates that are too good.
      refresh_below_ = std::min(refresh_below_, convergence_.certificate) * kNextRefresh;
      refresh();
      continue;
    }
    if (ends(observer)) break;
    find_separation();
    choose_active_set();
    if (active_.empty()) {
      convergence_.status = Status::stalled;
      break;
    }
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
  State state;
  work_ = FieldF();
  state.pressure = uninitialised_map<Field>(ny, nx);
  spread_pressure(candidates_, state.pressure);
  state.displacement = std::move(residual_);
  double* displacement = state.displacement.data();
  const double* height = problem_.height.data();
  for_each(static_cast<std::size_t>(state.displacement.size()),
           [=](std::size_t i) { displacement[i] += height[i]; });
  state.convergence = convergence_;
  state.compact_steps = n_compact_steps_;
  return state;
}

}  // namespace

State solve_fast(elastic::ElasticOperator& elasticity, const LoadProblem& problem,
                 const Observer& observer) {
  return ProjectedGradient(elasticity, problem).run(observer);
}

}  // namespace tabor::contact
