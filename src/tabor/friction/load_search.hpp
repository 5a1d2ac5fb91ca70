#pragma once

#include <optional>

namespace tabor::friction {

/// Finds the zero of an increasing function of a position with few evaluations. Positions begin at
/// 1, where the function is positive, and decrease without limit: for 1 > x >= 0 solids and oil
/// share the load, below 0 the surfaces are apart. Values may change a little from one call to the
/// next, as the oil deforms the surface.
class LoadSearch {
 public:
  /// Takes the value at a position, ln((solid + fluid load)/load), and returns the next position.
  double next(double position, double value);

  /// True where the value jumps over zero, as when a contact pixel opens.
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
