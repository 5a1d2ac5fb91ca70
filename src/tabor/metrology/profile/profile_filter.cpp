#include "tabor/metrology/profile/profile_filter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tabor/numerics/field_statistics.hpp"
#include "tabor/numerics/small_matrices.hpp"
#include "tabor/topography/filters.hpp"

namespace tabor::metrology {
namespace {

/// Chebyshev polynomials of degree 0 to `degree` over the profile, at its valid points.
Eigen::MatrixXd basis(Index n, int degree) {
  Eigen::MatrixXd powers = Eigen::MatrixXd::Ones(n, degree + 1);
  const Eigen::VectorXd u = Eigen::VectorXd::LinSpaced(n, -1, 1);
  if (degree >= 1) powers.col(1) = u;
  for (int k = 2; k <= degree; ++k) {
    powers.col(k) = 2 * u.cwiseProduct(powers.col(k - 1)) - powers.col(k - 2);
  }
  return powers;
}

}  // namespace

Eigen::ArrayXd profile_of(const Field& height, ProfileAxis axis, Index number) {
  if (axis == ProfileAxis::x) return height.row(number).transpose();
  return height.col(number);
}

Eigen::ArrayXd without_form(const Eigen::ArrayXd& z, int degree) {
  if (degree < 0) return z;
  const Eigen::MatrixXd all = basis(z.size(), degree);
  Eigen::MatrixXd valid(all.rows(), all.cols());
  Eigen::VectorXd heights(z.size());
  Index n_valid = 0;
  for (Index i = 0; i < z.size(); ++i) {
    if (std::isnan(z[i])) continue;
    valid.row(n_valid) = all.row(i);
    heights[n_valid++] = z[i];
  }
  if (n_valid <= degree) {
    return Eigen::ArrayXd::Constant(z.size(), std::numeric_limits<double>::quiet_NaN());
  }
  const Eigen::VectorXd form =
      numerics::least_squares(valid.topRows(n_valid), heights.head(n_valid));
  return z - (all * form).array();
}

Eigen::ArrayXd low_pass_profile(const Eigen::ArrayXd& z, double spacing, double cutoff,
                                bool periodic) {
  const double length = spacing * static_cast<double>(z.size());
  cutoff = std::min(cutoff, kLongestCutoff * length);
  // A map of one row, so wide that the filter across it does nothing.
  const Grid row{z.size(), 1, length, 10 * cutoff};
  const Field height = Eigen::Map<const Field>(z.data(), 1, z.size());
  return topography::low_pass(height, row,
                              {.kind = topography::FilterKind::gauss, .wavelength = cutoff}, 0,
                              periodic)
      .row(0)
      .transpose();
}

namespace {

/// Form, S-filter and L-filter, one after the other.
Eigen::ArrayXd filtered(const Eigen::ArrayXd& z, double spacing, bool periodic,
                        const ProfileOptions& options, const ProfileSetting& setting) {
  Eigen::ArrayXd profile = without_form(z, options.form_degree);
  if (profile.isNaN().all()) return profile;
  if (setting.short_cutoff > 0) {
    profile = low_pass_profile(profile, spacing, setting.short_cutoff, periodic);
  }
  if (options.kind == ProfileKind::primary) return profile;
  const Eigen::ArrayXd waviness = low_pass_profile(profile, spacing, setting.cutoff, periodic);
  return options.kind == ProfileKind::waviness ? waviness : profile - waviness;
}

}  // namespace

Eigen::ArrayXd filtered_profile(const Eigen::ArrayXd& z, double spacing, bool periodic,
                                const ProfileOptions& options, const ProfileSetting& setting) {
  if (options.filtered) return z;
  const Eigen::ArrayXd profile = filtered(z, spacing, periodic, options, setting);
  const auto as_field = [](const Eigen::ArrayXd& heights) -> Field { return heights.transpose(); };
  return numerics::without_rounding(as_field(profile), numerics::largest_magnitude(as_field(z)))
      .row(0)
      .transpose();
}

}  // namespace tabor::metrology
