#pragma once

#include <Eigen/Core>

#include "tabor/metrology/profile/profile.hpp"

// Removes form from profiles and filters them (ISO 16610-21).
namespace tabor::metrology {

/// Returns a copy of one row or column of the map [m]; NaN is a hole.
Eigen::ArrayXd profile_of(const Field& height, ProfileAxis axis, Index number);

/// Returns the profile minus the least-squares polynomial of its valid points; all NaN if they do
/// not determine it. Degree -1 removes nothing.
Eigen::ArrayXd without_form(const Eigen::ArrayXd& z, int degree);

/// Longest cut-off in profile lengths. A longer one gives the same mean of the profile within 1e-3
/// of its height, but would need ever more weights.
inline constexpr double kLongestCutoff = 100;

/// Applies the Gaussian low-pass of ISO 16610-21, weights renormalised at the ends and over holes;
/// cutoff [m] at most kLongestCutoff profile lengths.
Eigen::ArrayXd low_pass_profile(const Eigen::ArrayXd& z, double spacing, double cutoff,
                                bool periodic);

/// Removes the form and applies S-filter and L-filter by options and setting, over the whole
/// length.
Eigen::ArrayXd filtered_profile(const Eigen::ArrayXd& z, double spacing, bool periodic,
                                const ProfileOptions& options, const ProfileSetting& setting);

}  // namespace tabor::metrology
