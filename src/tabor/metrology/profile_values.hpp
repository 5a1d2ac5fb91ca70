#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>
#include <vector>

#include "tabor/metrology/profile.hpp"

namespace tabor::metrology {

/// What a profile parameter is called after its letter R, P or W, and what it is.
struct ProfileQuantity {
  std::string_view name;          ///< "q"; the symbol is "Rq"
  std::string_view name_iso4287;  ///< "" if the same
  std::string_view unit;
  std::string_view definition;          ///< ISO 21920-2
  std::string_view definition_iso4287;  ///< "" if the same
};

inline constexpr std::size_t kProfileQuantities = 19;
extern const std::array<ProfileQuantity, kProfileQuantities> kProfileTable;

/// In the order of kProfileTable; NaN where the profile has no such value.
using ProfileValues = std::array<double, kProfileQuantities>;

/// The values of one filtered profile: heights z [m] about the mean line z = 0 over the evaluation
/// length, NaN for holes, `spacing` [m] apart, divided into `sections` equal lengths.
ProfileValues profile_values(const Eigen::ArrayXd& z, double spacing, int sections,
                             const ProfileOptions& options);

}  // namespace tabor::metrology
