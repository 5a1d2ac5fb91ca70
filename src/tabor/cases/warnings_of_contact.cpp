#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tabor/cases/warnings.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/core/units.hpp"
#include "tabor/metrology/areal/parameters.hpp"
#include "tabor/spectral/fft.hpp"
#include "tabor/topography/edges.hpp"

namespace tabor::cases {
namespace {

/// Small-slope elasticity leaves out terms of the order of the slope's square: a tenth here.
constexpr double kSteepSlope = 0.3;
/// Hardness over E*: steels reach 0.04, diamond and silica about 0.1. A rubber may bear more, but
/// its strain is then beyond linear elasticity.
constexpr double kHardestSolid = 0.1;
/// The correction of the area by its perimeter is of the size of such patches themselves.
constexpr double kFewPixels = 10;
/// Width of the edge band over the side of the patch, at each of the four edges. A pressure without
/// regard to edges puts 19 % of the load there, an isolated ball nothing.
constexpr double kEdgeBand = 0.05;
constexpr double kEdgeLoad = 0.1;
/// As much of the load stands near seams by chance where only a few contacts bear it.
constexpr double kSeamLoad = 0.5;
/// Relative rounding of an area at its bound.
constexpr double kRoundingOfBound = 1e-12;
/// Transforms of a solution times their pixels: beyond, those of a slow size take a minute or so.
constexpr double kManyTransforms = 3e8;

void warn_of_edges(const topography::Topography& surface, Warnings& list) {
  if (topography::repeats(surface) || surface.grid.size() == 1) return;
  list.push_back({"not-periodic",
                  "Opposite edges of this periodic tile do not match; use <edges=cut> for a "
                  "cut-out, <edges=end> for a body"});
}

/// Share of the load that stands on the border of the patch.
double load_on_edges(const Field& pressure) {
  const auto width = [](Index n) {
    return std::max<Index>(1, static_cast<Index>(std::lround(kEdgeBand * static_cast<double>(n))));
  };
  const Index rows = width(pressure.rows());
  const Index columns = width(pressure.cols());
  if (pressure.rows() <= 2 * rows || pressure.cols() <= 2 * columns) return 0;  // all is border
  const double inside =
      pressure.block(rows, columns, pressure.rows() - 2 * rows, pressure.cols() - 2 * columns)
          .sum();
  return 1 - inside / pressure.sum();
}

void warn_of_load_on_edges(const contact::State& state, Warnings& list) {
  const double share = load_on_edges(state.pressure);
  if (!(share > kEdgeLoad)) return;
  list.push_back(
      {"edge-load",
       fmt::format("The outermost {:.0f} % of the free patch carry {:.3g} % of the load; use "
                   "<edges=cut> unless the body ends there",
                   100 * kEdgeBand, 100 * share),
       share});
}

/// Share of the load that stands near the seams of a surface made of mirror images: there its slope
/// breaks, and what rises towards an edge makes a crest.
double load_on_seams(const Field& pressure, double tiles) {
  const auto near = [&](Index i, Index n) {
    const double side = static_cast<double>(n) / tiles;
    const double place = std::fmod(static_cast<double>(i) + 0.5, side);
    return std::min(place, side - place) < kEdgeBand * side;
  };
  std::vector<Index> columns;
  for (Index x = 0; x < pressure.cols(); ++x) {
    if (near(x, pressure.cols())) columns.push_back(x);
  }
  const auto loads = sum_over_rows<2>(pressure.rows(), [&](Index y) {
    const double whole = pressure.row(y).sum();
    if (near(y, pressure.rows())) return Eigen::Array2d(whole, whole);
    double beside = 0;
    for (const Index x : columns) beside += pressure(y, x);
    return Eigen::Array2d(beside, whole);
  });
  return loads[0] / loads[1];
}

void warn_of_load_on_seams(const topography::Topography& surface, const contact::State& state,
                           Warnings& list) {
  if (!(surface.tiles > 1)) return;
  const double share = load_on_seams(state.pressure, surface.tiles);
  if (!(share > kSeamLoad)) return;
  const bool is_bent =
      std::any_of(surface.history.begin(), surface.history.end(),
                  [](const std::string& step) { return step.starts_with("level=poly"); });
  list.push_back(
      {"seam-load",
       fmt::format("Strips {1:.0f} % of a side wide at the mirror seams carry {0:.3g} % of the "
                   "load; try {2}",
                   100 * share, 100 * kEdgeBand, is_bent ? "<crop>" : "<level=poly2> or <crop>"),
       share});
}

void warn_of_bound(const ContactSettings& settings, const contact::Summary& summary,
                   Warnings& list) {
  if (!settings.saturation_pressure) return;
  const double least = summary.mean_pressure / *settings.saturation_pressure;
  if (summary.contact_area_fraction > least * (1 + kRoundingOfBound)) return;
  list.push_back(
      {"clamp",
       fmt::format("The contact area equals P/p_sat, {:.3g} %, for any surface, as almost all "
                   "contact has yielded (counted {:.3g} %)",
                   100 * least, 100 * summary.contact_area_fraction_pixels)});
}

void warn_of_slope(const topography::Topography& surface, Warnings& list) {
  const double slope = metrology::rms_slope(surface);
  if (!(slope > kSteepSlope)) return;
  list.push_back({"steep",
                  fmt::format("Small-slope elasticity fails at an rms slope of {:.2g} (above {}). "
                              "Check units, spikes and noise",
                              slope, kSteepSlope),
                  slope});
}

void warn_of_hardness(const ContactSettings& settings, const contact::Summary& summary,
                      Warnings& list) {
  const double share = summary.max_pressure / settings.effective_modulus();
  if (settings.saturation_pressure || !(share > kHardestSolid)) return;
  list.push_back({"above-hardness",
                  fmt::format("The contact pressure exceeds E*/{:.0f}. A metal would yield "
                              "(<saturation_pressure>); rubber would not stay linear",
                              1 / kHardestSolid),
                  share});
}

void warn_of_patches(const contact::State& state, const contact::Summary& summary, Warnings& list) {
  if (summary.n_patches == 0) return;
  const double pixels = summary.contact_area_fraction_pixels *
                        static_cast<double>(state.pressure.size()) /
                        static_cast<double>(summary.n_patches);
  if (!(pixels < kFewPixels)) return;
  list.push_back({"resolution",
                  fmt::format("Patches of {} on average: the area depends on the resolution; "
                              "<lowpass_scan> tells; <resolution_scan> tells",
                              pixels == 1 ? "one pixel" : fmt::format("{:.2g} pixels", pixels)),
                  1 / pixels});
}

/// The next size below that transforms are fast with.
Index fast_size(Index n) {
  constexpr Index kFastPrime = 13;  // FFTW has kernels up to it, ducc0 to 11
  while (spectral::largest_prime_factor(n) > kFastPrime) --n;
  return n;
}

/// Where transforms took long: of a patch that does not repeat they have a size of their own. Of a
/// mirrored scan it is one copy that can be cropped.
void warn_of_sizes(const topography::Topography& surface, const contact::State& state,
                   Warnings& list) {
  const double work = state.convergence.fft_pairs * static_cast<double>(surface.grid.size());
  if (!(work > kManyTransforms)) return;
  const auto tiles = static_cast<Index>(surface.tiles);
  const Index nx = std::max<Index>(1, surface.grid.nx / tiles);
  const Index ny = std::max<Index>(1, surface.grid.ny / tiles);
  if (fast_size(nx) == nx && fast_size(ny) == ny) return;
  list.push_back(
      {"slow-size",
       fmt::format("{} x {} pixels contain the prime factor {}. Transforms took several times as "
                   "long as with {} x {} (<crop>)",
                   nx, ny,
                   std::max(spectral::largest_prime_factor(nx), spectral::largest_prime_factor(ny)),
                   fast_size(nx), fast_size(ny))});
}

/// What keeps a state from being converged.
std::string shortfall(const contact::State& state) {
  const Convergence& convergence = state.convergence;
  if (convergence.certificate <= convergence.tolerance) {
    return fmt::format("the gap is {} where solids touch, and at most {} was wanted",
                       format_si(state.gap_error, "m"), format_si(state.gap_limit, "m"));
  }
  return fmt::format("the certificate is {:.1e}, and {:.0e} was wanted", convergence.certificate,
                     convergence.tolerance);
}

}  // namespace

Warnings of_contact(const topography::Topography& surface, const ContactSettings& settings,
                    const contact::State& state, const contact::Summary& summary) {
  Warnings list;
  if (settings.is_periodic()) {
    warn_of_edges(surface, list);
    warn_of_load_on_seams(surface, state, list);
    warn_of_sizes(surface, state, list);
  } else {
    warn_of_load_on_edges(state, list);
  }
  warn_of_slope(surface, list);
  const Convergence& convergence = state.convergence;
  if (convergence.failed()) {
    list.push_back(
        {"not-converged",
         fmt::format("NOT CONVERGED ({}): {}", name_of(convergence.status), shortfall(state)),
         convergence.certificate});
  }
  if (!summary.area_correction_valid) {
    list.push_back({"area-correction",
                    "Contacts end along the pixel grid, where correcting by the perimeter is "
                    "wrong. The counted area is used"});
  }
  warn_of_hardness(settings, summary, list);
  warn_of_bound(settings, summary, list);
  warn_of_patches(state, summary, list);
  return list;
}

Warnings of_stiffness(const contact::Stiffness& stiffness) {
  if (stiffness.convergence.converged()) return {};
  return {{"stiffness",
           fmt::format("The contact stiffness is NOT CONVERGED (residual {:.1e}). Do not use it",
                       stiffness.convergence.certificate),
           stiffness.convergence.certificate}};
}

}  // namespace tabor::cases
