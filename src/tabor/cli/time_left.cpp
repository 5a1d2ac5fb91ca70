#include "tabor/cli/time_left.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tabor::cli {

namespace {

constexpr double kLeastShare = 0.05;
constexpr double kLeastTime = 3;      // [s] of work before the first estimate
constexpr double kMemory = 5;         // [s] over which estimates are averaged
constexpr double kAgreeFor = 2;       // [s] of estimates before one is told
constexpr double kAgreeWithin = 1.5;  // ratio of what is left by the last share and by the average
constexpr double kAlwaysWithin = 5;   // [s] that nobody minds

}  // namespace

std::optional<double> TimeLeft::at(double now, double share) {
  if (!is_told_share_ && !std::isnan(share)) {
    is_told_share_ = true;
    if (share >= kLeastShare) {  // work of an earlier run says nothing about the time of this one
      share_before_ = share;
      start_ = now;
    }
  }
  const double gone = now - start_;
  const double done = share - share_before_;
  if (!(done >= kLeastShare * (1 - share_before_)) || share >= 1 || gone < kLeastTime) {
    end_.reset();
    return std::nullopt;
  }
  const double left = gone * (1 - share) / done;
  if (!end_) {
    end_ = now + left;
    known_since_ = last_ = now;
  }
  *end_ += (now + left - *end_) * (1 - std::exp(-(now - last_) / kMemory));
  last_ = now;
  const double told = std::max(0.0, *end_ - now);
  const bool agree = std::max(told, left) <= kAgreeWithin * std::min(told, left) ||
                     std::abs(told - left) <= kAlwaysWithin;
  return agree && now - known_since_ >= kAgreeFor ? std::optional(told) : std::nullopt;
}

std::string format_duration(double seconds) {
  const auto whole = static_cast<long>(std::lround(std::max(0.0, seconds)));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
}

std::string format_estimate(double seconds) {
  if (seconds < 9.5) return format_duration(seconds);
  if (seconds < 595) return format_duration(5 * std::round(seconds / 5));
  const auto minutes = static_cast<long>(std::lround(seconds / 60));
  return minutes < 60 ? fmt::format("{} min", minutes) : format_duration(seconds);
}

}  // namespace tabor::cli
