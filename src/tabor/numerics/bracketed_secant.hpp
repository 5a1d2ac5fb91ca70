#pragma once

#include <optional>

namespace tabor::numerics {

/// Finds the zero of an increasing function that is costly and a little noisy, with no bracket
/// known at first: the secant through the last two places; once values of both signs are known,
/// bisection wherever the secant leads out of their bracket or does not narrow it. Until then,
/// steps double where the value falls by less than half, so that a place where the function is flat
/// is left.
class BracketedSecant {
 public:
  /// slope: a guess of the function's, > 0; longest_step: of one step before both signs are known.
  BracketedSecant(double slope, double longest_step) : slope_(slope), longest_step_(longest_step) {}

  /// Takes the value at a place and returns the next place.
  double next(double place, double value);

  /// Returns the slope as it is known so far.
  double slope() const { return slope_; }

 private:
  struct Point {
    double place;
    double value;
  };

  void learn_slope(const Point& latest);

  std::optional<Point> low_, high_;  // values below zero, and not
  std::optional<Point> previous_;
  double slope_;
  double longest_step_;
  double width_ = 0;  // of the bracket when it was last narrowed enough
  int n_slow_ = 0;    // steps since
};

}  // namespace tabor::numerics
