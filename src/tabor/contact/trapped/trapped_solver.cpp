#include "tabor/contact/trapped/trapped_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "tabor/contact/conditions.hpp"
#include "tabor/contact/long_waves.hpp"
#include "tabor/contact/preconditioner.hpp"
#include "tabor/contact/projection.hpp"
#include "tabor/contact/scale.hpp"
#include "tabor/contact/trapped/liquid_energy.hpp"
#include "tabor/contact/trapped/pouring.hpp"
#include "tabor/core/large_pages.hpp"
#include "tabor/elastic/half_space.hpp"

namespace tabor::contact {
namespace {

constexpr double kFirstRefresh = 1e-6;  // certificate below which v is computed afresh in double
constexpr double kNextRefresh = 1e-4;   // ... and again each time it fell by this factor
constexpr int kBlockRounds = 3;         // solutions for the long waves of one direction, at most
constexpr double kSettledShare = 1e-4;  // of the pixels changing between free and held: settled
constexpr int kPatience = 300;          // iterations without a better certificate
constexpr double kLeastStep = 0.05;     // of tau
constexpr double kMostStep = 20;
// Factor of the steps of pistons: longer where the minimum along a step lies behind its end.
constexpr double kLeastPiston = 0.25, kMostPiston = 32;
constexpr double kLonger = 1.5, kShorter = 0.5;
constexpr double kShort = 0.5;          // of a step to its minimum: it was too long
constexpr double kMargin = 0.05;        // of the length scale
constexpr double kFalseContact = 1000;  // as of a contact without liquid (conditions.cpp)
constexpr double kMostSettled = 1e-6;   // of the load

/// How a step is taken: with the whole metric, without its long waves, or pixel by pixel.
enum class Metric { whole, compact, scalar };

class TwoMetricGradient {
 public:
  TwoMetricGradient(elastic::ElasticOperator& elasticity, const LoadProblem& problem,
                    const SealedPockets& liquid)
      : elasticity_(elasticity),
        problem_(problem),
        liquid_(liquid),
        pockets_(liquid.pockets),
        cap_(problem.saturation_pressure),
        load_(problem.mean_pressure * static_cast<double>(problem.height.size())),
        gap_scale_(load_ * length_scale(elasticity, problem)),
        pixel_compliance_(elastic::love_coefficient(
            0, 0, elasticity.grid().dx(), elasticity.grid().dy(), elasticity.effective_modulus())),
        gap_limit_(Conditions(elasticity, problem).gap_limit()),
        energy_(pockets_, liquid.bulk_modulus, cap_, load_),
        pouring_(pockets_, liquid.bulk_modulus, cap_),
        preconditioner_(elasticity.grid(), elasticity.effective_modulus(), elasticity.drops_mean()),
        long_waves_(elasticity.grid(), elasticity.effective_modulus(), preconditioner_.plateau(),
                    elasticity.drops_mean()) {
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
  bool let_down(const std::vector<double>& levels);
  void refresh();
  void collect_outside(double lambda);
  void certify();
  bool ends(const Observer& observer);
  bool meets_conditions();
  double settle();
  double gap_error() const;
  void choose_active_set();
  void find_direction();
  void add_long_waves();
  double hold_at_bounds();
  void choose_step();
  double project_step(Metric metric);
  bool move();
  void accept(double length);
  double weighted_level() const;

  double level_under(std::size_t pixel) const {
    const std::int32_t pocket = pockets_.of[pixel];
    return pocket == kNoPocket ? 0 : levels_[static_cast<std::size_t>(pocket)];
  }
  double r(std::size_t pixel) const { return v_.data()[pixel] - lambda_; }

  elastic::ElasticOperator& elasticity_;
  const LoadProblem& problem_;
  const SealedPockets& liquid_;
  const Pockets& pockets_;
  double cap_;               // [Pa]
  double load_;              // sum of pressures [Pa]
  double gap_scale_;         // of the duality gap [Pa m]
  double pixel_compliance_;  // [m/Pa]
  double gap_limit_;         // [m]
  LiquidEnergy energy_;
  Pouring pouring_;
  Preconditioner preconditioner_;
  LongWaves long_waves_;
  Convergence convergence_;

  Field p_;                     // [Pa]
  Field v_;                     // S p - h [m]
  std::vector<double> levels_;  // pi_k [Pa]
  double lambda_ = 0;           // multiplier of the load: r = v - lambda [m]
  double next_lambda_ = 0;      // that of the last step
  std::vector<double> piston_;  // t_k [Pa/m]
  double piston_factor_ = 1;
  double slower_ = 1;  // factor of steps that are taken pixel by pixel

  FieldF work_;                   // r on the active set, then dp, then S dp
  FieldF response_;               // S dp of the last step [m]
  FieldF previous_;               // direction of the last step [Pa], 0 where it moved nothing
  PixelList active_;              // solid contact that may move
  std::vector<float> direction_;  // [Pa], on the active set
  std::vector<float> compact_direction_;  // the same without long waves
  std::vector<float> stiffness_;          // row sums of the compact kernel [Pa/m]
  std::vector<float> moved_;              // direction as far as bounds let it through [Pa]
  std::vector<std::uint8_t> is_active_;   // of all pixels
  PixelList outside_;                     // pixels outside pockets that may move
  double outside_below_ = 0;              // all whose v lies below are among them [m]
  Wanted trial_;
  std::vector<double> trial_levels_;
  double step_ = 1;            // tau
  double step_curvature_ = 0;  // of the step before, on solid contact [Pa m]
  double refresh_below_ = kFirstRefresh;
  bool residual_is_fresh_ = false;
  double best_certificate_ = std::numeric_limits<double>::infinity();
  int best_iteration_ = 0;
  int n_compact_steps_ = 0;
};

/// v = S p - h in double precision.
void TwoMetricGradient::refresh() {
  elasticity_.apply(p_, v_);
  for_each(v_.size(), [&](Index i) { v_(i) -= problem_.height(i); });
  convergence_.operator_applications += 1;
  convergence_.fft_pairs += 1;
  residual_is_fresh_ = true;
}

/// Mean of v over solid contact inside its bounds, each pixel weighted by its distance from them:
/// the separation with the opposite sign. Without such contact, the mean of what the squeezed
/// pockets say by their volume, else the last contact to open; NaN without any.
double TwoMetricGradient::weighted_level() const {
  const auto weight = [&](Index i) {
    const double p = p_(i);
    if (!touches(p) || at_cap(p, cap_)) return 0.0;
    const double over = p - level_under(static_cast<std::size_t>(i));
    return std::max(over, 0.0) * (1 - p / cap_);
  };
  const double total = sum_over(p_.size(), weight);
  if (total > 0) return sum_over(p_.size(), [&](Index i) { return weight(i) * v_(i); }) / total;
  double excess = 0;  // of v over what the liquid fills
  double n_liquid = 0;
  for (std::size_t k = 0; k < pockets_.size(); ++k) {
    if (levels_[k] == 0 || at_level(liquid_.seals[k], levels_[k])) continue;  // says nothing
    excess -= pockets_.volume[k] * (1 - levels_[k] / liquid_.bulk_modulus);
    for (std::size_t j = pockets_.first[k]; j < pockets_.first[k + 1]; ++j) {
      const std::size_t i = pockets_.pixels[j];
      if (!at_level(p_.data()[i], levels_[k])) continue;
      excess += v_.data()[i];
      n_liquid += 1;
    }
  }
  if (n_liquid > 0) return excess / n_liquid;
  constexpr double none = -std::numeric_limits<double>::infinity();
  return max_over(p_.size(), [&](Index i) {
    const bool is_solid =
        touches(p_(i)) && !at_level(p_(i), level_under(static_cast<std::size_t>(i)));
    return is_solid ? v_(i) : none;
  });
}

/// Pixels outside pockets that carry pressure, or that a change of the separation might press.
void TwoMetricGradient::collect_outside(double lambda) {
  const double highest = lambda + kMargin * gap_scale_ / load_;
  outside_ = list_where(p_.size(), [&](Index i) {
    return pockets_.of[static_cast<std::size_t>(i)] == kNoPocket &&
           (touches(p_(i)) || v_(i) < highest);
  });
  outside_below_ = highest;
}

/// The certificate by the best of a few multipliers; the best stays.
void TwoMetricGradient::certify() {
  collect_outside(lambda_);
  const double centre = weighted_level();
  const double before = lambda_;
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](double lambda) {
    if (!std::isfinite(lambda)) return;
    if (lambda > outside_below_) {  // pixels that are not among those outside would count
      collect_outside(lambda);
    }
    const double gap = energy_.duality_gap(p_, v_, outside_, lambda, levels_, liquid_.seals);
    if (gap < least) {
      least = gap;
      lambda_ = lambda;
    }
  };
  consider(centre);
  if (std::isfinite(cap_)) {
    if (convergence_.iterations > 0) {
      consider(before);
      consider(next_lambda_);
    }
  } else {
    consider(extent_of(v_).lowest);
    if (std::isfinite(centre)) lambda_ = centre;  // the bound alone needs the lowest
  }
  convergence_.certificate = std::max(0.0, least / gap_scale_);
  if (convergence_.certificate < best_certificate_) {
    best_certificate_ = convergence_.certificate;
    best_iteration_ = convergence_.iterations;
  }
}

double TwoMetricGradient::gap_error() const {
  return max_over(p_.size(), [&](Index i) {
    const auto pixel = static_cast<std::size_t>(i);
    const double p = p_(i);
    const double overlap = at_cap(p, cap_) ? 0 : -r(pixel);
    const double opening = touches(p) && !at_level(p, level_under(pixel)) ? r(pixel) : 0;
    return std::max({overlap, opening, 0.0});
  });
}

/// Moves pixels to the bound next to which their pressure is in name only. Returns the load that
/// moved, as a share of all; moves nothing where that is for iterations to move.
double TwoMetricGradient::settle() {
  const auto settled = [&](Index i) {
    const double p = p_(i);
    const double level = level_under(static_cast<std::size_t>(i));
    const double gap = r(static_cast<std::size_t>(i));
    const auto is_false = [&](double pressure, double closing) {
      return closing > kFalseContact * pressure * pixel_compliance_;
    };
    if (!touches(p) || p >= cap_ || p == level) return p;
    if (at_level(p, level) || is_false(p - level, gap)) return level;
    return at_cap(p, cap_) || is_false(cap_ - p, -gap) ? cap_ : p;
  };
  const double moved =
      sum_over(p_.size(), [&](Index i) { return std::abs(settled(i) - p_(i)); }) / load_;
  if (moved == 0 || moved > kMostSettled) return moved;
  for_each(p_.size(), [&](Index i) { p_(i) = settled(i); });
  // The solids inside their bounds share what is missing.
  const auto is_free = [&](Index i) {
    const double p = p_(i);
    return touches(p) && p < cap_ && !at_level(p, level_under(static_cast<std::size_t>(i)));
  };
  const Index n_free = count_where(p_.size(), is_free);
  if (n_free == 0) return moved;
  const double each = (load_ - sum(p_)) / static_cast<double>(n_free);
  for_each(p_.size(), [&](Index i) {
    if (is_free(i)) {
      p_(i) = std::clamp(p_(i) + each, level_under(static_cast<std::size_t>(i)), cap_);
    }
  });
  return moved;
}

bool TwoMetricGradient::meets_conditions() {
  constexpr int most_rounds = 5;
  for (int round = 0; round < most_rounds; ++round) {
    if (!(convergence_.certificate <= problem_.tolerance)) return false;
    const double moved = settle();
    if (moved > kMostSettled) return false;
    if (moved == 0) return gap_error() <= gap_limit_;
    refresh();
    certify();
  }
  return gap_error() <= gap_limit_;
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
  active_ = list_where(p_.size(), [&](Index i) {
    const auto pixel = static_cast<std::size_t>(i);
    const double p = p_(i);
    const double residual = r(pixel);
    if (p >= cap_ && residual <= 0) return false;
    if (pockets_.of[pixel] != kNoPocket) return !at_level(p, level_under(pixel));
    return touches(p) || residual < 0;
  });
  for (const std::uint32_t i : active_) is_active_[i] = 1;
}

void TwoMetricGradient::find_direction() {
  for_each(work_.size(), [&](Index i) { work_(i) = 0; });
  for_each(active_.size(),
           [&](std::size_t k) { work_.data()[active_[k]] = static_cast<float>(r(active_[k])); });
  preconditioner_.apply(active_, work_, compact_direction_, stiffness_);
  add_long_waves();
}

/// As the fast solver does.
void TwoMetricGradient::add_long_waves() {
  direction_ = compact_direction_;
  moved_ = compact_direction_;
  long_waves_.start_anew();
  for (int round = 0; round < kBlockRounds && long_waves_.useful(); ++round) {
    const double n_changed = hold_at_bounds();
    if (round > 1 && n_changed <= kSettledShare * static_cast<double>(active_.size())) break;
    const auto accuracy = round == 0 ? LongWaves::Accuracy::rough : LongWaves::Accuracy::full;
    long_waves_.correct(active_, stiffness_, moved_, compact_direction_, accuracy, direction_);
  }
}

double TwoMetricGradient::hold_at_bounds() {
  return sum_over(active_.size(), [&](std::size_t k) {
    const double p = p_.data()[active_[k]];
    const double wanted = p - step_ * static_cast<double>(direction_[k]);
    const double allowed = std::clamp(wanted, level_under(active_[k]), cap_);
    const bool was_free = moved_[k] == compact_direction_[k];
    moved_[k] =
        wanted == allowed ? compact_direction_[k] : static_cast<float>((p - allowed) / step_);
    return was_free == (wanted == allowed) ? 0.0 : 1.0;
  });
}

/// tau = <dp, S dp> / <S dp, M S dp> on solid contact; M S dp is the change of the direction.
void TwoMetricGradient::choose_step() {
  const auto response = [&](std::size_t k) { return response_.data()[active_[k]]; };
  const double mean = sum_over(active_.size(), response) / static_cast<double>(active_.size());
  const double curvature = sum_over(active_.size(), [&](std::size_t k) {
    const float previous = previous_.data()[active_[k]];
    return (static_cast<double>(direction_[k]) - previous) * (response(k) - mean);
  });
  if (step_curvature_ > 0 && curvature > 0) {
    step_ = std::clamp(step_curvature_ / curvature, kLeastStep, kMostStep);
  }
}

/// Tries a step: trial_ and trial_levels_, dp into work_. Returns the slope of the energy along it
/// [Pa m]; a positive one where nothing could be tried.
double TwoMetricGradient::project_step(Metric metric) {
  const std::vector<float>& direction = metric == Metric::whole ? direction_ : compact_direction_;
  const double alone = preconditioner_.diagonal() * slower_;
  if (metric != Metric::scalar) {
    for_each(active_.size(), [&](std::size_t k) { work_.data()[active_[k]] = direction[k]; });
  }
  trial_.outside.resize(outside_.size());
  for_each(outside_.size(), [&](std::size_t k) {
    const std::size_t i = outside_[k];
    const double change = metric == Metric::scalar || !is_active_[i]
                              ? alone * r(i)
                              : step_ * static_cast<double>(work_.data()[i]);
    trial_.outside[k] = p_.data()[i] - change;
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
      trial_.inside[j] = p_.data()[i] - change;
    }
  });
  trial_.step = alone;
  const double moving =
      sum_over(outside_.size(), [&](std::size_t k) { return p_.data()[outside_[k]]; }) +
      sum_over(pockets_.pixels.size(),
               [&](std::size_t j) { return p_.data()[pockets_.pixels[j]]; });
  trial_levels_ = levels_;
  const auto shift = pouring_.project(steps, liquid_.seals, moving, trial_, trial_levels_);
  if (!shift) return 1;
  next_lambda_ = lambda_ - *shift / alone;
  for_each(work_.size(), [&](Index i) { work_(i) = 0; });
  const auto change_of = [&](std::size_t i, double trial) {
    const double change = trial - p_.data()[i];
    work_.data()[i] = static_cast<float>(change);
    return change * r(i);
  };
  const double slope =
      sum_over(outside_.size(),
               [&](std::size_t k) { return change_of(outside_[k], trial_.outside[k]); }) +
      sum_over(pockets_.pixels.size(),
               [&](std::size_t j) { return change_of(pockets_.pixels[j], trial_.inside[j]); });
  return slope + energy_.of_liquid(trial_levels_) - energy_.of_liquid(levels_);
}

/// Returns false if no step leads downhill.
bool TwoMetricGradient::move() {
  slower_ = 1;
  double slope = project_step(Metric::whole);
  if (slope >= 0) {
    slope = project_step(Metric::compact);
    direction_ = compact_direction_;
    n_compact_steps_ += 1;
  }
  constexpr int most_halvings = 10;
  for (int i = 0; slope >= 0 && i < most_halvings; ++i) {
    slope = project_step(Metric::scalar);
    if (slope >= 0) slower_ *= 0.5;
    direction_.assign(active_.size(), 0);
  }
  if (slope >= 0) return false;
  const auto change_outside = [&](std::size_t k) {
    return trial_.outside[k] - p_.data()[outside_[k]];
  };
  const auto change_inside = [&](std::size_t j) {
    return trial_.inside[j] - p_.data()[pockets_.pixels[j]];
  };
  elasticity_.apply(work_, work_);
  convergence_.operator_applications += 1;
  convergence_.fft_pairs += 1;
  const double curvature =
      sum_over(outside_.size(),
               [&](std::size_t k) {
                 return change_outside(k) * static_cast<double>(work_.data()[outside_[k]]);
               }) +
      sum_over(pockets_.pixels.size(), [&](std::size_t j) {
        return change_inside(j) * static_cast<double>(work_.data()[pockets_.pixels[j]]);
      });
  const double free_length = curvature > 0 ? -slope / curvature : 2;
  accept(std::min(1.0, free_length));
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
  for_each(active_.size(), [&](std::size_t k) { previous_.data()[active_[k]] = direction_[k]; });
  const auto factor = static_cast<float>(length);
  for_each(response_.size(), [&](Index i) {
    response_(i) = work_(i) * factor;
    v_(i) += static_cast<double>(response_(i));
  });
  const auto stepped = [length](double before, double trial) {
    return length == 1 ? trial : before + length * (trial - before);
  };
  double solid = 0;
  solid += sum_over(outside_.size(), [&](std::size_t k) {
    double& p = p_.data()[outside_[k]];
    const double after = std::clamp(stepped(p, trial_.outside[k]), 0.0, cap_);
    const double change = after - p;
    p = after;
    return change * static_cast<double>(response_.data()[outside_[k]]);
  });
  solid += sum_over(pockets_.pixels.size(), [&](std::size_t j) {
    const std::size_t i = pockets_.pixels[j];
    double& p = p_.data()[i];
    const double after = std::clamp(stepped(p, trial_.inside[j]), 0.0, cap_);
    const double change = after - p;
    p = after;
    return is_active_[i] ? change * static_cast<double>(response_.data()[i]) : 0.0;
  });
  step_curvature_ = solid;
  levels_ = length == 1 ? trial_levels_ : energy_.best_levels(p_, liquid_.seals);
  residual_is_fresh_ = false;
}

/// Lets the liquid of the start down to seals that have been lowered since; the contact outside
/// pockets takes the load. Returns false where there is nothing to do.
bool TwoMetricGradient::let_down(const std::vector<double>& levels) {
  bool is_lowered = false;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    if (!(levels[k] > liquid_.seals[k])) continue;
    is_lowered = true;
    for (std::size_t j = pockets_.first[k]; j < pockets_.first[k + 1]; ++j) {
      double& p = p_.data()[pockets_.pixels[j]];
      if (at_level(p, levels[k])) p = liquid_.seals[k];
    }
  }
  if (!is_lowered) return false;
  const PixelList support = list_where(p_.size(), [&](Index i) {
    return pockets_.of[static_cast<std::size_t>(i)] == kNoPocket && touches(p_(i));
  });
  std::vector<double> values(support.size());
  for_each(values.size(), [&](std::size_t k) { values[k] = p_.data()[support[k]]; });
  const double carried = sum_over(values.size(), [&](std::size_t k) { return values[k]; });
  const double rest = load_ - sum(p_) + carried;
  if (!(rest > 0 && rest < cap_ * static_cast<double>(values.size()))) return false;
  project_on_load(values, rest, cap_);
  for_each(values.size(), [&](std::size_t k) { p_.data()[support[k]] = values[k]; });
  return true;
}

