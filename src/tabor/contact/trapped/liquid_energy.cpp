#include "tabor/contact/trapped/liquid_energy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tabor::contact {
namespace {

constexpr Index kPocketsPerBlock = 64;

}  // namespace

std::vector<double> LiquidEnergy::best_levels(const Field& pressure,
                                              const std::vector<double>& seals) const {
  std::vector<double> levels(pockets_.size());
  const double* p = pressure.data();
  for_each(
      levels.size(),
      [&](std::size_t k) {
        double lowest = std::min(seals[k], bulk_modulus_);
        for (std::size_t j = pockets_.first[k]; j < pockets_.first[k + 1]; ++j) {
          lowest = std::min(lowest, p[pockets_.pixels[j]]);
        }
        levels[k] = lowest;
      },
      kPocketsPerBlock);
  return levels;
}

double LiquidEnergy::of_liquid(const std::vector<double>& levels) const {
  double energy = 0;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    energy += pockets_.volume[k] * levels[k] * (levels[k] / (2 * bulk_modulus_) - 1);
  }
  return energy;
}

/// No level may carry more than the load.
double LiquidEnergy::most(std::size_t pocket, double seal) const {
  return std::min({seal, cap_, load_ / static_cast<double>(pockets_.n_pixels(pocket))});
}

double LiquidEnergy::duality_gap(const Field& pressure, const Field& v, const PixelList& near,
                                 double lambda, const std::vector<double>& levels,
                                 const std::vector<double>& seals) const {
  const double* p = pressure.data();
  const double* residual = v.data();
  const bool has_cap = std::isfinite(cap_);
  // Where the residual is below zero without a cap, nothing bounds the minimum.
  if (!has_cap && extent_of(v).lowest < lambda) return std::numeric_limits<double>::infinity();
  const double outside = sum_over(near.size(), [&](std::size_t k) {
    const double r = residual[near[k]] - lambda;
    return p[near[k]] * r - (has_cap ? cap_ * std::min(r, 0.0) : 0.0);
  });
  std::vector<double> inside(pockets_.size());
  for_each(
      inside.size(),
      [&](std::size_t k) {
        double product = 0;
        double opening = 0;
        double overlap = 0;
        for (std::size_t j = pockets_.first[k]; j < pockets_.first[k + 1]; ++j) {
          const double r = residual[pockets_.pixels[j]] - lambda;
          product += (p[pockets_.pixels[j]] - levels[k]) * r;
          (r > 0 ? opening : overlap) += r;
        }
        const double volume = pockets_.volume[k];
        const double rest = opening - volume;  // gap that the liquid does not fill
        const double softness = volume / bulk_modulus_;
        const double bound = most(k, seals[k]);
        const double best = softness > 0 ? std::clamp(-rest / softness, 0.0, bound)
                            : rest < 0   ? bound
                                         : 0;
        // Level by level: m rest + softness m^2/2 of what is against that of the best.
        const double of_levels = (levels[k] - best) * (rest + softness * (levels[k] + best) / 2);
        inside[k] = product + levels[k] * overlap + of_levels - (has_cap ? cap_ * overlap : 0.0);
      },
      kPocketsPerBlock);
  double gap = outside;
  for (const double one : inside) gap += one;
  return gap;
}

}  // namespace tabor::contact
