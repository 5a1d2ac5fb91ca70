#include "tabor/contact/fast_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "tabor/contact/certificate.hpp"
#include "tabor/contact/preconditioner.hpp"
#include "tabor/contact/projection.hpp"
#include "tabor/contact/scale.hpp"
#include "tabor/contact/start.hpp"
#include "tabor/core/parallel.hpp"

namespace tabor::contact {
namespace {

constexpr double kFirstRefresh = 1e-5;  // certificate below which v is computed afresh in double
constexpr double kNextRefresh = 1e-4;   // ... and again each time it fell by this factor
constexpr int kPatience = 300;          // iterations without a better certificate before giving up
constexpr double kUnknownFraction = std::numeric_limits<double>::quiet_NaN();

/// Projected gradient on the pressure with one operator application an iteration:
///
///     p <- clip(p - tau M (v - sep) - shift, 0, p_sat),    v = S p - z
///
/// M: Preconditioner on the pixels that may move; sep: separation for which the diagonally
/// preconditioned step carries the load; tau: second Barzilai & Borwein (1988) step in the metric
/// of M; shift: exact load. v follows by S dp in single precision, p and v are kept in double and v
/// is computed afresh when the certificate has become small (docs/theory.md, "Fast solver").
class ProjectedGradient {
 public:
  ProjectedGradient(elastic::ElasticOperator& elasticity, const Problem& problem)
      : elasticity_(elasticity),
        problem_(problem),
        cap_(problem.saturation_pressure),
        load_(problem.mean_pressure * static_cast<double>(problem.height.size())),
        scale_(problem.mean_pressure * length_scale(elasticity, problem) *
               static_cast<double>(problem.height.size())),
        preconditioner_(elasticity.grid(), elasticity.effective_modulus(),
                        elasticity.drops_mean()) {
    convergence_.tolerance = problem.tolerance;
  }

  State run(const Observer& observer);

 private:
  void refresh();
  void collect_candidates();
  void certify();
  void find_separation();
  void choose_active_set();
  void find_direction();
  void choose_step();
  bool move();
  void accept(double length);
  Index size() const { return pressure_.size(); }

  elastic::ElasticOperator& elasticity_;
  const Problem& problem_;
  double cap_;    // [Pa]
  double load_;   // sum of pressures [Pa]
  double scale_;  // of the duality gap [Pa m]
  Preconditioner preconditioner_;
  Convergence convergence_;

  Field pressure_;             // p [Pa]
  Field residual_;             // v = S p - z [m]
  FieldF increment_;           // dp, then S dp
  FieldF active_residual_;     // v - sep on the active set, 0 elsewhere
  FieldF previous_direction_;  // M (v - sep) of the step before, 0 off its set
  PixelList candidate_pixels_;
  Candidates candidates_;
  PixelList active_;
  PixelList previous_active_;
  std::vector<float> direction_;  // M (v - sep) on the active set [Pa]
  std::vector<double> trial_;     // pressures tried on the active set [Pa]
  double separation_ = 0;         // [m], in the units of v
  double step_ = 1;               // tau
  double step_curvature_ = 0;     // <dp, S dp> of the step before [Pa m]
  double refresh_below_ = kFirstRefresh;
  bool residual_is_fresh_ = false;
  double best_certificate_ = std::numeric_limits<double>::infinity();
  int best_iteration_ = 0;
};

/// v = S p - z in double precision.
void ProjectedGradient::refresh() {
  elasticity_.apply(pressure_, residual_);
  const double* height = problem_.height.data();
  parallel_for(size(), kBlock, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      residual_.data()[i] -= height[i];
    }
  });
  convergence_.operator_applications += 1;
  convergence_.fft_pairs += 1;
  residual_is_fresh_ = true;
}

