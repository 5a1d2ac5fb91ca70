#include "tabor/contact/trapped/iterate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tabor/contact/conditions.hpp"
#include "tabor/contact/projection.hpp"
#include "tabor/elastic/half_space.hpp"

namespace tabor::contact {

IterateConditions::IterateConditions(const elastic::ElasticOperator& elasticity,
                                     const LoadProblem& problem, const SealedPockets& liquid)
    : liquid_(liquid),
      cap_(problem.caps.for_all()),
      load_(problem.mean_pressure * static_cast<double>(problem.height.size())),
      pixel_compliance_(elastic::love_coefficient(
          0, 0, elasticity.grid().dx(), elasticity.grid().dy(), elasticity.effective_modulus())),
      gap_limit_(Conditions(elasticity, problem).gap_limit()) {}

double IterateConditions::multiplier(const Iterate& now, const PixelList& outside) const {
  const Pockets& pockets = liquid_.pockets;
  const auto weight = [&](std::size_t i) {
    const double p = now.pressure.data()[i];
    if (!touches(p) || at_cap(p, cap_)) return 0.0;
    return std::max(p - level_under(now, i), 0.0) * (1 - p / cap_);
  };
  const auto sum_of = [&](const auto& term) {
    return sum_over(outside.size(), [&](std::size_t k) { return term(outside[k]); }) +
           sum_over(pockets.pixels.size(), [&](std::size_t j) { return term(pockets.pixels[j]); });
  };
  const double total = sum_of(weight);
  if (total > 0) return sum_of([&](std::size_t i) { return weight(i) * now.v.data()[i]; }) / total;
  double excess = 0;  // of v over what the liquid fills
  double n_liquid = 0;
  for (std::size_t k = 0; k < pockets.size(); ++k) {
    const double level = now.levels[k];
    if (level == 0 || at_level(liquid_.seals[k], level)) continue;  // its gap may be any
    excess -= pockets.volume[k] * (1 - level / liquid_.bulk_modulus);
    for (std::size_t j = pockets.first[k]; j < pockets.first[k + 1]; ++j) {
      const std::size_t i = pockets.pixels[j];
      if (!at_level(now.pressure.data()[i], level)) continue;
      excess += now.v.data()[i];
      n_liquid += 1;
    }
  }
  if (n_liquid > 0) return excess / n_liquid;
  constexpr double none = -std::numeric_limits<double>::infinity();
  return max_over(now.v.size(), [&](Index i) {
    return is_solid(now, static_cast<std::size_t>(i)) ? now.v(i) : none;
  });
}

double IterateConditions::gap_error(const Iterate& now) const {
  return max_over(now.v.size(), [&](Index i) {
    const double gap = now.v(i) - now.lambda;
    const double overlap = at_cap(now.pressure(i), cap_) ? 0 : -gap;
    const double opening = is_solid(now, static_cast<std::size_t>(i)) ? gap : 0;
    return std::max({overlap, opening, 0.0});
  });
}

double IterateConditions::settle(Iterate& now) const {
  Field& pressure = now.pressure;
  const auto settled = [&](Index i) {
    const double p = pressure(i);
    const double level = level_under(now, static_cast<std::size_t>(i));
    const double gap = now.v(i) - now.lambda;
    const auto is_false = [&](double above, double closing) {
      return closing > kFalseContact * above * pixel_compliance_;
    };
    if (!touches(p) || p >= cap_ || p == level) return p;
    if (at_level(p, level) || is_false(p - level, gap)) return level;
    return at_cap(p, cap_) || is_false(cap_ - p, -gap) ? cap_ : p;
  };
  const double moved =
      sum_over(pressure.size(), [&](Index i) { return std::abs(settled(i) - pressure(i)); }) /
      load_;
  if (moved == 0 || moved > kMostSettled) return moved;
  for_each(pressure.size(), [&](Index i) { pressure(i) = settled(i); });
  const auto is_free = [&](Index i) {
    return pressure(i) < cap_ && is_solid(now, static_cast<std::size_t>(i));
  };
  const Index n_free = count_where(pressure.size(), is_free);
  if (n_free == 0) return moved;
  const double each = (load_ - sum(pressure)) / static_cast<double>(n_free);
  for_each(pressure.size(), [&](Index i) {
    if (!is_free(i)) return;
    const double level = level_under(now, static_cast<std::size_t>(i));
    pressure(i) = std::clamp(pressure(i) + each, level, cap_);
  });
  return moved;
}

bool IterateConditions::let_down(const std::vector<double>& levels, Field& pressure) const {
  const Pockets& pockets = liquid_.pockets;
  const PixelList support = list_where(pressure.size(), [&](Index i) {
    return pockets.of[static_cast<std::size_t>(i)] == kNoPocket && touches(pressure(i));
  });
  double freed = 0;  // load [Pa]
  const auto for_lowered = [&](const auto& visit) {
    for (std::size_t k = 0; k < levels.size(); ++k) {
      if (!(levels[k] > liquid_.seals[k])) continue;
      for (std::size_t j = pockets.first[k]; j < pockets.first[k + 1]; ++j) {
        double& p = pressure.data()[pockets.pixels[j]];
        if (at_level(p, levels[k])) visit(p, liquid_.seals[k]);
      }
    }
  };
  for_lowered([&](double p, double seal) { freed += p - seal; });
  std::vector<double> values(support.size());
  for_each(values.size(), [&](std::size_t k) { values[k] = pressure.data()[support[k]]; });
  const double rest = freed + sum_over(values.size(), [&](std::size_t k) { return values[k]; });
  if (!(freed > 0 && rest < cap_ * static_cast<double>(values.size()))) return false;
  for_lowered([](double& p, double seal) { p = seal; });
  project_on_load(values, rest, cap_);
  for_each(values.size(), [&](std::size_t k) { pressure.data()[support[k]] = values[k]; });
  return true;
}

}  // namespace tabor::contact
