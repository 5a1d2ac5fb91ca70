#include "tabor/topography/filters.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/spectral/fft.hpp"
#include "tabor/topography/parameters.hpp"
#include "tabor/topography/rows.hpp"

namespace tabor::topography {
namespace {

using std::numbers::pi;

constexpr std::array<std::pair<std::string_view, FilterKind>, 4> kKinds{
    {{"hann", FilterKind::hann},
     {"hann-full", FilterKind::hann_full},
     {"hann-separable", FilterKind::hann_separable},
     {"gauss", FilterKind::gauss}}};

std::string_view name_of(FilterKind kind) { return kKinds[static_cast<std::size_t>(kind)].first; }

FilterKind parse_kind(std::string_view name, std::string_view step) {
  std::vector<std::string> names;
  for (const auto& [known, kind] : kKinds) {
    if (known == name) {
      return kind;
    }
    names.emplace_back(known);
  }
  throw InputError(fmt::format("filter of {}", step), fmt::format("'{}'", name),
                   "hann, hann-full, hann-separable or gauss, then ':' and a cutoff",
                   fmt::format("e.g. {}=hann:512/L{}", step, suggestion(name, names)));
}

[[noreturn]] void refuse_cutoff(std::string_view cutoff, std::string_view step) {
  throw InputError(fmt::format("cutoff of {}", step), fmt::format("'{}'", cutoff),
                   "a positive wavelength (8um), its inverse (1/8um) or cycles per side (512/L)",
                   fmt::format("e.g. {}=hann:512/L or {}=gauss:8um", step, step));
}

/// "8um", "(8 um)" -> metres.
double parse_wavelength(std::string_view text, std::string_view whole, std::string_view step) {
  text = trim(text);
  if (text.starts_with('(') && text.ends_with(')')) {
    text = text.substr(1, text.size() - 2);
  }
  const double wavelength = parse_si(text, dimension::length, fmt::format("--{}", step));
  if (!(wavelength > 0) || !std::isfinite(wavelength)) {
    refuse_cutoff(whole, step);
  }
  return wavelength;
}

void parse_cutoff(Filter& filter, std::string_view cutoff, std::string_view step) {
  const auto slash = cutoff.find('/');
  if (slash == std::string_view::npos) {
    filter.wavelength = parse_wavelength(cutoff, cutoff, step);
    return;
  }
  const auto cycles = parse_number(cutoff.substr(0, slash));
  if (!cycles || !(*cycles > 0) || !std::isfinite(*cycles)) {
    refuse_cutoff(cutoff, step);
  }
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
                     "fill them first (--fill harmonic) or use gauss, which leaves holes out");
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

/// Gaussian weights w_0, w_1, ... of ISO 16610-21: exp(-pi (x / (alpha lc))^2) with
/// alpha = sqrt(ln 2 / pi), down to 1e-11 of the largest.
std::vector<double> gaussian_weights(double spacing, double wavelength) {
  constexpr double reach = 1.35;  // cutoff wavelengths
  const double alpha = std::sqrt(std::numbers::ln2 / pi);
  std::vector<double> weights;
  for (Index k = 0; static_cast<double>(k) * spacing <= reach * wavelength; ++k) {
    const double x = static_cast<double>(k) * spacing / (alpha * wavelength);
    weights.push_back(std::exp(-pi * x * x));
  }
  return weights;
}

/// Weighted sums along one row; beyond its ends nothing, or the row again if periodic.
void smooth_row(double* row, Index n, const std::vector<double>& weights, bool periodic) {
  const auto halo = static_cast<Index>(weights.size()) - 1;
  Eigen::ArrayXd extended = Eigen::ArrayXd::Zero(n + 2 * halo);
  for (Index x = periodic ? -halo : 0; x < (periodic ? n + halo : n); ++x) {
    extended[x + halo] = row[((x % n) + n) % n];
  }
  Eigen::Map<Eigen::ArrayXd> result(row, n);
  result = weights[0] * extended.segment(halo, n);
  for (Index k = 1; k <= halo; ++k) {
    result += weights[static_cast<std::size_t>(k)] *
              (extended.segment(halo - k, n) + extended.segment(halo + k, n));
  }
}

/// A Gaussian along both axes, without normalisation.
Field smooth_both(Field field, const Grid& grid, double wavelength, bool periodic) {
  for (const double spacing : {grid.dx(), grid.dy()}) {
    const auto weights = gaussian_weights(spacing, wavelength);
    for_each_row(field.rows(),
                 [&](Index y) { smooth_row(&field(y, 0), field.cols(), weights, periodic); });
    field = Field(field.transpose());  // twice: back in the original order at the end
  }
  return field;
}

/// Without holes the sum of weights is a product of one factor per axis.
Eigen::ArrayXd weight_sums(Index n, double spacing, double wavelength, bool periodic) {
  Eigen::ArrayXd sums = Eigen::ArrayXd::Ones(n);
  smooth_row(sums.data(), n, gaussian_weights(spacing, wavelength), periodic);
  return sums;
}

Field gaussian_low_pass(const Field& height, const Grid& grid, double wavelength, bool periodic) {
  if (!height.hasNaN()) {
    Field smooth = smooth_both(height, grid, wavelength, periodic);
    smooth.rowwise() /= weight_sums(grid.nx, grid.dx(), wavelength, periodic).transpose();
    smooth.colwise() /= weight_sums(grid.ny, grid.dy(), wavelength, periodic);
    return smooth;
  }
  const auto missing = height.isNaN();
  Field smooth = smooth_both(missing.select(0, height), grid, wavelength, periodic);
  Field weight = 1 - missing.cast<double>();
  smooth /= smooth_both(std::move(weight), grid, wavelength, periodic);
  return missing.select(height, smooth);
}

std::string cutoff_text(const Filter& filter, double side) {
  const double wavelength = filter.cutoff_wavelength(side);
  std::string text = fmt::format("cutoff wavelength {}", format_si(wavelength, "m"));
  if (filter.cycles_per_side > 0) {
    text += fmt::format(" (L = {})", format_si(side, "m"));
  }
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
  }
  return "50 % at the " + text;
}

std::string describe(std::string_view step, const Filter& filter, double side,
                     const Topography& before, const Topography& after) {
  const double pixel = std::max(before.grid.dx(), before.grid.dy());
  const bool mild = filter.cutoff_wavelength(side) <= 2 * pixel;
  return fmt::format(
      "{}={}: {}, {:.4g} pixels{}; Sq {} -> {}, Sdq {:.4g} -> {:.4g}", step, to_string(filter),
      cutoff_text(filter, side), filter.cutoff_wavelength(side) / pixel,
      mild ? " (mild: its end lies beyond Nyquist)" : "", format_si(rms_height(before), "m"),
      format_si(rms_height(after), "m"), rms_slope(before), rms_slope(after));
}

Topography filtered(Topography topography, const Filter& filter, double side, bool high) {
  side = side > 0 ? side : scan_side(topography.grid);
  Topography result = topography;
  result.height = low_pass(topography.height, topography.grid, filter, side, topography.periodic);
  if (high) {
    result.height = topography.height - result.height;
  }
  result.history.push_back(
      describe(high ? "highpass" : "lowpass", filter, side, topography, result));
  return result;
}

}  // namespace

