#include <fmt/format.h>

#include <algorithm>

#include "tabor/cases/warnings.hpp"
#include "tabor/core/units.hpp"
#include "tabor/metrology/areal/parameters.hpp"
#include "tabor/topography/edges.hpp"
#include "tabor/topography/levelling.hpp"

namespace tabor::cases {
namespace {

/// Relative change of Sq: a tilt that changes it less has a range of a sixth of Sq over the scan,
/// or less.
constexpr double kNegligibleTilt = 1e-3;

bool is_levelled(const topography::Topography& surface) {
  const auto& history = surface.history;
  return std::any_of(history.begin(), history.end(), [](const std::string& step) {
    return step.starts_with("highpass=") ||
           (step.starts_with("level=") && step != "level=none" && !step.starts_with("level=mean") &&
            !step.starts_with("level=rows"));
  });
}

}  // namespace

std::optional<Warning> not_levelled(const topography::Topography& surface) {
  if (topography::repeats(surface) || is_levelled(surface)) return std::nullopt;
  const auto plane = topography::try_fit_form(surface.height, 1);
  if (!plane) return std::nullopt;  // too few points to have a tilt
  const double before = metrology::rms_height(surface);
  const double after = topography::rms_without_form(surface.height, *plane);
  if (before <= after * (1 + kNegligibleTilt)) return std::nullopt;
  return Warning{
      "not-levelled",
      fmt::format("The surface is not levelled (Sq {}, {} without its plane); <level=plane> "
                  "removes the tilt",
                  format_si(before, "m"), format_si(after, "m")),
      after > 0 ? before / after : 0};
}

Warnings of_surface(const topography::Topography& surface) {
  Warnings list;
  const auto level = not_levelled(surface);
  for (const Warning& warning : surface.warnings) {
    if (level && warning.code == "tilt") continue;  // the same in other words
    list.push_back({warning.code, warning.text});
  }
  if (level) list.push_back(*level);
  return list;
}

Warnings joined(Warnings of_surface, const Warnings& of_result) {
  add(of_result, of_surface);
  return of_surface;
}

Warnings of_spectra(const metrology::PowerSpectra& spectra) {
  std::string strange;
  double farthest = 0;
  const auto look_at = [&](const std::string& name, const metrology::HurstFit& fit) {
    if (!(fit.hurst - fit.standard_error > 1) && !(fit.hurst + fit.standard_error < 0)) return;
    strange += fmt::format("{}{} {}", strange.empty() ? "" : ", ", name, plain(fit.hurst, 3));
    farthest = std::max({farthest, fit.hurst - 1, -fit.hurst});
  };
  look_at("C1D x", spectra.x.hurst);
  look_at("C1D y", spectra.y.hurst);
  look_at("C2D", spectra.radial.hurst);
  if (strange.empty()) return {};
  return {
      {"hurst",
       fmt::format("The Hurst exponent is outside 0 to 1 ({}): noise or a filter; <fit_min> and "
                   "<fit_max> help",
                   strange),
       farthest}};
}

}  // namespace tabor::cases
