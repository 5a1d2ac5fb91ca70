#pragma once

#include <optional>
#include <vector>

// Finds the longest range of places over which a sampled curve is constant within a tolerance.
namespace tabor::cases {

/// Range of places over which a value hardly changes.
struct Plateau {
  double first = 0;  ///< place
  double last = 0;   ///< place
  double value = 0;  ///< mean over the range
};

/// Returns the longest range, by the ratio of its ends, of at least three consecutive places whose
/// values all lie within `tolerance` (relative) of their mean; nullopt if there is none. Places
/// rise from above zero.
std::optional<Plateau> find_plateau(const std::vector<double>& places,
                                    const std::vector<double>& values, double tolerance);

}  // namespace tabor::cases