Filter parse_filter(std::string_view text, std::string_view step) {
  Filter filter;
  const auto colon = text.find(':');
  filter.kind = parse_kind(trim(text.substr(0, colon)), step);
  if (colon == std::string_view::npos) {
    refuse_cutoff("", step);
  }
  parse_cutoff(filter, trim(text.substr(colon + 1)), step);
  return filter;
}

std::string to_string(const Filter& filter) {
  if (filter.cycles_per_side > 0) {
    return fmt::format("{}:{}/L", name_of(filter.kind), filter.cycles_per_side);
  }
  return fmt::format("{}:{:.12g}um", name_of(filter.kind), filter.wavelength * 1e6);
}

double scan_side(const Grid& grid) { return std::sqrt(grid.lx * grid.ly); }

Field low_pass(const Field& height, const Grid& grid, const Filter& filter, double side,
               bool periodic) {
  const double wavelength = filter.cutoff_wavelength(side);
  return filter.kind == FilterKind::gauss ? gaussian_low_pass(height, grid, wavelength, periodic)
                                          : hann_low_pass(height, grid, filter.kind, wavelength);
}

Topography low_pass(Topography topography, const Filter& filter, double side) {
  return filtered(std::move(topography), filter, side, false);
}

Topography high_pass(Topography topography, const Filter& filter, double side) {
  return filtered(std::move(topography), filter, side, true);
}

}  // namespace tabor::topography
