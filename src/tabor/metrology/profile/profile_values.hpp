#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>
#include <vector>

#include "tabor/metrology/profile/profile.hpp"

// Lists the profile parameters by name and computes them for one filtered profile.
namespace tabor::metrology {

/// Name of a profile parameter after its letter R, P or W, with unit and definition.
struct ProfileQuantity {
  std::string_view name;          ///< "q"; the symbol is "Rq"
  std::string_view name_iso4287;  ///< "" if the same
  std::string_view unit;
  std::string_view definition;          ///< ISO 21920-2
  std::string_view definition_iso4287;  ///< "" if the same
};

inline constexpr std::size_t kProfileQuantities = 19;
extern const std::array<ProfileQuantity, kProfileQuantities> kProfileTable;

/// Values in the order of kProfileTable; NaN where the profile has no such value.
using ProfileValues = std::array<double, kProfileQuantities>;

/// `n` equal lengths of a profile of `size` points, from the first to behind the last point of
/// each, alike from both ends: a point that a boundary cuts belongs to both sides.
struct Section {
  Index begin = 0, end = 0;
};
std::vector<Section> sections_of(Index size, int n);

/// Computes the values of one filtered profile: heights z [m] about the mean line z = 0 over the
/// evaluation length, NaN for holes, `spacing` [m] apart, divided into `sections` equal lengths.
ProfileValues profile_values(const Eigen::ArrayXd& z, double spacing, int sections,
                             const ProfileOptions& options);

}  // namespace tabor::metrology