/// A pixel without pressure can only matter if its v is at most the largest v in contact.
void ProjectedGradient::collect_candidates() {
  const double* p = pressure_.data();
  const double* v = residual_.data();
  const double largest = parallel_max(size(), [&](Index begin, Index end) {
    double block_largest = -std::numeric_limits<double>::infinity();
    for (Index i = begin; i < end; ++i) {
      block_largest =
          std::max(block_largest, p[i] > 0 ? v[i] : -std::numeric_limits<double>::infinity());
    }
    return block_largest;
  });
  const Index n_blocks = (size() + kBlock - 1) / kBlock;
  std::vector<PixelList> lists(static_cast<std::size_t>(n_blocks));
  parallel_for(n_blocks, 1, [&](Index block, Index) {
    PixelList& list = lists[static_cast<std::size_t>(block)];
    for (Index i = block * kBlock; i < std::min(size(), (block + 1) * kBlock); ++i) {
      if (p[i] > 0 || v[i] <= largest) {
        list.push_back(static_cast<std::uint32_t>(i));
      }
    }
  });
  candidate_pixels_.clear();
  candidates_.pressure.clear();
  candidates_.residual.clear();
  for (const PixelList& list : lists) {
    for (const std::uint32_t pixel : list) {
      candidate_pixels_.push_back(pixel);
      candidates_.pressure.push_back(p[pixel]);
      candidates_.residual.push_back(v[pixel]);
    }
  }
}

/// Certificate of contact.md section 2; infinite if the pressure does not carry the load exactly.
void ProjectedGradient::certify() {
  double carried = 0;
  for (const double pressure : candidates_.pressure) {
    carried += pressure;
  }
  convergence_.certificate = std::abs(carried / load_ - 1) <= 1e-10
                                 ? std::max(0.0, duality_gap(candidates_, load_, cap_) / scale_)
                                 : std::numeric_limits<double>::infinity();
  if (convergence_.certificate < best_certificate_) {
    best_certificate_ = convergence_.certificate;
    best_iteration_ = convergence_.iterations;
  }
}

/// sep with sum clip(p - t (v - sep), 0, p_sat) = load, t the diagonal step. It is the mean of v
/// over an elastic contact and the threshold of the bearing area in a saturated one.
void ProjectedGradient::find_separation() {
  const double diagonal_step = step_ * preconditioner_.diagonal();
  trial_.resize(candidates_.pressure.size());
  for (std::size_t k = 0; k < trial_.size(); ++k) {
    trial_[k] = candidates_.pressure[k] - diagonal_step * candidates_.residual[k];
  }
  separation_ = -shift_for_load(trial_, load_, cap_) / diagonal_step;
}

/// Pixels that may move: strictly inside the bounds, or at a bound and pulled inside.
void ProjectedGradient::choose_active_set() {
  std::swap(active_, previous_active_);
  active_.clear();
  for (const std::uint32_t pixel : previous_active_) {
    active_residual_.data()[pixel] = 0;
  }
  for (std::size_t k = 0; k < candidate_pixels_.size(); ++k) {
    const double p = candidates_.pressure[k];
    const double v = candidates_.residual[k] - separation_;
    if ((p > 0 || v < 0) && (p < cap_ || v > 0)) {
      active_.push_back(candidate_pixels_[k]);
      active_residual_.data()[candidate_pixels_[k]] = static_cast<float>(v);
    }
  }
}

void ProjectedGradient::find_direction() {
  const double pairs_before = preconditioner_.fft_pairs();
  preconditioner_.apply(active_, active_residual_, direction_);
  convergence_.fft_pairs += preconditioner_.fft_pairs() - pairs_before;
}

/// tau = <dp, S dp> / <S dp, M S dp>; M S dp is the change of the direction since the last step.
/// increment_ still holds S dp.
void ProjectedGradient::choose_step() {
  double mean = 0;
  for (const std::uint32_t pixel : active_) {
    mean += increment_.data()[pixel];
  }
  mean /= static_cast<double>(active_.size());
  double curvature = 0;
  for (std::size_t k = 0; k < active_.size(); ++k) {
    const double change =
        static_cast<double>(direction_[k]) - previous_direction_.data()[active_[k]];
    curvature += change * (increment_.data()[active_[k]] - mean);
  }
  if (step_curvature_ > 0 && curvature > 0) {
    step_ = step_curvature_ / curvature;
  }
}

