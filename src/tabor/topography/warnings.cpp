#include "tabor/topography/warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <optional>
#include <string_view>

#include "tabor/core/error.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/core/units.hpp"
#include "tabor/numerics/field_statistics.hpp"
#include "tabor/topography/edges.hpp"
#include "tabor/topography/geometry.hpp"
#include "tabor/topography/levelling.hpp"
#include "tabor/topography/row_offsets.hpp"
#include "tabor/topography/spikes.hpp"

namespace tabor::topography {
namespace {

/// Heights looked at to estimate the quantum before all are checked.
constexpr Index kSample = Index{1} << 20;
/// A ratio this close to an integer counts as one. Random heights pass with a chance of 1/5 per
/// distinct height, quantised ones always.
constexpr double kIntegerTolerance = 0.1;
/// Resolution of float32: below it a step is rounding, not quantisation.
constexpr double kFinestShare = 0x1p-24;

void keep_distinct(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// Every stride-th valid height, ascending, without repetition.
std::vector<double> distinct_heights(const Field& height, Index stride) {
  constexpr std::size_t kMany = 2 * static_cast<std::size_t>(kSample);
  std::vector<double> values;
  for (Index i = 0; i < height.size(); i += stride) {
    if (std::isfinite(height.data()[i])) values.push_back(height.data()[i]);
    // Where a small stride is needed there are few levels: the list must not grow as the map.
    if (values.size() == kMany) keep_distinct(values);
    if (values.size() == kMany) break;
  }
  keep_distinct(values);
  return values;
}

/// Hands over the values in ascending order until `accept` returns false. Sorts no more of them
/// than it hands over, or little more.
void ascending(std::vector<double>& values, const std::function<bool(double)>& accept) {
  auto begin = values.begin();
  for (std::ptrdiff_t n = 1024; begin != values.end(); n *= 8) {
    const auto end = begin + std::min(n, values.end() - begin);
    std::nth_element(begin, end - 1, values.end());
    std::sort(begin, end);
    if (!std::all_of(begin, end, accept)) return;
    begin = end;
  }
}

/// Approximate common divisor of the gaps, ascending: the smallest one, refined by every further
/// gap that is a multiple of it; 0 if one is not.
double common_step(const std::vector<double>& heights) {
  std::vector<double> gaps;
  gaps.reserve(heights.size());
  for (std::size_t i = 1; i < heights.size(); ++i) gaps.push_back(heights[i] - heights[i - 1]);
  double total = 0;
  double count = 0;
  ascending(gaps, [&](double gap) {
    const double steps = count > 0 ? std::round(gap * count / total) : 1;
    const bool fits = !(count > 0 && std::abs(gap * count / total - steps) > kIntegerTolerance);
    total += gap;
    count = fits ? count + steps : 0;
    return fits;
  });
  return count > 0 ? total / count : 0;
}

bool all_on_steps(const Field& height, double first, double step) {
  const double off = parallel_max(height.size(), [&](Index begin, Index end) {
    double worst = 0;
    for (Index i = begin; i < end; ++i) {
      const double steps = (height.data()[i] - first) / step;
      if (std::isfinite(steps)) worst = std::max(worst, std::abs(steps - std::round(steps)));
    }
    return worst;
  });
  return off <= kIntegerTolerance;
}

/// Heights above a plane, computed where they are needed: a levelled copy of a large map would take
/// as much memory as the map.
struct Levelled {
  const Field& height;
  double at_origin = 0;  ///< [m]
  double per_column = 0;
  double per_row = 0;

  double operator()(Index y, Index x) const {
    return height(y, x) - at_origin - per_row * static_cast<double>(y) -
           per_column * static_cast<double>(x);
  }
};

/// Number of valid points and the sum of term(height above the plane) over them.
template <typename Term>
Eigen::Array2d total(const Levelled& levelled, const Term& term) {
  const Field& height = levelled.height;
  return sum_over_rows<2>(height.rows(), [&](Index y) {
    double n = 0;
    double sum_of_row = 0;
    for (Index x = 0; x < height.cols(); ++x) {
      const double z = levelled(y, x);
      if (!std::isfinite(z)) continue;
      ++n;
      sum_of_row += term(z);
    }
    return Eigen::Array2d(n, sum_of_row);
  });
}

double mean_square(const Levelled& levelled) {
  const Eigen::Array2d first = total(levelled, [](double z) { return z; });
  if (first[0] == 0) return 0;
  const double mean = first[1] / first[0];
  return total(levelled, [mean](double z) { return (z - mean) * (z - mean); })[1] / first[0];
}

void warn_of_pixels(const Grid& grid, Warnings& list) {
  constexpr double kSquare = 1e-3;
  if (std::abs(grid.dx() / grid.dy() - 1) > kSquare) {
    list.push_back({.code = "pixels-not-square",
                    .text = fmt::format("Pixels are not square ({} x {})",
                                        format_si(grid.dx(), "m"), format_si(grid.dy(), "m"))});
  }
}

void warn_of_rows(const Topography& topography, Warnings& list) {
  constexpr Index kHeightsOfRow = 1024;
  const RowJumps found = row_jumps(topography.height, kHeightsOfRow);
  if (!found.are_offsets()) return;
  list.push_back(
      {.code = "row-jumps",
       .text = fmt::format("Rows jump by {} from one to the next, compared with {} within rows; "
                           "<level=rows> removes the offsets",
                           format_si(found.size, "m", 3), format_si(found.within_rows, "m", 3))});
}

void warn_of_holes(const Topography& topography, Warnings& list) {
  const Index n_holes = count_holes(topography);
  if (n_holes == 0) return;
  if (n_holes == topography.grid.size()) {
    list.push_back({.code = "missing-pixels", .text = "All pixels are missing"});
    return;
  }
  list.push_back(
      {.code = "missing-pixels",
       .text = fmt::format(
           "{} of {} pixels {} missing ({}); <fill=harmonic> fills the holes", n_holes,
           topography.grid.size(), n_holes == 1 ? "is" : "are",
           percent(static_cast<double>(n_holes) / static_cast<double>(topography.grid.size()),
                   2))});
}

void warn_of_quantum(double quantum, double rms, Warnings& list) {
  constexpr double kCoarse = 0.02;
  constexpr double kPlane = 1e-6;  // heights on a plane but for rounding
  if (quantum > kCoarse * rms && rms > kPlane * quantum) {
    list.push_back({.code = "height-steps",
                    .text = fmt::format(
                        "Heights come in steps of {}, which is {:.2g} of their rms about a plane",
                        format_si(quantum, "m"), quantum / rms)});
  }
}

void warn_of_spikes(const Field& height, Warnings& list) {
  const Index spikes = count_spikes(height);
  if (spikes == 0) return;
  list.push_back({.code = "spikes",
                  .text = fmt::format(
                      "The surface has {} ({} of pixels), which {} slopes and contact; "
                      "<despike=auto> removes {}",
                      spikes == 1 ? "1 spike" : fmt::format("{} spikes", spikes),
                      percent(static_cast<double>(spikes) / static_cast<double>(height.size()), 2),
                      spikes == 1 ? "changes" : "change", spikes == 1 ? "it" : "them")});
}

/// Heights above their least-squares plane; as they are if they do not determine one. The plane of
/// large maps is fitted to some of their rows and columns: it decides about warnings only.
Levelled above_plane(const Field& height) {
  constexpr Index kSide = 1024;
  const Index kx = 1 + height.cols() / kSide;
  const Index ky = 1 + height.rows() / kSide;
  const Field sample = height(Eigen::seq(0, Eigen::last, ky), Eigen::seq(0, Eigen::last, kx));
  Levelled levelled{.height = height};
  const auto fit = try_fit_form(sample, 1);
  if (!fit) return levelled;  // heights on one line: there is nothing to level
  // The fit's axes run from -1 to 1 over the pixels' edges.
  const double du = 2 / static_cast<double>(sample.cols());
  const double dv = 2 / static_cast<double>(sample.rows());
  const double mean = fit->coefficients[0];
  const double along_x = fit->coefficients[1];
  const double along_y = fit->coefficients[2];
  levelled.at_origin = mean + along_x * (du / 2 - 1) + along_y * (dv / 2 - 1);
  levelled.per_column = along_x * du / static_cast<double>(kx);
  levelled.per_row = along_y * dv / static_cast<double>(ky);
  return levelled;
}

/// Root mean square of the heights [m] about their mean and about their plane.
struct Rms {
  double as_is = 0;
  double levelled = 0;
};

/// What rounding alone can have left counts as zero.
Rms rms_of(const Field& height) {
  const double rounding = numerics::rounding_of(numerics::largest_magnitude(height));
  const auto rms = [rounding](const Levelled& levelled) {
    const double root = std::sqrt(mean_square(levelled));
    return root > rounding ? root : 0;
  };
  return {.as_is = rms({.height = height}), .levelled = rms(above_plane(height))};
}

/// Codes of about_heights(), of which a treatment may dispel or raise every one.
constexpr std::string_view kOfHeights[] = {"profile", "pixels-not-square", "row-jumps",
                                           "missing-pixels", "tilt"};

bool is_of_heights(const Warning& warning) {
  return std::find(std::begin(kOfHeights), std::end(kOfHeights), warning.code) !=
         std::end(kOfHeights);
}

/// Warnings about the heights as they are.
Warnings about_heights(const Topography& topography, const Rms& rms) {
  Warnings list;
  if (is_profile(topography.grid)) {
    list.push_back({.code = "profile",
                    .text = fmt::format("The scan is a profile of one {}, so areal results do not "
                                        "apply",
                                        topography.grid.ny == 1 ? "row" : "column")});
  } else {
    warn_of_pixels(topography.grid, list);
    warn_of_rows(topography, list);
  }
  warn_of_holes(topography, list);
  if (rms.as_is > 2 * rms.levelled && rms.levelled > 0) {
    list.push_back(
        {.code = "tilt",
         .text = fmt::format(
             "The tilt is larger than the roughness (Sq {}, {} without its plane); <level=plane> "
             "removes it",
             format_si(rms.as_is, "m"), format_si(rms.levelled, "m"))});
  }
  return list;
}

}  // namespace

double height_quantum(const Field& height) {
  for (Index stride = std::max<Index>(1, height.size() / kSample); stride >= 1; stride /= 2) {
    const std::vector<double> heights = distinct_heights(height, stride);
    if (heights.size() < 3) {  // two levels are always one step apart
      if (stride == 1) return 0;
      continue;
    }
    const double step = common_step(heights);
    if (step < kFinestShare * (heights.back() - heights.front())) return 0;
    if (all_on_steps(height, heights.front(), step)) return step;
  }
  return 0;
}

Warnings warnings(const Topography& topography) {
  const Rms rms = rms_of(topography.height);
  Warnings list = about_heights(topography, rms);
  warn_of_quantum(height_quantum(topography.height), rms.levelled, list);
  warn_of_spikes(topography.height, list);
  return list;
}

void look_at(Topography& topography) {
  look_at_edges(topography);
  for (Warning& warning : warnings(topography)) topography.warnings.push_back(std::move(warning));
}

void renew_spikes(Topography& topography) {
  const auto hides = [](const std::string& step) {
    return step.starts_with("lowpass=") || step.starts_with("highpass=") ||
           step.starts_with("resample=");
  };
  const std::vector<std::string>& history = topography.history;
  if (std::any_of(history.begin(), history.end(), hides)) return;
  const auto is_spikes = [](const Warning& warning) { return warning.code == "spikes"; };
  if (std::erase_if(topography.warnings, is_spikes) > 0) {
    warn_of_spikes(topography.height, topography.warnings);
  }
}

void renew_warnings(Topography& topography) {
  look_at_edges(topography);
  std::erase_if(topography.warnings, is_of_heights);
  const std::optional<Topography> scan = scan_of_images(topography);
  const Topography& measured = scan ? *scan : topography;  // images hide its tilt and rows
  for (Warning& warning : about_heights(measured, rms_of(measured.height))) {
    topography.warnings.push_back(std::move(warning));
  }
}

}  // namespace tabor::topography
