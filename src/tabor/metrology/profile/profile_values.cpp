#include "tabor/metrology/profile/profile_values.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tabor/metrology/areal/abbott.hpp"
#include "tabor/metrology/profile/profile_elements.hpp"
#include "tabor/numerics/field_statistics.hpp"

namespace tabor::metrology {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kLeastHeight = 0.1;    ///< of a hill or dale, share of a height
constexpr double kLeastSpacing = 0.01;  ///< share of the section, ISO 4287
constexpr double kLeastValid = 0.5;     ///< share of a section's points

/// Moments of the valid points of a section or of the whole evaluation length.
struct Moments {
  double mean_abs = kNan, rms = kNan, skewness = kNan, kurtosis = kNan;
  double highest = kNan, lowest = kNan;
};

bool is_usable(const Eigen::ArrayXd& z) {
  const Index n_valid = z.size() - z.isNaN().count();
  return n_valid > 0 && static_cast<double>(n_valid) >= kLeastValid * static_cast<double>(z.size());
}

Moments moments_of(const Eigen::ArrayXd& z) {
  Moments m;
  if (!is_usable(z)) return m;
  double n = 0, first = 0, second = 0, third = 0, fourth = 0;
  for (const double height : z) {
    if (std::isnan(height)) continue;
    const double square = height * height;
    n += 1;
    first += std::abs(height);
    second += square;
    third += square * height;
    fourth += square * square;
  }
  m.mean_abs = first / n;
  m.rms = std::sqrt(second / n);
  m.skewness = third / n / (m.rms * m.rms * m.rms);
  m.kurtosis = fourth / n / (m.rms * m.rms * m.rms * m.rms);
  m.highest = z.maxCoeff<Eigen::PropagateNumbers>();
  m.lowest = z.minCoeff<Eigen::PropagateNumbers>();
  return m;
}

std::vector<Eigen::ArrayXd> parts_of(const Eigen::ArrayXd& z, int n_sections) {
  std::vector<Eigen::ArrayXd> parts;
  for (const Section& section : sections_of(z.size(), n_sections)) {
    parts.emplace_back(z.segment(section.begin, section.end - section.begin));
  }
  return parts;
}

/// Mean of what exists.
template <typename Items, typename Of>
double mean_of(const Items& items, const Of& of) {
  double sum = 0, n = 0;
  for (const auto& item : items) {
    const double value = of(item);
    if (!std::isnan(value)) {
      sum += value;
      n += 1;
    }
  }
  return n > 0 ? sum / n : kNan;
}

struct Elements {
  double spacing = kNan, height = kNan;
};

Elements means_of(const std::vector<ProfileElement>& elements, double spacing) {
  return {mean_of(elements, [&](const ProfileElement& e) { return e.spacing * spacing; }),
          mean_of(elements, [](const ProfileElement& e) { return e.height; })};
}

/// Read from both ends, so that a profile has no direction.
Elements elements_both_ways(const Eigen::ArrayXd& z, double spacing, const Discrimination& least) {
  auto elements = profile_elements(z, least);
  const auto backwards = profile_elements(z.reverse(), least);
  elements.insert(elements.end(), backwards.begin(), backwards.end());
  return means_of(elements, spacing);
}

/// ISO 21920-2: over the evaluation length.
Elements elements_of_whole(const Eigen::ArrayXd& z, double spacing, const Moments& whole) {
  return elements_both_ways(z, spacing,
                            {kLeastHeight * whole.highest, -kLeastHeight * whole.lowest, 0});
}

/// ISO 4287: in every section, then the mean of the sections.
Elements elements_by_section(const std::vector<Eigen::ArrayXd>& sections, double spacing,
                             double mean_range) {
  std::vector<Elements> found;
  for (const Eigen::ArrayXd& z : sections) {
    const double least = kLeastHeight * mean_range;
    const double length = kLeastSpacing * static_cast<double>(z.size());
    found.push_back(elements_both_ways(z, spacing, {least, least, length}));
  }
  return {mean_of(found, [](const Elements& e) { return e.spacing; }),
          mean_of(found, [](const Elements& e) { return e.height; })};
}

/// k, pk, vk, mrk1, mrk2 and mr(c).
std::array<double, 6> material_ratios(const Eigen::ArrayXd& z, double ratio_height) {
  const AbbottCurve curve(Eigen::Map<const Field>(z.data(), 1, z.size()));
  const Core core = curve.core();
  const double mean = mean_of(z, [](double height) { return height; });
  return {core.height,     core.peak_height, core.dale_height,
          core.peak_ratio, core.dale_ratio,  curve.ratio_above(ratio_height - mean)};
}

}  // namespace

