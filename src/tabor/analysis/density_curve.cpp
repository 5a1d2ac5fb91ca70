#include "tabor/analysis/density_curve.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "tabor/analysis/states.hpp"
#include "tabor/core/units.hpp"
#include "tabor/deposition/deposition.hpp"

namespace tabor::analysis {
namespace {

constexpr double kLeast = 1e-6;  // [kg/m^2]
constexpr double kMost = 1e-2;   // [kg/m^2]
constexpr int kPerDecade = 10;
constexpr double kFlat = 0.01;  // dry shares within this of their mean are the same
constexpr double kDry = 0.01;   // so small a wet share is none

/// Rising densities; none on a surface without heights.
std::vector<double> densities_for(const topography::Topography& surface, double oil_density) {
  const double range = surface.height.maxCoeff() - surface.height.minCoeff();
  const double most = std::min(kMost, range * oil_density);
  std::vector<double> all;
  for (int i = 0; most > 0; ++i) {
    const double density = kLeast * std::pow(10, static_cast<double>(i) / kPerDecade);
    if (density > most * (1 + 1e-9)) break;
    all.push_back(density);
  }
  return all;
}

/// Where any of them touches.
Mask touched_by(const std::vector<Touching>& contacts, const topography::Topography& surface) {
  Mask touched = Mask::Constant(surface.height.rows(), surface.height.cols(), false);
  for (const Touching& contact : contacts) touched = touched || contact.mask;
  return touched;
}

std::string grams(double density) { return fmt::format("{:.2g} g/m^2", in_g_per_m2(density)); }

std::string list_of(const std::vector<double>& densities) {
  std::vector<std::string> texts;
  texts.reserve(densities.size());
  for (const double density : densities) texts.push_back(grams(density));
  const std::string last = texts.back();
  texts.pop_back();
  return texts.empty() ? last : fmt::format("{} and {}", fmt::join(texts, ", "), last);
}

/// "0.45 and 0.9 g/m^2 lie on this plateau", or before or beyond it.
void add_place(const std::vector<double>& asked, const char* where, std::string& sentence) {
  if (asked.empty()) return;
  sentence += fmt::format("; {} {} {}", list_of(asked), asked.size() == 1 ? "lies" : "lie", where);
}

std::vector<double> dry_shares(const DensityCurve& curve) {
  std::vector<double> shares;
  shares.reserve(curve.lubricated_shares.size());
  for (const double wet : curve.lubricated_shares) shares.push_back(1 - wet);
  return shares;
}

/// Lubricated friction at the first density of the curve that is no less.
double friction_from(const DensityCurve& curve, double density) {
  const std::vector<double>& all = curve.lubricant_densities;
  const auto place = std::lower_bound(all.begin(), all.end() - 1, density) - all.begin();
  return curve.friction_lubricated[static_cast<std::size_t>(place)];
}

std::string plateau_text(const DensityCurve& curve) {
  const Plateau& plateau = *curve.plateau;
  const double wet = 1 - plateau.value;
  std::string text =
      wet < kDry ? fmt::format("hardly any contact is wet up to {}", grams(plateau.last))
                 : fmt::format("the pockets under the contacts are full from {} (friction {:.3g})",
                               grams(plateau.first), friction_from(curve, plateau.first));
  if (plateau.last < curve.lubricant_densities.back()) {
    text += wet < kDry ? ", where the oil reaches the contacts"
                       : fmt::format(
                             "; the next change comes at {}, where the valleys reach the "
                             "contacts",
                             grams(plateau.last));
  }
  return text;
}

}  // namespace

bool has_density_curve(const CaseSettings& settings) {
  const FilmSettings& film = settings.film;
  const bool runs_down =
      film.model == deposition::Model::droplets || film.model == deposition::Model::limit;
  const bool is_wet = std::any_of(film.lubricant_densities.begin(), film.lubricant_densities.end(),
                                  [](double density) { return density > 0; });
  return runs_down && is_wet && !settings.fluid.flows();
}

WettingDoses wetting_doses(const topography::Topography& surface, const FilmSettings& settings,
                           const Mask& where, const Observer& observer) {
  FilmSettings film = settings;
  film.model = deposition::Model::limit;
  film.lubricant_densities = densities_for(surface, film.oil_density);
  WettingDoses doses{film.lubricant_densities, {}};
  if (film.lubricant_densities.empty()) return doses;
  std::vector<Index> pixels;
  pixels.reserve(static_cast<std::size_t>(where.count()));
  for (Index p = 0; p < where.size(); ++p) {
    if (where.data()[p]) pixels.push_back(p);
  }
  const std::vector<std::size_t> of_pixels = deposition::first_wetting_doses(
      surface.height, surface.grid, dose_of(film), pixels, observer);
  doses.first.assign(static_cast<std::size_t>(where.size()),
                     static_cast<std::uint8_t>(film.lubricant_densities.size()));
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    doses.first[static_cast<std::size_t>(pixels[k])] = static_cast<std::uint8_t>(of_pixels[k]);
  }
  return doses;
}

