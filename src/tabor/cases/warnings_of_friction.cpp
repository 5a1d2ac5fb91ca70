#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tabor/cases/warnings.hpp"
#include "tabor/core/units.hpp"

namespace tabor::cases {
namespace {

/// Costagliola et al. 2021 find a few percent; where more does not fit, where it goes decides.
constexpr double kSpillOver = 0.05;
/// Share of the dose: droplets are whole, and a literal one raises all of a pool.
constexpr double kOverdose = 0.02;
/// Beyond, most of the contact is counted as frictionless.
constexpr double kWetShare = 0.5;
/// A share of itself: beyond, a wet share says more of the pixel than of the surface.
constexpr double kPixelChange = 0.2;
/// Clean metals in vacuum seize beyond; between technical surfaces nobody measures more.
constexpr double kLargestFriction = 2;

/// The step that took short waves from the scan, "" if none did.
std::string low_pass_of(const topography::Topography& surface) {
  for (const std::string& step : surface.history) {
    if (step.starts_with("lowpass=")) return step.substr(0, step.find(": "));
  }
  return "";
}

Warning clamp(const friction::Contact& contact, const friction::Estimate& estimate) {
  if (estimate.at_bound) {
    return {"clamp",
            "Dry friction equals tau_y/p_sat for any surface: contact is at its lower bound; "
            "<area=pixels> counts pixels"};
  }
  const double excess =
      estimate.area_fraction * contact.saturation_pressure / contact.mean_pressure - 1;
  return {"clamp",
          fmt::format("Almost all contact has yielded: dry friction is tau_y/p_sat, and edges of "
                      "contacts add {:.2g} %",
                      100 * excess),
          excess};
}

void warn_of_size(const char* which, double friction, Warnings& list) {
  if (!(friction > kLargestFriction)) return;
  list.push_back({"implausible-friction",
                  fmt::format("The {} friction coefficient is {:.3g}; no solids are known to slide "
                              "above {}. Check the shear strength",
                              which, friction, kLargestFriction),
                  friction});
}

}  // namespace

Warnings of_film(const topography::Topography& surface, const deposition::Film& film) {
  Warnings list;
  const std::string filter = low_pass_of(surface);
  const bool is_idle = std::any_of(surface.warnings.begin(), surface.warnings.end(),
                                   [](const Warning& one) { return one.code == "filter"; });
  if (!filter.empty() && !is_idle && film.mean_film > 0) {
    list.push_back(
        {"filtered",
         fmt::format("The filter {} removes small pockets that hold oil, so the wet share is too "
                     "small",
                     filter)});
  }
  if (const double least = film.thickness.minCoeff(); film.flooded || least > 0) {
    list.push_back({"flood",
                    fmt::format("A mean film of {} floods the surface. The highest point lies "
                                "under {} of oil",
                                format_si(film.mean_film, "m"), format_si(least, "m")),
                    least});
  }
  const Index n_pixels = film.thickness.size() / film.n_images;
  const std::int64_t n_droplets = film.n_droplets / film.n_images;
  if (n_droplets > 0 && n_droplets < n_pixels) {
    list.push_back(
        {"few-droplets",
         fmt::format("{} droplet{} on {} pixels show chance; use <model=limit> or a smaller "
                     "<droplet_height>",
                     n_droplets, n_droplets == 1 ? "" : "s", n_pixels),
         1 / static_cast<double>(n_droplets)});
  }
  const double asked = film.mean_film * surface.grid.area();
  if (asked > 0 && film.dosed_volume > (1 + kOverdose) * asked) {
    const double excess = film.dosed_volume / asked - 1;
    list.push_back({"overdosed",
                    fmt::format("The last droplet made the dose {} larger than asked; use a "
                                "smaller <droplet_height>",
                                percent(excess, 2)),
                    excess});
  }
  if (film.lost_volume > 0) {
    const double share = film.lost_volume / film.dosed_volume;
    list.push_back({"oil-lost",
                    fmt::format("{} of the liquid ran off over the open edges", percent(share)),
                    share});
  }
  return list;
}

Warnings of_friction(const friction::Contact& contact, const friction::Estimate& estimate,
                     double spill_over_fraction, const FrictionSettings& settings) {
  Warnings list;
  if (estimate.corrected_at_bound) list.push_back(clamp(contact, estimate));
  if (spill_over_fraction > kSpillOver) {
    list.push_back(
        {"spill-over",
         fmt::format("{} of the oil no longer fits when the surfaces close; the wet share assumes "
                     "that it stays",
                     percent(spill_over_fraction, 2)),
         spill_over_fraction});
  }
  if (contact.lubricated_share > kWetShare && settings.boundary_strength() == 0) {
    list.push_back({"frictionless",
                    fmt::format("{} of the contact is wet and counts as frictionless; "
                                "<boundary_shear_strength> gives it a friction",
                                percent(contact.lubricated_share)),
                    contact.lubricated_share});
  }
  warn_of_size("dry", estimate.friction_dry, list);
  return list;
}

Warnings of_film_in_gap(double mean_film, double mean_gap) {
  if (!(mean_film > mean_gap)) return {};
  return {{"flooded",
           fmt::format("The mean film of {} does not fit into the mean gap of {}. The model "
                       "ignores the surplus",
                       format_si(mean_film, "m"), format_si(mean_gap, "m")),
           mean_film / mean_gap}};
}

Warnings of_pixel(double coarse_pixel, double coarse_share, double pixel, double share) {
  const double change = std::abs(share - coarse_share) / std::max(share, coarse_share);
  if (!(change > kPixelChange)) return {};
  return {{"pixel",
           fmt::format("The wet share depends on the pixel size: {} with {}, {} with {}. A finer "
                       "scan would change it",
                       percent(coarse_share), format_si(coarse_pixel, "m"), percent(share),
                       format_si(pixel, "m")),
           change}};
}

Warnings of_trapped(const TrappedRecord& trapped) {
  Warnings list;
  const Convergence& convergence = trapped.convergence;
  if (convergence.failed()) {
    list.push_back(
        {"trapped-oil",
         fmt::format("Trapped oil is NOT CONVERGED ({}): the certificate is {:.1e}, and {:.0e} "
                     "was wanted",
                     name_of(convergence.status), convergence.certificate, convergence.tolerance),
         convergence.certificate});
  } else if (!trapped.liquid.seals_settled) {
    list.push_back({"trapped-oil",
                    fmt::format("The seals of pockets still weaken after {} solutions. The oil "
                                "carries less load than reported",
                                trapped.liquid.seal_rounds),
                    trapped.liquid.load_share});
  }
  if (const double leaked = trapped.liquid.leaked_fraction; leaked > kSpillOver) {
    list.push_back({"leaked",
                    fmt::format("{} of the oil in pockets leaks through their seals. tabor does "
                                "not follow where it goes",
                                percent(leaked)),
                    leaked});
  }
  return list;
}

Warnings of_mixed_friction(const friction::MixedEstimate& mixed) {
  Warnings list;
  warn_of_size("mixed", mixed.friction_mixed, list);
  return list;
}

}  // namespace tabor::cases
