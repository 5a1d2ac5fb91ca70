#pragma once

#include <vector>

#include "tabor/core/column.hpp"

// Tells when sliding has become steady.
namespace tabor::cases {

/// Sums over the steps that began in one period of the tool.
struct Period {
  double distance = 0;  ///< [m]
  double moved = 0;     ///< volume of displaced material [m]
  double friction = 0;  ///< integral of the coefficient over the distance [m]
};
const Columns<Period>& period_columns();

/// Follows displaced material and friction from one period of the tool to the next.
class Steadiness {
 public:
  /// `period` [m]: length of the tool.
  explicit Steadiness(double period, std::vector<Period> before = {})
      : period_(period), periods_(std::move(before)) {}

  /// Adds a step from `begin` [m].
  void add(double begin, const Period& step);
  /// True where the displaced volume over the distance of the last whole period is below 1 % of
  /// that of the first, and the friction of the last two whole periods agrees within 1 %.
  bool is_steady() const;
  const std::vector<Period>& periods() const { return periods_; }

 private:
  double period_;
  std::vector<Period> periods_;  ///< the last one is not whole
};

}  // namespace tabor::cases
