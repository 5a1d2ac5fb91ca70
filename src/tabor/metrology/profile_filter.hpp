#pragma once

#include <Eigen/Core>

#include "tabor/metrology/profile.hpp"

namespace tabor::metrology {

/// One row or column of the map, a copy. [m], NaN = hole
Eigen::ArrayXd profile_of(const Field& height, ProfileAxis axis, Index number);

/// The profile minus the least-squares polynomial of its valid points; all NaN if they do not
/// determine it. Degree -1 leaves it alone.
Eigen::ArrayXd without_form(const Eigen::ArrayXd& z, int degree);

/// Longer cut-offs than so many profile lengths pass the mean of the profile like this one, within
/// 1e-3 of its height, but would need weights without end.
inline constexpr double kLongestCutoff = 100;

/// Gaussian low-pass of ISO 16610-21, weights renormalised at the ends and over holes; cutoff [m]
/// at most kLongestCutoff profile lengths.
Eigen::ArrayXd low_pass_profile(const Eigen::ArrayXd& z, double spacing, double cutoff,
                                bool periodic);

/// Form removal, S-filter and L-filter as the options and the setting say; the whole length.
Eigen::ArrayXd filtered_profile(const Eigen::ArrayXd& z, double spacing, bool periodic,
                                const ProfileOptions& options, const ProfileSetting& setting);

}  // namespace tabor::metrology
