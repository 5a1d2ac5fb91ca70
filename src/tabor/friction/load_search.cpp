#include "tabor/friction/load_search.hpp"

#include <algorithm>
#include <cmath>

namespace tabor::friction {

// A film that carries a share of the load at position 1 carries less in a wider gap: what is left
// for the solids is at least 1 - share. Shares near or above one say nothing and are searched for.
double LoadSearch::step_down(double position, double value) {
  if (position == 1) {
    const double share = std::expm1(value);
    return share < 0.9 ? std::sqrt(1 - share) : 0.3;
  }
  if (position > 0.25) return 0.5 * position;
  if (position > 0) return 0;
  return position == 0 ? -0.5 : 2 * position;
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

/// Where the ends have come close to each other without a zero between them, the older one no
/// longer tells the truth: it goes where the slope found before puts it.
void LoadSearch::renew(const Point& latest) {
  const double width = high_->position - low_->position;
  const bool narrow = width <= 0.02 * std::max(std::abs(latest.position), 0.05);
  const bool fresh = std::abs(same_side_) < 2;  // both ends are from the last two calls
  if (!narrow || fresh) {
    slope_ = (high_->value - low_->value) / width;
    return;
  }
  slope_ /= 2;  // farther each time
  const Point other{latest.position - 2 * latest.value / slope_, -latest.value};
  (latest.value < 0 ? high_ : low_) = other;
}

bool LoadSearch::met_a_jump() const {
  return low_ && high_ && std::abs(same_side_) < 2 &&
         high_->position - low_->position <= 1e-4 * std::max(std::abs(low_->position), 0.05);
}

double LoadSearch::next(double position, double value) {
  if (value < 0) {
    low_ = {position, value};
    same_side_ = std::max(same_side_, 0) + 1;
    if (!high_) return std::min(1.0, position + 0.1);  // the surface has given way meanwhile
  } else {
    high_ = {position, value};
    same_side_ = std::min(same_side_, 0) - 1;
    if (!low_) return step_down(position, value);
  }
  renew({position, value});
  return std::min(between(), 1.0);
}

}  // namespace tabor::friction
