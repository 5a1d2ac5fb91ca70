#include "tabor/contact/conditions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tabor/contact/listed_caps.hpp"
#include "tabor/contact/projection.hpp"
#include "tabor/contact/scale.hpp"
#include "tabor/core/loops.hpp"
#include "tabor/elastic/half_space.hpp"

namespace tabor::contact {
namespace {

constexpr double kLoadTolerance = 1e-10;  // relative
constexpr double kLargestShare = 30;      // of sqrt(tolerance) x length scale
constexpr double kRelativeRounding = 1e-13;
constexpr double kExactLoad = 1e-13;  // relative: no need to correct

/// How far a pressure is inside its bounds [Pa]: itself without a cap.
double freedom(double p, double cap) {
  return !touches(p) || at_cap(p, cap) ? 0.0 : p * (1 - p / cap);
}

}  // namespace

Conditions::Conditions(const elastic::ElasticOperator& elasticity, const LoadProblem& problem)
    : load_(problem.mean_pressure * static_cast<double>(problem.height.size())) {
  const Grid& grid = elasticity.grid();
  const double modulus = elasticity.effective_modulus();
  const double length = length_scale(elasticity, problem);
  gap_scale_ = problem.mean_pressure * length * static_cast<double>(problem.height.size());
  pixel_compliance_ = elastic::love_coefficient(0, 0, grid.dx(), grid.dy(), modulus);
  const Extent extent = extent_of(problem.height);
  rounding_ = kRelativeRounding * (extent.highest - extent.lowest +
                                   problem.mean_pressure * std::sqrt(grid.area()) / modulus);
  // |S dp| at a pixel is at most sqrt(2 S_ii G) where the duality gap is G (Cauchy and Schwarz in
  // the energy); twice that for the separation, and twice again since S_ii is that of a lone pixel.
  const double missing = problem.caps.bound()
                             ? problem.caps.mean(problem.height.size()) - problem.mean_pressure
                             : problem.mean_pressure;
  const double share = std::min(1.0, missing / problem.mean_pressure);
  const double allowed_by_energy = 4 * std::sqrt(2 * pixel_compliance_ * share * load_ / length);
  gap_limit_ =
      length * std::max(problem.tolerance,
                        std::sqrt(problem.tolerance) * std::min(kLargestShare, allowed_by_energy)) +
      rounding_;
}

double Conditions::certificate(const Candidates& all, const Caps& caps) const {
  const double carried =
      sum_over(all.pressure.size(), [&](std::size_t i) { return all.pressure[i]; });
  return std::abs(carried / load_ - 1) <= kLoadTolerance
             ? std::max(0.0, duality_gap(all, load_, caps) / gap_scale_)
             : std::numeric_limits<double>::infinity();
}

double Conditions::separation(std::span<const double> p, std::span<const double> v,
                              const Caps& caps) const {
  const double total = sum_over(p.size(), [&](std::size_t i) { return freedom(p[i], caps(i)); });
  if (total > 0) {
    return -sum_over(p.size(), [&](std::size_t i) { return freedom(p[i], caps(i)) * v[i]; }) /
           total;
  }
  constexpr double none = -std::numeric_limits<double>::infinity();
  return -max_over(p.size(), [&](std::size_t i) { return touches(p[i]) ? v[i] : none; });
}

double Conditions::gap_error(std::span<const double> p, std::span<const double> v, const Caps& caps,
                             double separation) const {
  return max_over(p.size(), [&](std::size_t i) {
    const double gap = v[i] + separation;
    const double overlap = at_cap(p[i], caps(i)) ? 0.0 : -gap;
    const double opening = touches(p[i]) ? gap : 0.0;
    return std::max({overlap, opening, 0.0});
  });
}

/// sep for which pressures that each follow their own gap carry the load. Pixels that touch in name
/// only do not count.
double Conditions::relaxed_separation(std::span<const double> p, std::span<const double> v,
                                      const Caps& caps) const {
  std::vector<double> relaxed(p.size());
  for_each(p.size(), [&](std::size_t i) { relaxed[i] = p[i] - v[i] / pixel_compliance_; });
  return shift_for_load(relaxed, load_, caps) * pixel_compliance_;
}

double Conditions::settled_pressure(double p, double gap, double cap) const {
  const auto is_false = [&](double pressure, double closing) {
    return closing > std::max(kFalseContact * pressure * pixel_compliance_, rounding_);
  };
  if (!touches(p) || p >= cap) return p;
  return is_false(p, gap) ? 0 : (at_cap(p, cap) || is_false(cap - p, -gap) ? cap : p);
}

/// Gives the pixels inside the bounds what the others leave of the load. False if they cannot carry
/// it.
bool Conditions::share_rest(std::span<double> p, const Caps& caps) const {
  const PixelList free = list_where(static_cast<Index>(p.size()), [&](Index i) {
    const double pressure = p[static_cast<std::size_t>(i)];
    return touches(pressure) && pressure < caps(i);
  });
  std::vector<double> values(free.size());
  for_each(free.size(), [&](std::size_t k) { values[k] = p[free[k]]; });
  const double rest =
      load_ - sum_over(p.size(), [&](std::size_t i) { return p[i] < caps(i) ? 0.0 : caps(i); });
  if (std::abs(rest - sum_over(values.size(), [&](std::size_t k) { return values[k]; })) <=
      kExactLoad * load_) {
    return true;
  }
  const ListedCaps free_caps(caps, free);
  if (!(rest > 0 && rest < Caps(free_caps).sum(std::ssize(values)))) return false;
  project_on_load(values, rest, free_caps);
  for_each(free.size(), [&](std::size_t k) { p[free[k]] = values[k]; });
  return true;
}

Conditions::Settled Conditions::settle(std::span<double> p, std::span<const double> v,
                                       const Caps& caps) const {
  const double level = relaxed_separation(p, v, caps);
  std::vector<double> settled(p.begin(), p.end());
  for_each(p.size(),
           [&](std::size_t i) { settled[i] = settled_pressure(p[i], v[i] + level, caps(i)); });
  const double n_moved =
      sum_over(p.size(), [&](std::size_t i) { return settled[i] == p[i] ? 0.0 : 1.0; });
  const double moved_load =
      sum_over(p.size(), [&](std::size_t i) { return std::abs(settled[i] - p[i]); });
  if (n_moved == 0) return Settled::already;
  if (moved_load > kMostSettled * load_ || !share_rest(settled, caps)) return Settled::not_yet;
  std::copy(settled.begin(), settled.end(), p.begin());
  return Settled::now;
}

}  // namespace tabor::contact
