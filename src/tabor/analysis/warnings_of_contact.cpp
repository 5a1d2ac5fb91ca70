#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tabor/analysis/warnings.hpp"
#include "tabor/core/units.hpp"
#include "tabor/metrology/parameters.hpp"

namespace tabor::analysis {
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

void warn_of_edges(const topography::Topography& surface, Warnings& list) {
  if (surface.periodic) return;
  list.push_back(
      {"not-periodic",
       "the scan is not periodic but is solved as if it repeated: steps at its edges carry load; a "
       "cut-out of a larger surface: --mirror; an isolated body such as a ball or pad: --boundary "
       "free, whose edges carry load"});
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
  list.push_back({"edge-load",
                  fmt::format("the edges of the free patch (its outermost {:.0f} %) carry {:.3g} % "
                              "of the load: true of an isolated body such as a pad; a cut-out of a "
                              "larger surface has neighbours there: --mirror",
                              100 * kEdgeBand, 100 * share),
                  share});
}

void warn_of_slope(const topography::Topography& surface, Warnings& list) {
  const double slope = metrology::rms_slope(surface);
  if (!(slope > kSteepSlope)) return;
  list.push_back(
      {"steep",
       fmt::format("rms slope {:.2g}, above {}: elasticity of small slopes does not hold; "
                   "are the units of heights and pixels right? spikes (--despike auto) "
                   "and noise (--lowpass) make slopes",
                   slope, kSteepSlope),
       slope});
}

void warn_of_hardness(const ContactSettings& settings, const contact::Summary& summary,
                      Warnings& list) {
  const double share = summary.max_pressure / settings.effective_modulus();
  if (settings.saturation_pressure || !(share > kHardestSolid)) return;
  list.push_back(
      {"above-hardness",
       fmt::format("the contact pressure reaches {}, {:.2g} E*: no solid is as hard as {} E* "
                   "(give the hardness as --saturation-pressure), and rubber is "
                   "strained beyond linear elasticity",
                   format_si(summary.max_pressure, "Pa"), share, kHardestSolid),
       share});
}

void warn_of_patches(const contact::State& state, const contact::Summary& summary, Warnings& list) {
  if (summary.n_patches == 0) return;
  const double pixels = summary.contact_area_fraction_pixels *
                        static_cast<double>(state.pressure.size()) /
                        static_cast<double>(summary.n_patches);
  if (!(pixels < kFewPixels)) return;
  list.push_back(
      {"resolution",
       fmt::format("contact patches of {:.2g} pixels on average: the area depends on the "
                   "resolution of the scan; try a low-pass (--lowpass-scan)",
                   pixels),
       1 / pixels});
}

/// What keeps a state from being converged.
std::string shortfall(const contact::State& state) {
  const Convergence& convergence = state.convergence;
  if (convergence.certificate <= convergence.tolerance) {
    return fmt::format("gap of {} where solids touch instead of {} at most",
                       format_si(state.gap_error, "m"), format_si(state.gap_limit, "m"));
  }
  return fmt::format("certificate {:.1e} instead of {:.0e}", convergence.certificate,
                     convergence.tolerance);
}

}  // namespace

Warnings of_contact(const topography::Topography& surface, const ContactSettings& settings,
                    const contact::State& state, const contact::Summary& summary) {
  Warnings list;
  if (settings.is_periodic()) {
    warn_of_edges(surface, list);
  } else {
    warn_of_load_on_edges(state, list);
  }
  warn_of_slope(surface, list);
  const Convergence& convergence = state.convergence;
  if (convergence.failed()) {
    list.push_back(
        {"not-converged",
         fmt::format("NOT CONVERGED ({}), {}", name_of(convergence.status), shortfall(state)),
         convergence.certificate});
  }
  if (!summary.area_correction_valid) {
    list.push_back({"area-correction",
                    "saturated regions fill whole rows, the perimeter correction of the area does "
                    "not hold there"});
  }
  warn_of_hardness(settings, summary, list);
  warn_of_patches(state, summary, list);
  return list;
}

Warnings of_stiffness(const contact::Stiffness& stiffness) {
  if (stiffness.convergence.converged()) return {};
  return {{"stiffness",
           fmt::format("contact stiffness: NOT CONVERGED, residual {:.1e}; do not use it",
                       stiffness.convergence.certificate),
           stiffness.convergence.certificate}};
}

}  // namespace tabor::analysis
