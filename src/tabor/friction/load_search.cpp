#include "tabor/friction/load_search.hpp"

#include <algorithm>
#include <cmath>

namespace tabor::friction {

namespace {
constexpr double kNarrowest = 1e-7;  // bracket in which nothing is left to find
}

// A film that carries a share of the load at position 1 carries less in a wider gap: what is left
// for the solids is at least 1 - share. Shares near or above one say nothing and are searched for.
double LoadSearch::step_down(double value) const {
  if (position_ == 1) {
    const double share = std::expm1(value);
    return share < 0.9 ? std::sqrt(1 - share) : 0.3;
  }
  if (position_ > 0.25) return 0.5 * position_;
  if (position_ > 0) return 0;
  return position_ == 0 ? -0.5 : 2 * position_;
}

/// False position, with the value of an end that does not move halved (Illinois: Dowell & Jarratt
/// 1971, doi:10.1007/BF01934364).
double LoadSearch::between() const {
  const double low_value = low_->value * (same_side_ < -1 ? 0.5 : 1);
  const double high_value = high_->value * (same_side_ > 1 ? 0.5 : 1);
  const double place =
      high_->position - high_value * (high_->position - low_->position) / (high_value - low_value);
  const double margin = 0.02 * (high_->position - low_->position);
  return std::clamp(place, low_->position + margin, high_->position - margin);
}

bool LoadSearch::advance(double value) {
  if (!std::isfinite(value)) return false;
  if (value < 0) {
    low_ = {position_, value};
    same_side_ = std::max(same_side_, 0) + 1;
  } else {
    high_ = {position_, value};
    same_side_ = std::min(same_side_, 0) - 1;
  }
  position_ = low_ && high_ ? between() : step_down(value);
  return !(low_ && high_) || high_->position - low_->position > kNarrowest;
}

}  // namespace tabor::friction
