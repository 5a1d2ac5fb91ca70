#include "tabor/metrology/features/steepest_ways.hpp"

#include <algorithm>

#include "tabor/core/rows.hpp"

namespace tabor::metrology {
namespace {

/// A pixel of a plateau that has not found its way yet.
constexpr PixelIndex kWaiting = 0xFFFFFFFEU;

/// Per pixel its steepest higher neighbour; itself if none is higher; kNoPixel in a hole.
std::vector<PixelIndex> steepest_steps(const Relief& relief) {
  std::vector<PixelIndex> next(relief.n_pixels());
  const Index nx = relief.map.height.cols();
  for_each_row(relief.map.height.rows(), [&](Index y) {
    for (Index x = 0; x < nx; ++x) {
      const auto p = static_cast<PixelIndex>(y * nx + x);
      const double here = relief(p);
      next[p] = std::isnan(here) ? kNoPixel : p;
      double steepest = 0;
      relief.neighbours.for_each(y, x, [&](PixelIndex q, double inverse_distance) {
        const double slope = (relief(q) - here) * inverse_distance;
        if (slope > steepest) {
          steepest = slope;
          next[p] = q;
        }
      });
    }
  });
  return next;
}

/// Gives the pixels of plateaus their way off.
class Plateaus {
 public:
  Plateaus(const Relief& relief, std::vector<PixelIndex>& next) : relief_(relief), next_(next) {}

  /// The plateau of a pixel that has no higher neighbour.
  void resolve(PixelIndex first) {
    gather(first);
    for (const PixelIndex p : plateau_) leave_at(p);
    for (std::size_t head = 0; head < leaving_.size(); ++head) spread_from(leaving_[head]);
    if (leaving_.empty()) {
      for (const PixelIndex p : plateau_) next_[p] = first;
    }
    plateau_.clear();
    leaving_.clear();
  }

 private:
  /// All pixels of the plateau without a higher neighbour.
  void gather(PixelIndex first) {
    const auto take = [&](PixelIndex p) {
      next_[p] = kWaiting;
      plateau_.push_back(p);
    };
    take(first);
    for (std::size_t head = 0; head < plateau_.size(); ++head) {
      relief_.neighbours.for_each(plateau_[head], [&](PixelIndex q, double) {
        if (next_[q] == q && relief_(q) == relief_(first)) take(q);
      });
    }
  }

  /// Leads a waiting pixel to a neighbour of the same height from which a way leads up.
  void leave_at(PixelIndex p) {
    relief_.neighbours.for_each(p, [&](PixelIndex q, double) {
      if (next_[p] == kWaiting && relief_(q) == relief_(p) && next_[q] != kWaiting &&
          relief_(next_[q]) > relief_(q)) {
        next_[p] = q;
        leaving_.push_back(p);
      }
    });
  }

  void spread_from(PixelIndex p) {
    relief_.neighbours.for_each(p, [&](PixelIndex q, double) {
      if (next_[q] == kWaiting) {
        next_[q] = p;
        leaving_.push_back(q);
      }
    });
  }

  const Relief& relief_;
  std::vector<PixelIndex>& next_;
  std::vector<PixelIndex> plateau_, leaving_;
};

/// The pixels that are their own next step.
std::vector<PixelIndex> sorted_peaks(const Relief& relief, const std::vector<PixelIndex>& next) {
  std::vector<PixelIndex> peaks;
  const auto is_peak = [&](PixelIndex p) { return next[p] == p; };
  PixelIndex n_peaks = 0;
  for (PixelIndex p = 0; p < next.size(); ++p) n_peaks += is_peak(p) ? 1 : 0;
  peaks.reserve(n_peaks);
  for (PixelIndex p = 0; p < next.size(); ++p) {
    if (is_peak(p)) peaks.push_back(p);
  }
  std::sort(peaks.begin(), peaks.end(), [&](PixelIndex a, PixelIndex b) {
    return relief(a) > relief(b) || (relief(a) == relief(b) && a < b);
  });
  return peaks;
}

/// Replaces every step by the number of the peak at the end of the way.
void follow_to_peaks(const std::vector<PixelIndex>& peaks, std::vector<PixelIndex>& next) {
  constexpr PixelIndex is_number = kPixelLimit;  // a bit that no pixel has
  for (std::uint32_t i = 0; i < peaks.size(); ++i) next[peaks[i]] = is_number | i;
  std::vector<PixelIndex> way;
  for (PixelIndex p = 0; p < next.size(); ++p) {
    PixelIndex at = p;
    for (; (next[at] & is_number) == 0; at = next[at]) way.push_back(at);
    for (const PixelIndex passed : way) next[passed] = next[at];
    way.clear();
  }
  for (PixelIndex& number : next) {
    if (number != kNoMotif) number &= ~is_number;
  }
}

}  // namespace

Ascents climb(const Relief& relief) {
  Ascents ascents;
  auto next = steepest_steps(relief);
  Plateaus plateaus(relief, next);
  for (PixelIndex p = 0; p < next.size(); ++p) {
    if (next[p] == p) plateaus.resolve(p);
  }
  ascents.peaks = sorted_peaks(relief, next);
  follow_to_peaks(ascents.peaks, next);
  ascents.label = std::move(next);
  return ascents;
}

}  // namespace tabor::metrology
