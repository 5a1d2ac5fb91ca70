#pragma once

#include <optional>
#include <vector>

namespace tabor::analysis {

/// A range of places over which a value hardly changes.
struct Plateau {
  double first = 0;  ///< place
  double last = 0;   ///< place
  double value = 0;  ///< mean over the range
};

/// The longest range, by the ratio of its ends, of at least three consecutive places whose values
/// all lie within `tolerance` (relative) of their mean; nullopt if there is none. Places rise from
/// above zero.
std::optional<Plateau> find_plateau(const std::vector<double>& places,
                                    const std::vector<double>& values, double tolerance);

}  // namespace tabor::analysis