/// Projects the step on bounds and load, applies the operator to it, and shortens it to the minimum
/// of the energy along it where it overshoots. Returns false if nothing moved.
bool ProjectedGradient::move() {
  double active_load = 0;
  trial_.resize(active_.size());
  for (std::size_t k = 0; k < active_.size(); ++k) {
    const double p = pressure_.data()[active_[k]];
    active_load += p;
    trial_[k] = p - step_ * static_cast<double>(direction_[k]);
  }
  project_on_load(trial_, active_load, cap_);

  increment_.setZero();
  double slope = 0;  // of the energy along dp [Pa m]
  double largest = 0;
  for (std::size_t k = 0; k < active_.size(); ++k) {
    const std::uint32_t pixel = active_[k];
    const double change = trial_[k] - pressure_.data()[pixel];
    increment_.data()[pixel] = static_cast<float>(change);
    slope += change * (residual_.data()[pixel] - separation_);
    largest = std::max(largest, std::abs(change));
  }
  if (largest == 0) {
    return false;
  }
  elasticity_.apply(increment_, increment_);
  convergence_.operator_applications += 1;
  convergence_.fft_pairs += 1;

  double curvature = 0;
  for (std::size_t k = 0; k < active_.size(); ++k) {
    curvature += (trial_[k] - pressure_.data()[active_[k]]) * increment_.data()[active_[k]];
  }
  const double length = (slope < 0 && slope + 0.5 * curvature > 0) ? -slope / curvature : 1.0;
  accept(length);
  step_curvature_ = length * length * curvature;
  return true;
}

/// p += length * dp and v += length * S dp; a whole step lands on the bounds exactly.
void ProjectedGradient::accept(double length) {
  for (const std::uint32_t pixel : previous_active_) {
    previous_direction_.data()[pixel] = 0;
  }
  for (std::size_t k = 0; k < active_.size(); ++k) {
    double& p = pressure_.data()[active_[k]];
    p = length == 1 ? trial_[k] : std::clamp(p + length * (trial_[k] - p), 0.0, cap_);
    previous_direction_.data()[active_[k]] = direction_[k];
  }
  const auto factor = static_cast<float>(length);
  parallel_for(size(), kBlock, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      increment_.data()[i] *= factor;
      residual_.data()[i] += static_cast<double>(increment_.data()[i]);
    }
  });
  residual_is_fresh_ = false;
}

State ProjectedGradient::run(const Observer& observer) {
  const Index ny = problem_.height.rows();
  const Index nx = problem_.height.cols();
  pressure_ = starting_pressure(elasticity_, problem_, convergence_.fft_pairs);
  refresh();
  increment_.resize(ny, nx);
  active_residual_ = FieldF::Zero(ny, nx);
  previous_direction_ = FieldF::Zero(ny, nx);

  while (true) {
    collect_candidates();
    certify();
    if (convergence_.certificate <= std::max(refresh_below_, problem_.tolerance) &&
        !residual_is_fresh_) {
      // Single precision alone reports certificates that are too good.
      refresh_below_ = std::min(refresh_below_, convergence_.certificate) * kNextRefresh;
      refresh();
      continue;
    }
    convergence_.converged = convergence_.certificate <= problem_.tolerance;
    const bool give_up = convergence_.iterations >= problem_.max_iterations ||
                         convergence_.iterations - best_iteration_ > kPatience;
    const bool stop = observer && !observer({"contact", kUnknownFraction, &convergence_});
    if (convergence_.converged || give_up || stop) {
      break;
    }
    find_separation();
    choose_active_set();
    find_direction();
    if (convergence_.iterations > 0) {
      choose_step();
    }
    if (active_.empty() || !move()) {
      break;
    }
    convergence_.iterations += 1;
  }
  if (!residual_is_fresh_) {
    refresh();
    collect_candidates();
    certify();
    convergence_.converged = convergence_.certificate <= problem_.tolerance;
  }
  State state;
  state.pressure = std::move(pressure_);
  state.displacement = std::move(residual_);
  state.displacement += problem_.height;
  state.convergence = convergence_;
  return state;
}

}  // namespace

State solve_fast(elastic::ElasticOperator& elasticity, const Problem& problem,
                 const Observer& observer) {
  return ProjectedGradient(elasticity, problem).run(observer);
}

}  // namespace tabor::contact
