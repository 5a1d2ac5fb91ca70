#include "tabor/numerics/bracketed_secant.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tabor::numerics {

void BracketedSecant::learn_slope(const Point& latest) {
  if (!previous_) return;
  const double slope = (latest.value - previous_->value) / (latest.place - previous_->place);
  if (std::isfinite(slope) && slope > 0) slope_ = slope;
}

double BracketedSecant::next(double place, double value) {
  if (value == 0) return place;
  const Point latest{place, value};
  learn_slope(latest);
  const double before = previous_ ? place - previous_->place : 0;
  const bool is_flat = previous_ && std::abs(value) > 0.5 * std::abs(previous_->value);
  previous_ = latest;
  (value < 0 ? low_ : high_) = latest;
  double step = -value / slope_;
  if (!low_ || !high_) {
    if (is_flat) step = std::copysign(std::max(std::abs(step), 2 * std::abs(before)), step);
    return place + std::clamp(step, -longest_step_, longest_step_);
  }
  constexpr int patience = 2;  // a secant may narrow the bracket from one side for so many steps
  const double width = high_->place - low_->place;
  if (width_ == 0 || width <= 0.5 * width_) {
    width_ = width;
    n_slow_ = 0;
  } else {
    ++n_slow_;
  }
  const bool is_inside = place + step > low_->place && place + step < high_->place;
  if (is_inside && n_slow_ <= patience) return place + step;
  n_slow_ = 0;
  width_ = width;
  return 0.5 * (low_->place + high_->place);
}

}  // namespace tabor::numerics
