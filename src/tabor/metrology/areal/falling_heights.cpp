// Sorts the valid heights on all threads with no memory beside the result: a sample of them gives
// the limits of buckets, the heights go straight to their bucket's place, each bucket is sorted.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "tabor/core/rows.hpp"
#include "tabor/metrology/areal/abbott.hpp"

namespace tabor::metrology {
namespace {

constexpr Index kBuckets = 1024;
constexpr Index kSampleSize = 32 * kBuckets;
constexpr Index kSerialSize = 4 * kSampleSize;  ///< fewer heights are sorted at once

/// Falling limits between buckets, from heights at even distances of the map.
std::vector<double> bucket_limits(const Field& height, double mean) {
  std::vector<double> sample;
  const Index stride = std::max<Index>(1, height.size() / kSampleSize);
  for (Index i = 0; i < height.size(); i += stride) {
    if (const double z = height.data()[i]; !std::isnan(z)) sample.push_back(z - mean);
  }
  std::sort(sample.begin(), sample.end(), std::greater<>());
  std::vector<double> limits;
  for (Index bucket = 1; bucket < kBuckets && !sample.empty(); ++bucket) {
    limits.push_back(
        sample[sample.size() * static_cast<std::size_t>(bucket) / std::size_t{kBuckets}]);
  }
  return limits;
}

std::size_t bucket_of(double z, const std::vector<double>& limits) {
  const auto limit = std::lower_bound(limits.begin(), limits.end(), z, std::greater<>());
  return static_cast<std::size_t>(limit - limits.begin());
}

/// Calls visit(block, bucket, z) for every valid height, blocks of rows in parallel.
template <typename Visit>
void visit_heights(const Field& height, double mean, const std::vector<double>& limits,
                   const Visit& visit) {
  parallel_for(height.rows(), kRowsPerBlock, [&](Index begin, Index end) {
    const auto block = static_cast<std::size_t>(begin / kRowsPerBlock);
    for (Index i = begin * height.cols(); i < end * height.cols(); ++i) {
      const double z = height.data()[i] - mean;
      if (!std::isnan(z)) visit(block, bucket_of(z, limits), z);
    }
  });
}

using Counts = std::vector<std::array<Index, kBuckets>>;  ///< per block of rows and bucket

Counts count_heights(const Field& height, double mean, const std::vector<double>& limits) {
  Counts counts(static_cast<std::size_t>((height.rows() + kRowsPerBlock - 1) / kRowsPerBlock));
  visit_heights(height, mean, limits,
                [&](std::size_t block, std::size_t bucket, double) { ++counts[block][bucket]; });
  return counts;
}

/// Turns counts into the places where each block's heights of each bucket begin; returns where the
/// buckets begin, and the end.
std::vector<Index> places_from(Counts& counts) {
  std::vector<Index> starts;
  Index place = 0;
  for (std::size_t bucket = 0; bucket < std::size_t{kBuckets}; ++bucket) {
    starts.push_back(place);
    for (auto& block : counts) {
      const Index n = block[bucket];
      block[bucket] = place;
      place += n;
    }
  }
  starts.push_back(place);
  return starts;
}

void sort_falling(double* begin, double* end) {
  // Many equal heights (a quantised scan) come as buckets of one value.
  if (!std::is_sorted(begin, end, std::greater<>())) std::sort(begin, end, std::greater<>());
}

void sort_buckets(std::vector<double>& heights, const std::vector<Index>& starts,
                  const Observer& observer) {
  constexpr Index at_a_time = kBuckets / 16;
  for (Index first = 0; first < kBuckets; first += at_a_time) {
    report_progress(observer, "material ratio curve",
                    static_cast<double>(first) / static_cast<double>(kBuckets));
    parallel_for(at_a_time, 1, [&](Index begin, Index) {
      const auto bucket = static_cast<std::size_t>(first + begin);
      sort_falling(heights.data() + starts[bucket], heights.data() + starts[bucket + 1]);
    });
  }
}

}  // namespace

std::vector<double> falling_heights(const Field& height, Index n_valid, double mean,
                                    const Observer& observer) {
  std::vector<double> heights;
  heights.reserve(static_cast<std::size_t>(n_valid));
  if (n_valid <= kSerialSize) {
    for (const double z : height.reshaped<Eigen::RowMajor>()) {
      if (!std::isnan(z)) heights.push_back(z - mean);
    }
    sort_falling(heights.data(), heights.data() + heights.size());
    return heights;
  }
  heights.resize(static_cast<std::size_t>(n_valid));
  const std::vector<double> limits = bucket_limits(height, mean);
  Counts places = count_heights(height, mean, limits);
  const std::vector<Index> starts = places_from(places);
  visit_heights(height, mean, limits, [&](std::size_t block, std::size_t bucket, double z) {
    heights[static_cast<std::size_t>(places[block][bucket]++)] = z;
  });
  sort_buckets(heights, starts, observer);
  return heights;
}

}  // namespace tabor::metrology