SealedState TwoMetricGradient::run(const State& start, const std::vector<double>& levels,
                                   const Observer& observer) {
  const Index ny = problem_.height.rows();
  const Index nx = problem_.height.cols();
  p_ = start.pressure;
  if (let_down(levels)) {
    v_.resize(ny, nx);
    refresh();
  } else {
    p_ = start.pressure;
    v_ = start.displacement - problem_.height;
    residual_is_fresh_ = true;
  }
  levels_ = energy_.best_levels(p_, liquid_.seals);
  lambda_ = -start.separation;
  certify();
  SealedState state;
  const bool has_no_level =
      std::all_of(levels_.begin(), levels_.end(), [](double m) { return m == 0; });
  if (has_no_level && convergence_.certificate <= problem_.tolerance) {
    state.contact = start;
    state.levels = levels_;
    state.is_start = true;
    return state;
  }
  work_ = FieldF::Zero(ny, nx);
  response_ = FieldF::Zero(ny, nx);
  previous_ = FieldF::Zero(ny, nx);
  is_active_.assign(static_cast<std::size_t>(p_.size()), 0);
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
  contact.gap_error = gap_error();
  contact.gap_limit = gap_limit_;
  contact.separation = -lambda_;
  contact.mean_pressure = problem_.mean_pressure;
  contact.convergence = convergence_;
  contact.compact_steps = n_compact_steps_;
  contact.gap = v_ - lambda_;
  contact.displacement = v_ + problem_.height;
  contact.pressure = std::move(p_);
  state.levels = levels_;
  return state;
}

}  // namespace

SealedState solve_sealed(elastic::ElasticOperator& elasticity, const LoadProblem& problem,
                         const SealedPockets& liquid, const SealedState& start,
                         const Observer& observer) {
  return TwoMetricGradient(elasticity, problem, liquid).run(start.contact, start.levels, observer);
}

}  // namespace tabor::contact
