#include "tabor/metrology/profile/profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tabor/core/error.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/core/units.hpp"
#include "tabor/core/watch.hpp"
#include "tabor/metrology/profile/profile_filter.hpp"
#include "tabor/metrology/profile/profile_values.hpp"

namespace tabor::metrology {
namespace {

constexpr Index kProfilesPerReport = 256;

/// The middle of the profile, where the sections lie: farthest from the ends, equally far from
/// both.
struct Evaluation {
  Index begin = 0;
  Index size = 0;
};

Evaluation evaluation_of(Index n, double spacing, const ProfileOptions& options,
                         const ProfileSetting& setting) {
  const Index trim = std::llround(setting.trim / spacing);
  const Index available = n - 2 * trim;
  Index left_out = 0;  // at either end
  if (options.kind == ProfileKind::roughness) {
    const double wanted = setting.sections * setting.cutoff / spacing;
    left_out = std::max<Index>(0, std::llround((static_cast<double>(available) - wanted) / 2));
  }
  return {trim + left_out, available - 2 * left_out};
}

/// One row of values per profile.
Field values_of_all(const topography::Topography& topography, ProfileAxis axis,
                    const ProfileOptions& options, const ProfileSetting& setting,
                    const Observer& observer) {
  const bool along_x = axis == ProfileAxis::x;
  const Index n_profiles = along_x ? topography.grid.ny : topography.grid.nx;
  const double spacing = along_x ? topography.grid.dx() : topography.grid.dy();
  const auto evaluation =
      evaluation_of(along_x ? topography.grid.nx : topography.grid.ny, spacing, options, setting);
  Field values(n_profiles, static_cast<Index>(kProfileQuantities));
  Watch watch(observer, along_x ? "profiles along x" : "profiles along y");
  for (Index first = 0; first < n_profiles; first += kProfilesPerReport) {
    if (first > 0) watch.tell(static_cast<double>(first) / static_cast<double>(n_profiles));
    for_each_row(std::min(kProfilesPerReport, n_profiles - first), [&](Index i) {
      const auto z = filtered_profile(profile_of(topography.height, axis, first + i), spacing,
                                      topography.periodic, options, setting);
      const auto found = profile_values(z.segment(evaluation.begin, evaluation.size), spacing,
                                        setting.sections, options);
      std::copy(found.begin(), found.end(), &values(first + i, 0));
    });
  }
  return values;
}

/// Mean and scatter of what exists, over the profiles.
struct Statistics {
  double mean = std::numeric_limits<double>::quiet_NaN();
  double deviation = std::numeric_limits<double>::quiet_NaN();
  Index n = 0;
};

Statistics statistics_of(const Eigen::ArrayXd& values) {
  Statistics s;
  double sum = 0, squares = 0;
  for (const double value : values) {
    if (std::isfinite(value)) {
      sum += value;
      ++s.n;
    }
  }
  if (s.n == 0) return s;
  s.mean = sum / static_cast<double>(s.n);
  for (const double value : values) {
    if (std::isfinite(value)) squares += (value - s.mean) * (value - s.mean);
  }
  if (s.n > 1) s.deviation = std::sqrt(squares / static_cast<double>(s.n - 1));
  return s;
}

char letter_of(ProfileKind kind) {
  return kind == ProfileKind::roughness ? 'R' : kind == ProfileKind::primary ? 'P' : 'W';
}

std::string scatter_text(const Statistics& s, std::string_view unit, Index n_profiles) {
  if (s.n == 0) return n_profiles == 1 ? "not in this profile" : "in none of the profiles";
  if (n_profiles == 1) return "a single profile";
  const std::string scatter = unit == "m"   ? format_si(s.deviation, "m", 3)
                              : unit == "1" ? fmt::format("{:.3g}", s.deviation)
                              : unit == "1/m"
                                  ? fmt::format("{:.3g} % of the mean", 100 * s.deviation / s.mean)
                                  : fmt::format("{:.3g} {}", s.deviation, unit);
  return fmt::format("standard deviation {} over {} of {} profiles", scatter, s.n, n_profiles);
}

Parameter parameter(std::string symbol, double value, std::string_view unit, std::string definition,
                    std::string note) {
  Parameter result;
  result.symbol = std::move(symbol);
  result.value = value;
  result.unit = unit;
  result.definition = std::move(definition);
  result.note = std::move(note);
  result.set = ParameterSet::profile;
  return result;
}

std::string kind_text(const ProfileOptions& options, const ProfileSetting& setting) {
  if (options.filtered) return "profile as given";
  const std::string s = setting.short_cutoff > 0
                            ? fmt::format("ls {}", format_si(setting.short_cutoff, "m", 3))
                            : std::string("no S-filter");
  const std::string lc = fmt::format("lc {}", format_si(setting.cutoff, "m", 3));
  switch (options.kind) {
    case ProfileKind::primary:
      return "primary profile, " + s;
    case ProfileKind::waviness:
      return "waviness profile, Gaussian " + s + ", " + lc;
    case ProfileKind::roughness:
      break;
  }
  return "roughness profile, Gaussian " + s + ", " + lc;
}

/// What was chosen, as parameters of its own.
void add_setting(std::vector<Parameter>& list, const std::string& axis,
                 const ProfileSetting& setting) {
  list.push_back(parameter("lc_" + axis, setting.cutoff, "m",
                           "cut-off between roughness and waviness, length of a section",
                           setting.reason));
  list.push_back(parameter("ls_" + axis, setting.short_cutoff, "m",
                           "cut-off of the S-filter, 0 without one", ""));
  list.push_back(parameter("sections_" + axis, setting.sections, "1",
                           "sections (sampling lengths) in the middle of each profile", ""));
}

}  // namespace

std::vector<Parameter> profile_parameters(const topography::Topography& topography,
                                          ProfileAxis axis, const ProfileOptions& options,
                                          const Observer& observer) {
  const auto setting = choose_setting(topography, axis, options);
  const Field values = values_of_all(topography, axis, options, setting, observer);
  const std::string name = axis == ProfileAxis::x ? "x" : "y";
  const bool old = options.standard == ProfileStandard::iso4287;
  const std::string means =
      fmt::format("; mean of the profiles along {}, {}, {}", name, old ? "ISO 4287" : "ISO 21920-2",
                  kind_text(options, setting));
  std::vector<Parameter> list;
  add_setting(list, name, setting);
  for (std::size_t k = 0; k < kProfileQuantities; ++k) {
    const ProfileQuantity& quantity = kProfileTable[k];
    const auto statistics = statistics_of(values.col(static_cast<Index>(k)));
    const auto choose = [&](std::string_view now, std::string_view before) {
      return std::string(old && !before.empty() ? before : now);
    };
    std::string symbol = choose(quantity.name, quantity.name_iso4287);
    if (!symbol.starts_with('M')) symbol.insert(symbol.begin(), letter_of(options.kind));
    std::string definition = choose(quantity.definition, quantity.definition_iso4287);
    if (quantity.name == "dq") {
      definition += options.forward_slopes ? ", forward differences" : ", 7-point stencil";
    } else if (quantity.name == "mr(c)") {
      definition +=
          fmt::format(" = {} from the mean line", format_si(options.ratio_height.value_or(0), "m"));
    }
    list.push_back(parameter(fmt::format("{}_{}", symbol, name), statistics.mean, quantity.unit,
                             definition.append(means),
                             scatter_text(statistics, quantity.unit, values.rows())));
  }
  return list;
}

std::vector<Parameter> profile_parameters(const topography::Topography& topography,
                                          const ProfileOptions& options, const Observer& observer) {
  std::vector<Parameter> list;
  const auto append = [&](ProfileAxis axis) {
    auto found = profile_parameters(topography, axis, options, observer);
    std::move(found.begin(), found.end(), std::back_inserter(list));
  };
  if (topography.grid.nx > 1 || topography.grid.ny == 1) append(ProfileAxis::x);
  if (topography.grid.ny > 1) append(ProfileAxis::y);
  return list;
}

}  // namespace tabor::metrology
