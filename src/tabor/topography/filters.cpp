#include "tabor/topography/filters.hpp"

#include <fmt/format.h>

#include <algorithm>
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
    if (known == name) {
      return kind;
    }
    names.emplace_back(known);
  }
  throw InputError(fmt::format("filter of {}", step), fmt::format("'{}'", name),
                   "hann, hann-full, hann-separable, gauss or gauss-reflect, then ':' and a cutoff",
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

/// What a row is beyond its ends.
enum class Beyond { nothing, row_again, mirror_image };

/// How a Gaussian is applied: what lies beyond the edges, and where its weights end [cutoff
/// wavelengths].
struct Gaussian {
  double wavelength = 0;  ///< [m]
  Beyond beyond = Beyond::nothing;
  double reach = 1.35;  ///< there weights are 1e-11 of the largest; mirrored: to the next pixel
};

/// Standard deviation over cutoff wavelength, sqrt(ln 2 / 2) / pi.
constexpr double kSigmaOfCutoff = 0.1873906251292776;

Gaussian gaussian_of(const Filter& filter, double wavelength, bool periodic) {
  if (filter.kind == FilterKind::gauss_reflect) {
    return {wavelength, Beyond::mirror_image, 4 * kSigmaOfCutoff};
  }
  return {wavelength, periodic ? Beyond::row_again : Beyond::nothing};
}

/// Weights w_0, w_1, ... of ISO 16610-21: exp(-pi (x / (alpha lc))^2), alpha = sqrt(ln 2 / pi).
std::vector<double> gaussian_weights(double spacing, const Gaussian& gaussian) {
  const double alpha = std::sqrt(std::numbers::ln2 / pi);
  const bool mirrored = gaussian.beyond == Beyond::mirror_image;
  const double reach = gaussian.reach * gaussian.wavelength + (mirrored ? spacing / 2 : 0);
  std::vector<double> weights;
  for (Index k = 0; static_cast<double>(k) * spacing <= reach; ++k) {
    const double x = static_cast<double>(k) * spacing / (alpha * gaussian.wavelength);
    weights.push_back(std::exp(-pi * x * x));
  }
  return weights;
}

/// Pixel of the row that stands for position x beyond its ends.
Index inside(Index x, Index n, Beyond beyond) {
  const Index period = beyond == Beyond::mirror_image ? 2 * n : n;
  x = ((x % period) + period) % period;
  return x < n ? x : period - 1 - x;
}

/// Weighted sums along one row.
void smooth_row(double* row, Index n, const std::vector<double>& weights, Beyond beyond) {
  const bool open = beyond == Beyond::nothing;
  const Index reach = std::ssize(weights) - 1;
  const Index halo = open ? std::min(reach, n - 1) : reach;  // beyond n - 1 there is nothing to add
  Eigen::ArrayXd extended = Eigen::ArrayXd::Zero(n + 2 * halo);
  for (Index x = open ? 0 : -halo; x < (open ? n : n + halo); ++x) {
    extended[x + halo] = row[inside(x, n, beyond)];
  }
  Eigen::Map<Eigen::ArrayXd> result(row, n);
  result = weights[0] * extended.segment(halo, n);
  for (Index k = 1; k <= halo; ++k) {
    result += weights[static_cast<std::size_t>(k)] *
              (extended.segment(halo - k, n) + extended.segment(halo + k, n));
  }
}

/// A Gaussian along both axes, without normalisation.
Field smooth_both(Field field, const Grid& grid, const Gaussian& gaussian) {
  for (const double spacing : {grid.dx(), grid.dy()}) {
    const auto weights = gaussian_weights(spacing, gaussian);
    for_each_row(field.rows(), [&](Index y) {
      smooth_row(&field(y, 0), field.cols(), weights, gaussian.beyond);
    });
    field = Field(field.transpose());  // twice: back in the original order at the end
  }
  return field;
}

/// Without holes the sum of weights is a product of one factor per axis.
Eigen::ArrayXd weight_sums(Index n, double spacing, const Gaussian& gaussian) {
  Eigen::ArrayXd sums = Eigen::ArrayXd::Ones(n);
  smooth_row(sums.data(), n, gaussian_weights(spacing, gaussian), gaussian.beyond);
  return sums;
}

Field gaussian_low_pass(const Field& height, const Grid& grid, const Gaussian& gaussian) {
  if (!height.hasNaN()) {
    Field smooth = smooth_both(height, grid, gaussian);
    smooth.rowwise() /= weight_sums(grid.nx, grid.dx(), gaussian).transpose();
    smooth.colwise() /= weight_sums(grid.ny, grid.dy(), gaussian);
    return smooth;
  }
  const auto missing = height.isNaN();
  Field smooth = smooth_both(missing.select(0, height), grid, gaussian);
  Field weight = 1 - missing.cast<double>();
  smooth /= smooth_both(std::move(weight), grid, gaussian);
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
    case FilterKind::gauss_reflect:
      text += ", mirrored at the edges, weights cut at 4 sigma";
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

bool is_gaussian(FilterKind kind) {
  return kind == FilterKind::gauss || kind == FilterKind::gauss_reflect;
}

/// Far beyond the scan a cutoff is a typing error, and its weights would not fit into memory.
void check_cutoff(const Filter& filter, double wavelength, const Grid& grid) {
  const double side = std::max(grid.lx, grid.ly);
  if (!(wavelength <= 100 * side)) {
    throw InputError("cutoff of a filter", format_si(wavelength, "m"),
                     fmt::format("at most the size of the scan, {}", format_si(side, "m")),
                     fmt::format("is the unit in {} right?", to_string(filter)));
  }
}

/// What to think of a cutoff that does nearly nothing, or nearly everything; "" if neither.
std::string doubt_about(const Filter& filter, double wavelength, const Grid& grid) {
  if (wavelength > std::min(grid.lx, grid.ly)) {
    return fmt::format(
        "the cutoff of {} is longer than the scan ({} x {}): hardly more than a mean passes",
        to_string(filter), format_si(grid.lx, "m"), format_si(grid.ly, "m"));
  }
  const double pixel = std::max(grid.dx(), grid.dy());
  if (is_gaussian(filter.kind) && wavelength < 2 * pixel) {
    return fmt::format("the cutoff of {} is below two pixels ({}): it changes hardly anything",
                       to_string(filter), format_si(2 * pixel, "m"));
  }
  return "";
}

Topography filtered(Topography topography, const Filter& filter, double side, bool high) {
  side = side > 0 ? side : scan_side(topography.grid);
  Topography result = topography;
  result.height = low_pass(topography.height, topography.grid, filter, side, topography.periodic);
  if (high) {
    result.height = topography.height - result.height;
  }
  const auto doubt = doubt_about(filter, filter.cutoff_wavelength(side), topography.grid);
  if (!doubt.empty()) {
    result.doubts.push_back(doubt);
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
  check_cutoff(filter, wavelength, grid);
  return is_gaussian(filter.kind)
             ? gaussian_low_pass(height, grid, gaussian_of(filter, wavelength, periodic))
             : hann_low_pass(height, grid, filter.kind, wavelength);
}

Topography low_pass(Topography topography, const Filter& filter, double side) {
  return filtered(std::move(topography), filter, side, false);
}

Topography high_pass(Topography topography, const Filter& filter, double side) {
  return filtered(std::move(topography), filter, side, true);
}

}  // namespace tabor::topography