const std::array<ProfileQuantity, kProfileQuantities> kProfileTable{{
    {"a", "", "m", "<|z|> over the evaluation length", "mean over the sections of <|z|>"},
    {"q", "", "m", "sqrt(<z^2>) over the evaluation length",
     "mean over the sections of sqrt(<z^2>)"},
    {"sk", "", "1", "<z^3>/<z^2>^(3/2) over the evaluation length",
     "mean over the sections of <z^3>/<z^2>^(3/2)"},
    {"ku", "", "1", "<z^4>/<z^2>^2 over the evaluation length",
     "mean over the sections of <z^4>/<z^2>^2"},
    {"p", "", "m", "mean over the sections of the highest z", ""},
    {"v", "", "m", "mean over the sections of the depth of the lowest z", ""},
    {"z", "", "m", "mean over the sections of max z - min z", ""},
    {"zx", "z1max", "m", "largest max z - min z of a section", ""},
    {"t", "", "m", "max z - min z over the evaluation length", ""},
    {"dq", "", "1", "root mean square slope over the evaluation length", ""},
    {"Sm", "", "m",
     "mean spacing of profile elements over the evaluation length, read from both ends; hills and "
     "dales below 10 % of the highest peak or of the deepest pit do not count",
     "mean over the sections of the mean spacing of profile elements, read from both ends; hills "
     "and dales below 10 % of the mean range of the sections or shorter than 1 % of the section do "
     "not count"},
    {"c", "", "m", "mean height of the profile elements whose spacing is averaged above", ""},
    {"pd", "", "1/m", "profile elements per length: one over their mean spacing", ""},
    {"k", "", "m",
     "core height of the Abbott curve of the evaluation length, without the second filter of "
     "ISO 13565-1",
     ""},
    {"pk", "", "m", "reduced peak height 2 A1/mrk1", "reduced peak height 2 A1/Mr1"},
    {"vk", "", "m", "reduced dale height 2 A2/(100 - mrk2)",
     "reduced dale height 2 A2/(100 - Mr2)"},
    {"mrk1", "Mr1", "%", "material ratio above the core", ""},
    {"mrk2", "Mr2", "%", "material ratio above the dales", ""},
    {"mr(c)", "", "%", "share of the evaluation length above c", ""},
}};

std::vector<Section> sections_of(Index size, int n) {
  std::vector<Section> sections;
  for (Index k = 0; k < n; ++k) {
    const Index from_end = (n - 1 - k) * size / n;
    sections.push_back({k * size / n, size - from_end});
  }
  return sections;
}

ProfileValues profile_values(const Eigen::ArrayXd& z, double spacing, int sections,
                             const ProfileOptions& options) {
  ProfileValues values;
  values.fill(kNan);
  if (!is_usable(z)) return values;
  const bool by_section = options.standard == ProfileStandard::iso4287;
  const Moments whole = moments_of(z);
  const auto parts = parts_of(z, sections);
  std::vector<Moments> of_parts;
  of_parts.reserve(parts.size());
  for (const Eigen::ArrayXd& part : parts) of_parts.push_back(moments_of(part));
  const auto over = [&](double Moments::*value) {
    return by_section ? mean_of(of_parts, [&](const Moments& m) { return m.*value; })
                      : whole.*value;
  };
  const auto range = [](const Moments& m) { return m.highest - m.lowest; };
  const double mean_range = mean_of(of_parts, range);
  double largest_range = kNan;
  for (const Moments& m : of_parts) largest_range = std::fmax(largest_range, range(m));
  const Elements elements = by_section ? elements_by_section(parts, spacing, mean_range)
                                       : elements_of_whole(z, spacing, whole);
  const double slope = options.forward_slopes ? numerics::rms_slope(z, spacing)
                                              : numerics::seven_point_rms_slope(z, spacing);
  const auto ratios = material_ratios(z, options.ratio_height.value_or(0));
  return {over(&Moments::mean_abs),
          over(&Moments::rms),
          over(&Moments::skewness),
          over(&Moments::kurtosis),
          mean_of(of_parts, [](const Moments& m) { return m.highest; }),
          mean_of(of_parts, [](const Moments& m) { return -m.lowest; }),
          mean_range,
          largest_range,
          range(whole),
          slope,
          elements.spacing,
          elements.height,
          1 / elements.spacing,
          ratios[0],
          ratios[1],
          ratios[2],
          ratios[3],
          ratios[4],
          ratios[5]};
}

}  // namespace tabor::metrology
