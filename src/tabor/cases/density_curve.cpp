#include "tabor/cases/density_curve.hpp"

#include <algorithm>
#include <cmath>

#include "tabor/cases/belonging.hpp"
#include "tabor/cases/states.hpp"
#include "tabor/deposition/deposition.hpp"

namespace tabor::cases {
namespace {

constexpr double kMost = 1e-2;            // [kg/m^2]
constexpr double kSame = 1e-9;            // relative: far above rounding, far below a step
constexpr double kShortestPlateau = 1.5;  // ratio of its ends

/// 0.001, 0.00105, ... 10 g/m^2, in kg/m^2: round numbers, as people ask for.
std::vector<double> round_densities() {
  std::vector<double> all;
  for (int decade = 1; decade <= 10000; decade *= 10) {
    for (int hundredths = 100; hundredths < 1000;) {
      const double density = hundredths * static_cast<double>(decade) / 1e8;
      if (density > kMost) return all;
      all.push_back(density);
      hundredths += hundredths < 200 ? 5 : hundredths < 500 ? 10 : 25;
    }
  }
  return all;
}

/// Rising densities with those of the settings; none on a surface without heights.
std::vector<double> densities_for(const topography::Topography& surface,
                                  const FilmSettings& settings) {
  const double drowned =
      (surface.height.maxCoeff() - surface.height.minCoeff()) * settings.oil_density;
  std::vector<double> all;
  for (const double density : round_densities()) {
    if (density <= drowned * (1 + kSame)) all.push_back(density);
  }
  if (all.empty()) return all;
  for (const double asked : settings.lubricant_densities) {
    const bool is_there = std::any_of(
        all.begin(), all.end(), [&](double density) { return are_same_density(density, asked); });
    if (asked > 0 && !is_there) all.push_back(asked);
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// The doses of all densities for `settings`, in one run with the films of `laid`.
WettingDoses doses_and_films(const topography::Topography& surface, const FilmSettings& settings,
                             const FilmSettings& laid, const Mask& where,
                             const deposition::FilmSink& sink, const Observer& observer) {
  WettingDoses doses{densities_for(surface, settings), {}};
  if (doses.lubricant_densities.empty() && laid.lubricant_densities.empty()) return doses;
  deposition::Wetting wetting{{}, where};
  for (const double density : doses.lubricant_densities) {
    wetting.mean_films.push_back(deposition::mean_film(density, settings.oil_density));
  }
  doses.first = deposition::first_wetting_doses(surface.height, surface.grid,
                                                dose_of(laid, surface), wetting, sink, observer);
  return doses;
}

/// Where any of them touches.
Mask touched_by(const std::vector<Touching>& contacts, const topography::Topography& surface) {
  Mask touched = Mask::Constant(surface.height.rows(), surface.height.cols(), false);
  for (const Touching& contact : contacts) touched = touched || contact.mask;
  return touched;
}

/// The dry shares before all is drowned.
std::vector<double> dry_shares(const DensityCurve& curve) {
  std::vector<double> shares;
  shares.reserve(curve.lubricated_shares.size());
  for (const double wet : curve.lubricated_shares) {
    if (!(wet < 1)) break;
    shares.push_back(1 - wet);
  }
  return shares;
}

}  // namespace

bool has_density_curve(const CaseSettings& settings) {
  const FilmSettings& film = settings.film;
  const bool runs_down =
      film.model == deposition::Model::droplets || film.model == deposition::Model::limit;
  const bool is_wet = std::any_of(film.lubricant_densities.begin(), film.lubricant_densities.end(),
                                  [](double density) { return density > 0; });
  const bool only_wets = !settings.fluid.flows() && !settings.trapped.is_asked();
  return runs_down && is_wet && only_wets && settings.friction.dry_below == 0 &&
         settings.contact.tool.n_places() == 1;
}

WettingDoses wetting_doses(const topography::Topography& surface, const FilmSettings& settings,
                           const Mask& where, const Observer& observer) {
  FilmSettings no_films = settings;
  no_films.model = deposition::Model::limit;
  no_films.lubricant_densities.clear();
  return doses_and_films(surface, settings, no_films, where, {}, observer);
}

WettingDoses wetting_doses(const topography::Topography& surface, const FilmSettings& settings,
                           const std::function<void(FilmRecord&&)>& receive,
                           const Observer& observer) {
  return doses_and_films(surface, settings, settings, Mask(), film_sink(surface, settings, receive),
                         observer);
}

std::vector<double> lubricated_shares(const WettingDoses& doses, const Mask& contact) {
  if (doses.lubricant_densities.empty()) return {};
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

bool are_same_density(double a, double b) { return std::abs(a - b) <= kSame * std::max(a, b); }

std::optional<Plateau> plateau_of(const DensityCurve& curve) {
  // By the dry share, as a boundary film makes friction flat where the oil still spreads.
  const std::vector<double> dry = dry_shares(curve);
  std::optional<Plateau> plateau = find_plateau(curve.lubricant_densities, dry, kPlateauTolerance);
  if (!plateau || plateau->last < kShortestPlateau * plateau->first) return std::nullopt;
  bool is_before = true;  // a neighbour may be as close to the mean as those that made it
  for (std::size_t i = 0; i < dry.size(); ++i) {
    if (std::abs(dry[i] - plateau->value) > kPlateauTolerance * plateau->value) continue;
    if (is_before) plateau->first = curve.lubricant_densities[i];
    is_before = false;
    plateau->last = curve.lubricant_densities[i];
  }
  return plateau;
}

Touching touching_of(const ContactRecord& contact) {
  return {contact.summary, contact::contact_mask(contact.state), contact.surface};
}

std::vector<DensityCurve> density_curves(const topography::Topography& surface,
                                         const std::vector<Touching>& contacts,
                                         const CaseSettings& settings, const Observer& observer) {
  for (const Touching& contact : contacts) require_contact_of(surface, contact.surface);
  const WettingDoses doses =
      wetting_doses(surface, settings.film, touched_by(contacts, surface), observer);
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

}  // namespace tabor::cases
