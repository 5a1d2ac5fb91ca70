#include "tabor/results/density_answer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tabor/core/units.hpp"
#include "tabor/results/fields_file.hpp"

namespace tabor::results {
namespace {

constexpr double kRounding = 1e-9;  // of a density whose unit was changed

bool is_dry(const cases::Plateau& plateau) { return 1 - plateau.value < kDryShare; }

/// The point of the curve that is this density.
std::size_t point_at(const cases::DensityCurve& curve, double density) {
  const std::vector<double>& all = curve.lubricant_densities;
  return static_cast<std::size_t>(std::lower_bound(all.begin(), all.end() - 1, density) -
                                  all.begin());
}

std::string lower_edge_text(const cases::DensityCurve& curve) {
  const double first = curve.plateau->first;
  return fmt::format("the pockets under the contacts are full {} {} {} (friction {:.3g})",
                     beside_plateau(curve).below ? "from" : "at", density_text(first),
                     beside_plateau(curve).below ? "on" : "already",
                     curve.friction_lubricated[point_at(curve, first)]);
}

std::string plateau_text(const cases::DensityCurve& curve) {
  const std::string edge = text_of_upper_edge(curve);
  std::string text = is_dry(*curve.plateau)
                         ? "hardly any contact is wet up to " + density_text(curve.plateau->last)
                         : lower_edge_text(curve);
  if (!edge.empty()) text += fmt::format("; above {} the oil level reaches the contacts", edge);
  return text;
}

/// "0.45 g/m^2 (11.2 % wet) and 0.9 g/m^2 (11.3 % wet)".
std::string list_of(const std::vector<AskedDensity>& asked) {
  std::vector<std::string> texts;
  texts.reserve(asked.size());
  for (const AskedDensity& one : asked) {
    texts.push_back(fmt::format("{} ({} wet)", density_text(one.lubricant_density),
                                percent(one.lubricated_share)));
  }
  const std::string last = texts.back();
  texts.pop_back();
  return texts.empty() ? last : fmt::format("{} and {}", fmt::join(texts, ", "), last);
}

std::string place_text(Place place, const cases::DensityCurve& curve,
                       const std::vector<AskedDensity>& there) {
  const char* const lie = there.size() == 1 ? "lies" : "lie";
  switch (place) {
    case Place::below:
      return there.front().lubricant_density < curve.plateau->first
                 ? fmt::format("{} below, where fewer pockets are full", lie)
                 : fmt::format("{} less, as single droplets miss pockets",
                               there.size() == 1 ? "wets" : "wet");
    case Place::plateau:
      return is_dry(*curve.plateau)
                 ? fmt::format("{} there, where friction is nearly that without oil", lie)
                 : fmt::format("{} {}, where the density hardly matters", lie,
                               beside_plateau(curve).beyond ? "between" : "there");
    case Place::beyond:
      return fmt::format("{} beyond, where oil covers more of the contacts", lie);
  }
  return "";
}

}  // namespace

std::vector<AskedDensity> asked_at(double mean_pressure,
                                   const std::vector<cases::FrictionRecord>& records) {
  std::vector<AskedDensity> asked;
  for (const cases::FrictionRecord& record : records) {
    const bool is_there = std::any_of(asked.begin(), asked.end(), [&](const AskedDensity& one) {
      return one.lubricant_density == record.lubricant_density;
    });
    if (record.mean_pressure != mean_pressure || !(record.lubricant_density > 0) || is_there ||
        std::isnan(record.lubricated_share)) {
      continue;
    }
    asked.push_back({record.lubricant_density, record.lubricated_share});
  }
  return asked;
}

std::optional<LimitDifference> difference_from_limit(
    const std::vector<cases::DensityCurve>& curves,
    const std::vector<cases::FrictionRecord>& records) {
  std::optional<LimitDifference> largest;
  for (const cases::DensityCurve& curve : curves) {
    for (const cases::FrictionRecord& record : records) {
      if (record.mean_pressure != curve.mean_pressure || curve.lubricant_densities.empty()) {
        continue;
      }
      const std::size_t point = point_at(curve, record.lubricant_density * (1 - kRounding));
      if (!cases::are_same_density(curve.lubricant_densities[point], record.lubricant_density)) {
        continue;
      }
      const double difference =
          std::abs(record.friction_lubricated - curve.friction_lubricated[point]);
      if (std::isnan(difference) || (largest && difference <= largest->friction)) continue;
      largest = {difference, record.mean_pressure, record.lubricant_density};
    }
  }
  return largest;
}

std::optional<Place> place_of(const cases::DensityCurve& curve, double lubricated_share) {
  if (!curve.plateau) return std::nullopt;
  const double above = (1 - lubricated_share) - curve.plateau->value;
  if (std::abs(above) <= cases::kPlateauTolerance * curve.plateau->value) return Place::plateau;
  return above > 0 ? Place::below : Place::beyond;
}

std::string word_of_place(const cases::DensityCurve& curve, double lubricated_share) {
  const std::optional<Place> place = place_of(curve, lubricated_share);
  if (!place) return "no plateau";
  return place == Place::plateau && is_dry(*curve.plateau) ? "dry"
                                                           : std::string(kPlaces.of(*place));
}

double lubricated_share_at(const cases::DensityCurve& curve, double lubricant_density) {
  const std::vector<double>& all = curve.lubricant_densities;
  const std::vector<double>& shares = curve.lubricated_shares;
  if (all.empty()) return 0;
  const std::size_t next = point_at(curve, lubricant_density * (1 - kRounding));
  if (next == 0 || lubricant_density >= all[next] * (1 - kRounding)) return shares[next];
  const double part =
      std::log(lubricant_density / all[next - 1]) / std::log(all[next] / all[next - 1]);
  return shares[next - 1] + part * (shares[next] - shares[next - 1]);
}

BesidePlateau beside_plateau(const cases::DensityCurve& curve) {
  if (!curve.plateau) return {};
  const std::vector<double>& all = curve.lubricant_densities;
  const auto first = std::lower_bound(all.begin(), all.end(), curve.plateau->first);
  const auto behind = std::upper_bound(all.begin(), all.end(), curve.plateau->last);
  BesidePlateau beside;
  if (first != all.begin()) beside.below = *(first - 1);
  if (behind != all.end()) beside.beyond = *behind;
  return beside;
}

std::string text_of_upper_edge(const cases::DensityCurve& curve) {
  const auto beyond = beside_plateau(curve).beyond;
  if (!beyond) return "";
  return fmt::format("{} to {}", plain(in_g_per_m2(curve.plateau->last)), density_text(*beyond));
}

std::string sentence_of(const cases::DensityCurve& curve, const std::vector<AskedDensity>& asked) {
  if (!curve.plateau) return "friction changes with the density throughout";
  std::string sentence = plateau_text(curve);
  for (const Place place : {Place::below, Place::plateau, Place::beyond}) {
    std::vector<AskedDensity> there;
    for (const AskedDensity& one : asked) {
      if (place_of(curve, one.lubricated_share) == place) there.push_back(one);
    }
    const auto behind_edge =
        std::stable_partition(there.begin(), there.end(), [&](const AskedDensity& one) {
          return place != Place::below || one.lubricant_density < curve.plateau->first;
        });
    for (const std::vector<AskedDensity>& alike :
         {std::vector(there.begin(), behind_edge), std::vector(behind_edge, there.end())}) {
      if (alike.empty()) continue;
      sentence += fmt::format("; {} {}", list_of(alike), place_text(place, curve, alike));
    }
  }
  return sentence;
}

}  // namespace tabor::results