WettingDoses wetting_doses(const topography::Topography& surface, const FilmSettings& settings,
                           const Observer& observer) {
  const Mask everywhere = Mask::Constant(surface.grid.ny, surface.grid.nx, true);
  return wetting_doses(surface, settings, everywhere, observer);
}

std::vector<double> lubricated_shares(const WettingDoses& doses, const Mask& contact) {
  std::vector<double> shares(doses.lubricant_densities.size(), 0);
  double n_touching = 0;
  for (Index p = 0; p < contact.size(); ++p) {
    if (!contact.data()[p]) continue;
    ++n_touching;
    const std::size_t first = doses.first[static_cast<std::size_t>(p)];
    if (first < shares.size()) shares[first] += 1;
  }
  double n_wet = 0;
  for (double& share : shares) {
    n_wet += share;
    share = n_touching > 0 ? n_wet / n_touching : 0;
  }
  return shares;
}

DensityCurve density_curve(const std::vector<double>& lubricant_densities,
                           const std::vector<double>& lubricated_shares,
                           const contact::Summary& contact, const CaseSettings& settings) {
  DensityCurve curve;
  curve.mean_pressure = contact.mean_pressure;
  curve.lubricant_densities = lubricant_densities;
  curve.lubricated_shares = lubricated_shares;
  curve.friction_lubricated.reserve(lubricated_shares.size());
  for (const double share : lubricated_shares) {
    const friction::Estimate estimate =
        estimate_of(contact, share, settings.contact, settings.friction);
    curve.friction_lubricated.push_back(estimate.friction_lubricated);
    curve.friction_dry = estimate.friction_dry;
  }
  curve.plateau = plateau_of(curve);
  return curve;
}

std::optional<Plateau> plateau_of(const DensityCurve& curve) {
  // By the dry share, as a boundary film makes friction flat where the oil still spreads.
  const auto plateau = find_plateau(curve.lubricant_densities, dry_shares(curve), kFlat);
  return plateau && plateau->value > 0 ? plateau : std::nullopt;
}

std::vector<DensityCurve> density_curves(const topography::Topography& surface,
                                         const std::vector<Touching>& contacts,
                                         const CaseSettings& settings, const Observer& observer) {
  return density_curves(
      wetting_doses(surface, settings.film, touched_by(contacts, surface), observer), contacts,
      settings);
}

std::vector<DensityCurve> density_curves(const WettingDoses& doses,
                                         const std::vector<Touching>& contacts,
                                         const CaseSettings& settings) {
  std::vector<DensityCurve> curves;
  if (doses.lubricant_densities.empty()) return curves;
  curves.reserve(contacts.size());
  for (const Touching& contact : contacts) {
    curves.push_back(density_curve(doses.lubricant_densities,
                                   lubricated_shares(doses, contact.mask), contact.summary,
                                   settings));
  }
  return curves;
}

std::string sentence_of(const DensityCurve& curve, const std::vector<double>& asked) {
  if (!curve.plateau) return "friction changes with the density throughout";
  std::vector<double> below, on, beyond;
  for (const double density : asked) {
    if (density == 0) continue;
    std::vector<double>& part = density < curve.plateau->first  ? below
                                : density > curve.plateau->last ? beyond
                                                                : on;
    if (std::find(part.begin(), part.end(), density) == part.end()) part.push_back(density);
  }
  std::string sentence = plateau_text(curve);
  add_place(below, "below, where friction falls with the density", sentence);
  const bool is_dry = 1 - curve.plateau->value < kDry;
  add_place(on,
            is_dry ? "below, where friction is that without oil"
                   : "between, where the density hardly matters",
            sentence);
  add_place(beyond, "beyond, where the oil drowns the contacts", sentence);
  return sentence;
}

}  // namespace tabor::analysis
