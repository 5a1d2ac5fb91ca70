#include "tabor/topography/filters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/numerics/field_statistics.hpp"
#include "tabor/spectral/fft.hpp"
#include "tabor/topography/edges.hpp"
#include "tabor/topography/gaussian.hpp"

namespace tabor::topography {
namespace {

using std::numbers::pi;

constexpr std::array<std::pair<std::string_view, FilterKind>, 5> kKinds{
    {{"hann", FilterKind::hann},
     {"hann-full", FilterKind::hann_full},
     {"hann-separable", FilterKind::hann_separable},
     {"gauss", FilterKind::gauss},
     {"gauss-reflect", FilterKind::gauss_reflect}}};

std::string_view name_of(FilterKind kind) { return kKinds[static_cast<std::size_t>(kind)].first; }

FilterKind parse_kind(std::string_view name, std::string_view step) {
  std::vector<std::string> names;
  for (const auto& [known, kind] : kKinds) {
    if (known == name) return kind;
    names.emplace_back(known);
  }
  throw InputError(fmt::format("filter of {}", step), fmt::format("'{}'", name),
                   "hann, hann-full, hann-separable, gauss or gauss-reflect, then ':' and a cutoff",
                   fmt::format("e.g. {}=hann:512/L{}", step, suggestion(name, names)));
}

[[noreturn]] void reject_cutoff(std::string_view cutoff, std::string_view step) {
  throw InputError(fmt::format("cutoff of {}", step), fmt::format("'{}'", cutoff),
                   "a positive wavelength (8um), its inverse (1/8um) or cycles per side (512/L)",
                   fmt::format("e.g. {}=hann:512/L or {}=gauss:8um", step, step));
}

/// "8um", "(8 um)" -> metres.
double parse_wavelength(std::string_view text, std::string_view whole, std::string_view step) {
  text = trim(text);
  if (text.starts_with('(') && text.ends_with(')')) text = text.substr(1, text.size() - 2);
  if (parse_number(text)) reject_cutoff(whole, step);  // a unit is missing
  const double wavelength = parse_si(text, dimension::length, fmt::format("--{}", step));
  if (!(wavelength > 0) || !std::isfinite(wavelength)) reject_cutoff(whole, step);
  return wavelength;
}

void parse_cutoff(Filter& filter, std::string_view cutoff, std::string_view step) {
  const auto slash = cutoff.find('/');
  if (slash == std::string_view::npos) {
    filter.wavelength = parse_wavelength(cutoff, cutoff, step);
    return;
  }
  const auto cycles = parse_number(cutoff.substr(0, slash));
  if (!cycles || !(*cycles > 0) || !std::isfinite(*cycles)) reject_cutoff(cutoff, step);
  const auto below = trim(cutoff.substr(slash + 1));
  if (below == "L") {
    filter.cycles_per_side = *cycles;
  } else {
    filter.wavelength = parse_wavelength(below, cutoff, step) / *cycles;
  }
}

/// Hann taper of a frequency relative to its cutoff.
double hann(double relative) { return relative < 1 ? 0.5 * (1 + std::cos(pi * relative)) : 0; }

Field hann_low_pass(const Field& height, const Grid& grid, FilterKind kind, double wavelength) {
  if (height.hasNaN()) {
    throw InputError("Hann filter", fmt::format("{} missing heights", height.isNaN().count()),
                     "a surface without holes",
                     "fill them first (<fill=harmonic>) or use gauss, which leaves holes out");
  }
  const double cutoff =
      (kind == FilterKind::hann_full ? 0.5 : 1.0) / wavelength;  // cycles per metre
  const auto transfer = [&](Index kx, std::span<double> values) {
    const double x = static_cast<double>(kx) / (grid.lx * cutoff);
    for (std::size_t ky = 0; ky < values.size(); ++ky) {
      const double y = static_cast<double>(ky) / (grid.ly * cutoff);
      values[ky] = kind == FilterKind::hann_separable ? hann(x) * hann(y) : hann(std::hypot(x, y));
    }
  };
  Field smooth(height.rows(), height.cols());
  spectral::Convolution<double>(grid.ny, grid.nx).apply(height.data(), transfer, smooth.data());
  return smooth;
}

Gaussian gaussian_of(const Filter& filter, double wavelength, bool periodic) {
  if (filter.kind == FilterKind::gauss_reflect) {
    return {wavelength, Beyond::mirror_image, 4 * kSigmaOfCutoff};
  }
  return {wavelength, periodic ? Beyond::row_again : Beyond::nothing};
}

std::string cutoff_text(const Filter& filter, double side) {
  const double wavelength = filter.cutoff_wavelength(side);
  std::string text = fmt::format("cutoff wavelength {}", format_si(wavelength, "m"));
  if (filter.cycles_per_side > 0) text += fmt::format(" (L = {})", format_si(side, "m"));
  switch (filter.kind) {
    case FilterKind::hann:
      return "radial, " + text;
    case FilterKind::hann_full:
      return fmt::format("radial, full width, {}, zero below {}", text,
                         format_si(2 * wavelength, "m"));
    case FilterKind::hann_separable:
      return "H(kx) H(ky), " + text;
    case FilterKind::gauss:
      break;
    case FilterKind::gauss_reflect:
      text += ", mirrored at the edges, weights cut at 4 sigma";
  }
  return "50 % at the " + text;
}

std::string describe(std::string_view step, const Filter& filter, double side,
                     const Topography& before, const Topography& after) {
  const double pixel = std::max(before.grid.dx(), before.grid.dy());
  const bool mild = filter.cutoff_wavelength(side) <= 2 * pixel;
  const auto rms = [](const Topography& surface) {
    return format_si(numerics::rms_height(surface.height), "m");
  };
  const auto slope = [](const Topography& surface) {  // of a profile there is none
    return numerics::rms_slope(surface.height, surface.grid);
  };
  return fmt::format("{}={}: {}, {:.4g} pixels{}; Sq {} -> {}{}", step, to_string(filter),
                     cutoff_text(filter, side), filter.cutoff_wavelength(side) / pixel,
                     mild ? " (mild: its end lies beyond Nyquist)" : "", rms(before), rms(after),
                     std::isnan(slope(before))
                         ? ""
                         : fmt::format(", Sdq {:.4g} -> {:.4g}", slope(before), slope(after)));
}

bool is_gaussian(FilterKind kind) {
  return kind == FilterKind::gauss || kind == FilterKind::gauss_reflect;
}

/// Far beyond the scan a cutoff is a typing error, and its weights would not fit into memory.
void check_cutoff(const Filter& filter, double wavelength, const Grid& grid) {
  const double side = std::max(grid.lx, grid.ly);
  if (!(wavelength <= 100 * side)) {
    throw InputError("cutoff of a filter", format_si(wavelength, "m"),
                     fmt::format("at most 100 times the scan's {}", format_si(side, "m")),
                     fmt::format("check the unit in {}", to_string(filter)));
  }
}

/// What to think of a cutoff that does nearly nothing, or nearly everything; "" if neither.
std::string warning_about(const Filter& filter, double wavelength, const Grid& grid, bool high) {
  if (wavelength > (is_profile(grid) ? scan_side(grid) : std::min(grid.lx, grid.ly))) {
    return fmt::format(
        "The cutoff of {} is longer than the scan ({} x {}), so little more than the mean {}",
        to_string(filter), format_si(grid.lx, "m"), format_si(grid.ly, "m"),
        high ? "is removed" : "remains");
  }
  const double pixel = std::max(grid.dx(), grid.dy());
  if (is_gaussian(filter.kind) && wavelength < 2 * pixel) {
    return fmt::format("The cutoff of {} is below two pixels ({}), so it {}", to_string(filter),
                       format_si(2 * pixel, "m"),
                       high ? "leaves almost nothing" : "changes almost nothing");
  }
  return "";
}

Topography filtered(Topography topography, const Filter& filter, bool high) {
  const Topography before = std::move(topography);
  const double side = filter_side(before);
  Topography result = before;
  result.height = low_pass(before.height, before.grid, filter, side, before.periodic);
  if (high) {
    result.height = numerics::without_rounding(before.height - result.height,
                                               numerics::largest_magnitude(before.height));
  }
  const bool wraps = !is_gaussian(filter.kind);
  if (wraps && !repeats(before) && !before.edges_joined && !edges_match(before.height)) {
    result.edges_joined = true;
    result.warnings.push_back({.code = "filter-wraps",
                               .text = fmt::format("The filter {} joins opposite edges, which do "
                                                   "not match; put <mirror> before it",
                                                   to_string(filter))});
  }
  const auto warning = warning_about(filter, filter.cutoff_wavelength(side), before.grid, high);
  if (!warning.empty()) result.warnings.push_back({.code = "filter", .text = warning});
  result.history.push_back(describe(high ? "highpass" : "lowpass", filter, side, before, result));
  return result;
}

}  // namespace

Filter parse_filter(std::string_view text, std::string_view step) {
  Filter filter;
  const auto colon = text.find(':');
  filter.kind = parse_kind(trim(text.substr(0, colon)), step);
  if (colon == std::string_view::npos) reject_cutoff("", step);
  parse_cutoff(filter, trim(text.substr(colon + 1)), step);
  return filter;
}

std::string to_string(const Filter& filter) {
  if (filter.cycles_per_side > 0) {
    return fmt::format("{}:{}/L", name_of(filter.kind), filter.cycles_per_side);
  }
  return fmt::format("{}:{:.12g}um", name_of(filter.kind), filter.wavelength * 1e6);
}

double scan_side(const Grid& grid) {
  if (grid.ny == 1) return grid.lx;
  if (grid.nx == 1) return grid.ly;
  return std::sqrt(grid.lx * grid.ly);
}

double filter_side(const Topography& topography) {
  return scan_side(topography.grid) / topography.tiles;
}

Field low_pass(const Field& height, const Grid& grid, const Filter& filter, double side,
               bool periodic) {
  const double wavelength = filter.cutoff_wavelength(side);
  check_cutoff(filter, wavelength, grid);
  return is_gaussian(filter.kind)
             ? gaussian_low_pass(height, grid, gaussian_of(filter, wavelength, periodic))
             : hann_low_pass(height, grid, filter.kind, wavelength);
}

Topography low_pass(Topography topography, const Filter& filter) {
  return filtered(std::move(topography), filter, false);
}

Topography high_pass(Topography topography, const Filter& filter) {
  return filtered(std::move(topography), filter, true);
}

}  // namespace tabor::topography
