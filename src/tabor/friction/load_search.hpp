#pragma once

#include <optional>

namespace tabor::friction {

/// Finds where an increasing function of a position is zero when each value is costly. Positions
/// begin at 1, where the function is positive, and go down without end: 1 > x >= 0 shares the load
/// between solids and oil, below 0 the surfaces are apart. Values may change a little from one
/// call to the next, as the surface gives way to the oil.
class LoadSearch {
 public:
  /// Tells the value at a position, ln((solid + fluid load)/load); the position to try next.
  double next(double position, double value);

  /// True where the value jumps over zero: a pixel of contact that opens can do that.
  bool met_a_jump() const;

 private:
  struct Point {
    double position;
    double value;
  };

  static double step_down(double position, double value);
  double between() const;
  void renew(const Point& latest);

  std::optional<Point> low_, high_;  // values of opposite signs
  double slope_ = 1;                 // of the value, from ends that were apart
  int same_side_ = 0;                // > 0: so often the low end has moved, < 0: the high end
};

}  // namespace tabor::friction
