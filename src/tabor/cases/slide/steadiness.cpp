#include "tabor/cases/slide/steadiness.hpp"

#include <cmath>
#include <cstddef>

namespace tabor::cases {
namespace {

constexpr double kSmall = 0.01;

}  // namespace

void Steadiness::add(double begin, const Period& step) {
  constexpr double rounding = 1e-9;
  const auto place = static_cast<std::size_t>(begin / period_ + rounding);
  if (periods_.size() <= place) periods_.resize(place + 1);
  Period& period = periods_[place];
  period.distance += step.distance;
  period.moved += step.moved;
  period.friction += step.friction;
}

bool Steadiness::is_steady() const {
  const std::size_t n_whole = periods_.empty() ? 0 : periods_.size() - 1;
  if (n_whole < 2) return false;
  const auto moved = [](const Period& one) { return one.moved / one.distance; };
  const auto friction = [](const Period& one) { return one.friction / one.distance; };
  const Period& last = periods_[n_whole - 1];
  const double before = friction(periods_[n_whole - 2]);
  return moved(last) <= kSmall * moved(periods_.front()) &&
         std::abs(friction(last) - before) <= kSmall * std::abs(before);
}

const Columns<Period>& period_columns() {
  static const Columns<Period> all{{"distance_m", "m", "", &Period::distance},
                                   {"moved_m", "m", "", &Period::moved},
                                   {"friction_m", "m", "", &Period::friction}};
  return all;
}

}  // namespace tabor::cases
