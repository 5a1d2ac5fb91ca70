// Cut-offs and sampling lengths of profile parameters.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tabor/core/error.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/core/units.hpp"
#include "tabor/metrology/profile/profile.hpp"
#include "tabor/metrology/profile/profile_filter.hpp"
#include "tabor/metrology/profile/profile_values.hpp"

namespace tabor::metrology {
namespace {

constexpr int kDefaultSections = 5;  ///< ISO 21920-3
constexpr double kTolerance = 0.01;  ///< by which the last section may be short

/// Setting classes Sc1 to Sc5 of ISO 21920-3 and the largest Rz for which each is recommended. [m]
struct SettingClass {
  double largest_rz, cutoff, short_cutoff;
};
constexpr std::array<SettingClass, 5> kClasses{{{0.16e-6, 0.08e-3, 2.5e-6},
                                                {0.8e-6, 0.25e-3, 2.5e-6},
                                                {16e-6, 0.8e-3, 2.5e-6},
                                                {80e-6, 2.5e-3, 8e-6},
                                                {HUGE_VAL, 8e-3, 25e-6}}};
constexpr double kShortestRatio = 30;  ///< lc/ls of the smallest class, ISO 3274

void check(const ProfileOptions& options, double spacing) {
  const auto reject = [](const char* what, const std::string& got, const std::string& expected) {
    throw InputError(fmt::format("profile {}", what), got, expected, "");
  };
  if (options.cutoff && !(*options.cutoff >= 2 * spacing && std::isfinite(*options.cutoff))) {
    reject("cut-off lc", format_si(*options.cutoff, "m"),
           fmt::format("at least two pixels ({} along this axis)", format_si(2 * spacing, "m")));
  }
  if (options.short_cutoff &&
      !(*options.short_cutoff >= 0 && std::isfinite(*options.short_cutoff))) {
    reject("short cut-off ls", format_si(*options.short_cutoff, "m"), "a length, or 0 for none");
  }
  if (options.cutoff && options.short_cutoff && !(*options.short_cutoff < *options.cutoff)) {
    reject("short cut-off ls", format_si(*options.short_cutoff, "m"),
           fmt::format("less than lc = {}", format_si(*options.cutoff, "m")));
  }
  if (options.sections && *options.sections < 0) {
    reject("sections", fmt::format("{}", *options.sections), "a number, or 0 for as many as fit");
  }
  if (options.ratio_height && !std::isfinite(*options.ratio_height)) {
    reject("height c of Rmr(c)", format_si(*options.ratio_height, "m"), "a height");
  }
  if (options.form_degree < -1 || options.form_degree > 4) {
    reject("form", fmt::format("degree {}", options.form_degree), "a degree from -1 (none) to 4");
  }
}

/// Mean range of the fifths of the profiles after form removal: an estimate of Rz.
double estimate_rz(const topography::Topography& topography, ProfileAxis axis,
                   const ProfileOptions& options) {
  const Field& z = topography.height;
  const auto sums = sum_over_rows<2>(axis == ProfileAxis::x ? z.rows() : z.cols(), [&](Index i) {
    const Eigen::ArrayXd profile =
        without_form(profile_of(z, axis, i), options.filtered ? -1 : options.form_degree);
    Eigen::Array2d sum = Eigen::Array2d::Zero();
    for (const Section& section : sections_of(profile.size(), kDefaultSections)) {
      const auto part = profile.segment(section.begin, section.end - section.begin);
      if (part.size() > 0 && !part.isNaN().all()) {
        sum += Eigen::Array2d(
            part.maxCoeff<Eigen::PropagateNumbers>() - part.minCoeff<Eigen::PropagateNumbers>(), 1);
      }
    }
    return sum;
  });
  return sums[1] > 0 ? sums[0] / sums[1] : 0;
}

/// What the default cut-off goes by. Both axes share it, so that their numbers compare: the larger
/// Rz and the shorter side; a side less than a quarter of the other stands for itself.
struct Basis {
  double rz = 0;      ///< [m]
  double length = 0;  ///< [m]
};

Basis basis_of(const topography::Topography& topography, ProfileAxis axis,
               const ProfileOptions& options) {
  const Grid& grid = topography.grid;
  const double shorter = std::min(grid.lx, grid.ly), longer = std::max(grid.lx, grid.ly);
  const auto rz = [&](ProfileAxis along) { return estimate_rz(topography, along, options); };
  if (4 * shorter < longer) return {rz(axis), axis == ProfileAxis::x ? grid.lx : grid.ly};
  return {std::max(rz(ProfileAxis::x), rz(ProfileAxis::y)), shorter};
}

std::string length(double metres) { return format_si(metres, "m", 3); }

/// The class of the roughness, or one nearby that fits five times and has ten pixels.
void choose_cutoff(ProfileSetting& setting, double rz, double profile_length, double spacing) {
  constexpr double kFewestPixels = 10;
  std::size_t wanted = 0;
  while (rz > kClasses[wanted].largest_rz) ++wanted;
  const auto fits = [&](std::size_t k) {
    return kDefaultSections * kClasses[k].cutoff <= profile_length * (1 + kTolerance);
  };
  std::size_t taken = wanted;
  while (taken > 0 && !fits(taken)) --taken;
  setting.reason = fmt::format("lc = {} for {} (ISO 21920-3)", length(kClasses[wanted].cutoff),
                               rz > 0 ? "Rz about " + length(rz) : "an unknown Rz");
  const auto is_too_short = [&](std::size_t k) {
    return kClasses[k].cutoff < kFewestPixels * spacing;
  };
  if (is_too_short(taken)) {
    while (taken + 1 < kClasses.size() && is_too_short(taken) && fits(taken + 1)) ++taken;
    setting.cutoff = is_too_short(taken) ? std::max(profile_length / kDefaultSections, 2 * spacing)
                                         : kClasses[taken].cutoff;
    setting.reason += fmt::format(
        " is below ten pixels or does not fit: {} taken; not comparable with other cut-offs",
        length(setting.cutoff));
    return;
  }
  setting.cutoff = fits(taken) ? kClasses[taken].cutoff : profile_length / kDefaultSections;
  if (setting.cutoff != kClasses[wanted].cutoff) {
    setting.reason += fmt::format(
        " does not fit {} times into {}: {} taken, {}; not comparable with other cut-offs",
        kDefaultSections, length(profile_length), length(setting.cutoff),
        fits(taken) ? "the largest standard cut-off that fits" : "a fifth of the profile");
  }
}

double default_short_cutoff(double cutoff) {
  if (cutoff < kClasses[0].cutoff) return cutoff / kShortestRatio;
  double found = 0;
  for (const SettingClass& known : kClasses) {
    if (cutoff >= known.cutoff) found = known.short_cutoff;
  }
  return found;
}

void choose_short_cutoff(ProfileSetting& setting, double spacing) {
  const double by_default = default_short_cutoff(setting.cutoff);
  setting.short_cutoff = by_default >= 2 * spacing ? by_default : 0;
  setting.reason += by_default >= 2 * spacing ? fmt::format("; ls = {}", length(by_default))
                                              : fmt::format(
                                                    "; no S-filter, the default ls = {} is below "
                                                    "two pixels",
                                                    length(by_default));
}

void choose_sections(ProfileSetting& setting, const ProfileOptions& options, double available) {
  if (options.kind != ProfileKind::roughness) {
    setting.sections = 1;
    return;
  }
  const int fitting =
      static_cast<int>(std::min(1e6, std::floor(available / setting.cutoff + kTolerance)));
  const int wanted = options.sections.value_or(kDefaultSections);
  setting.sections = std::max(1, wanted == 0 ? fitting : std::min(wanted, fitting));
  if (fitting < 1) {
    setting.reason += fmt::format("; the profile of {} is shorter than lc", length(available));
    if (setting.cutoff > kLongestCutoff * available) {
      setting.reason += fmt::format(", filtered with {:g} profile lengths", kLongestCutoff);
    }
  } else if (wanted > fitting) {
    setting.reason += fmt::format("; {} of {} sections fit", fitting, wanted);
  }
}

}  // namespace

ProfileSetting choose_setting(const topography::Topography& topography, ProfileAxis axis,
                              const ProfileOptions& options) {
  const bool along_x = axis == ProfileAxis::x;
  const Grid& grid = topography.grid;
  const double spacing = along_x ? grid.dx() : grid.dy();
  const double profile_length = along_x ? grid.lx : grid.ly;
  check(options, spacing);
  ProfileSetting setting;
  if (options.cutoff) {
    setting.cutoff = *options.cutoff;
    setting.reason = fmt::format("lc = {} as asked", length(setting.cutoff));
  } else {
    const Basis basis = basis_of(topography, axis, options);
    choose_cutoff(setting, basis.rz, basis.length, std::max(grid.dx(), grid.dy()));
  }
  if (options.filtered) {
    setting.reason += "; filtered before, no filter";
  } else if (options.short_cutoff) {
    setting.short_cutoff = *options.short_cutoff;
    setting.reason += setting.short_cutoff > 0
                          ? fmt::format("; ls = {} as asked", length(setting.short_cutoff))
                          : "; no S-filter, as asked";
  } else {
    choose_short_cutoff(setting, spacing);
  }
  const bool trimmed = options.ends == ProfileEnds::trim && !options.filtered &&
                       options.kind != ProfileKind::primary;
  setting.trim = trimmed && profile_length > 2 * setting.cutoff ? setting.cutoff / 2 : 0;
  if (trimmed && setting.trim == 0) setting.reason += "; too short to trim the ends";
  choose_sections(setting, options, profile_length - 2 * setting.trim);
  return setting;
}

}  // namespace tabor::metrology
