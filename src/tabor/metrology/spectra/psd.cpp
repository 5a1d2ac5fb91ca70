#include "tabor/metrology/spectra/psd.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/core/names.hpp"
#include "tabor/metrology/spectra/profile_spectrum.hpp"
#include "tabor/metrology/spectra/radial_spectrum.hpp"
#include "tabor/metrology/spectra/window_bias.hpp"
#include "tabor/numerics/field_statistics.hpp"
#include "tabor/topography/edges.hpp"

namespace tabor::metrology {
namespace {

using std::numbers::pi;

constexpr auto kConventions = names<PsdConvention>("jacobs", "persson", "gwyddion");
constexpr auto kWindows = names<PsdWindow>("none", "hann");

/// Exponents of all spectra.
void fit(const Grid& grid, const PsdOptions& options, PowerSpectra& spectra) {
  const auto one = [&](Spectrum& spectrum, double offset, const auto& bias) {
    if (spectrum.q.empty()) return;
    const auto range = find_fit_range(spectrum, offset);
    spectrum.hurst = fit_hurst(spectrum, offset, options.fit_q_min.value_or(range.q_min),
                               options.fit_q_max.value_or(range.q_max), [&](double exponent) {
                                 return bias(spectrum.q, range.roll_off, exponent);
                               });
  };
  const auto along = [&](double length) {
    return [&spectra, length](const std::vector<double>& q, double roll_off, double exponent) {
      return spectra.window == PsdWindow::hann ? line_bias(q, length, roll_off, exponent)
                                               : std::vector<double>(q.size());
    };
  };
  one(spectra.x, 1, along(grid.lx));
  one(spectra.y, 1, along(grid.ly));
  one(spectra.radial, 2, [&](const std::vector<double>& q, double roll_off, double exponent) {
    return ring_bias(q, grid, spectra.window, roll_off, exponent);
  });
}

void convert(PowerSpectra& spectra, PsdConvention convention) {
  spectra.convention = convention;
  spectra.x.unit = spectra.y.unit = "m^3";
  spectra.radial.unit = convention == PsdConvention::gwyddion ? "m^3" : "m^4";
  if (convention == PsdConvention::jacobs) return;
  for (Spectrum* line : {&spectra.x, &spectra.y}) {
    for (double& density : line->density) density /= 2 * pi;
  }
  for (std::size_t i = 0; i < spectra.radial.q.size(); ++i) {
    const bool persson = convention == PsdConvention::persson;
    spectra.radial.density[i] *= persson ? 1 / (4 * pi * pi) : spectra.radial.q[i] / (2 * pi);
  }
}

void check_complete(const topography::Topography& topography) {
  const Index n_missing = topography::count_holes(topography);
  if (n_missing > 0) {
    throw InputError("power spectrum", fmt::format("{} missing heights", n_missing),
                     "a surface without holes", "fill them first (<fill=harmonic>)");
  }
  if (topography.grid.size() < 2) {
    throw InputError("power spectrum", "a single height", "at least two", "");
  }
}

/// Along the axes that have more than one pixel.
void add_lines(const topography::Topography& topography, PowerSpectra& spectra) {
  const Grid& grid = topography.grid;
  const Field& height = topography.height;
  if (grid.nx > 1) {
    spectra.x = profile_spectrum(grid.ny, grid.nx, grid.lx, spectra.window,
                                 [&](Index y, std::span<double> row) {
                                   Eigen::Map<Eigen::ArrayXd>(row.data(), grid.nx) = height.row(y);
                                 });
  }
  if (grid.ny > 1) {
    spectra.y = profile_spectrum(grid.nx, grid.ny, grid.ly, spectra.window,
                                 [&](Index x, std::span<double> row) {
                                   Eigen::Map<Eigen::ArrayXd>(row.data(), grid.ny) = height.col(x);
                                 });
  }
}

void add_area(const topography::Topography& topography, PowerSpectra& spectra) {
  spectra.radial = radial_spectrum(topography.height, topography.grid, spectra.window);
  spectra.rms_height = spectra.radial.rms_height;
  spectra.rms_slope = spectra.radial.rms_slope;
}

/// What an area has from its two-dimensional sum, from the one line.
void take_from_line(const topography::Topography& topography, PowerSpectra& spectra) {
  const Spectrum& line = topography.grid.nx > 1 ? spectra.x : spectra.y;
  spectra.rms_height = line.rms_height;
  spectra.rms_slope = line.rms_slope;
}

/// Variance of the windowed heights, as the spectrum has it, over that of the heights.
double window_gain(const topography::Topography& topography, const PowerSpectra& spectra) {
  const double before = numerics::rms_height(topography.height);
  return spectra.window == PsdWindow::hann && before > 0 ? std::pow(spectra.rms_height / before, 2)
                                                         : 1;
}

/// Rejects a range of the fit in which the spectra have nothing.
void check_fit_range(const PsdOptions& options, const PowerSpectra& spectra) {
  double shortest = std::numeric_limits<double>::infinity();
  double longest = 0;
  for (const Spectrum* one : {&spectra.x, &spectra.y, &spectra.radial}) {
    if (one->q.empty()) continue;
    shortest = std::min(shortest, one->q.front());
    longest = std::max(longest, one->q.back());
  }
  const auto check = [&](const char* option, std::optional<double> q, bool is_in) {
    if (!q || is_in || !(longest > 0)) return;
    throw InputError(
        option, fmt::format("{:g} rad/m", *q),
        fmt::format("a wavevector of the spectra, {:.3g} to {:.3g} rad/m", shortest, longest), "");
  };
  check("fit_min", options.fit_q_min, options.fit_q_min < longest);
  check("fit_max", options.fit_q_max, options.fit_q_max > shortest);
}

}  // namespace

std::optional<PsdConvention> psd_convention_from(std::string_view name) {
  return kConventions.find(name);
}
std::optional<PsdWindow> psd_window_from(std::string_view name) { return kWindows.find(name); }
std::string_view name_of(PsdConvention convention) { return kConventions.of(convention); }
std::string_view name_of(PsdWindow window) { return kWindows.of(window); }

PowerSpectra power_spectra(const topography::Topography& topography, const PsdOptions& options) {
  check_complete(topography);
  if (numerics::is_flat(topography.height) && !(topography.height == 0).all()) {
    topography::Topography flat = topography;
    flat.height.setZero();  // rounding has no spectrum
    return power_spectra(flat, options);
  }
  if (options.fit_q_min && options.fit_q_max && !(*options.fit_q_min < *options.fit_q_max)) {
    throw InputError("fit_min", fmt::format("{:g} rad/m", *options.fit_q_min),
                     fmt::format("less than fit_max, {:g} rad/m", *options.fit_q_max), "");
  }
  PowerSpectra spectra;
  spectra.window = options.window.value_or(
      topography::tiles_as_it_is(topography) ? PsdWindow::none : PsdWindow::hann);
  add_lines(topography, spectra);
  if (topography::is_profile(topography.grid)) {
    take_from_line(topography, spectra);
  } else {
    add_area(topography, spectra);
  }
  spectra.window_gain = window_gain(topography, spectra);
  check_fit_range(options, spectra);
  fit(topography.grid, options, spectra);
  convert(spectra, options.convention);
  return spectra;
}

}  // namespace tabor::metrology
