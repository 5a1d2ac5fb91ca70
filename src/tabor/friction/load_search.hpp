#pragma once

#include <optional>

namespace tabor::friction {

/// Finds where an increasing function of a position is zero when each value is costly. Positions
/// begin at 1, where the function is positive, and go down without end: 1 > x >= 0 shares the load
/// between solids and oil, below 0 the surfaces are apart.
class LoadSearch {
 public:
  double position() const { return position_; }

  /// Tells the value at position(), ln((solid + fluid load)/load), and moves on. False where no
  /// other position is left to try.
  bool advance(double value);

 private:
  struct Point {
    double position;
    double value;
  };

  double step_down(double value) const;
  double between() const;

  double position_ = 1;
  std::optional<Point> low_, high_;  // values of opposite signs
  int same_side_ = 0;                // > 0: so often the low end has moved, < 0: the high end
};

}  // namespace tabor::friction
