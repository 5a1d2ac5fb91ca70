#include "tabor/metrology/features/watershed.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>
#include <vector>

#include "support/sample_surfaces.hpp"
#include "tabor/core/error.hpp"

namespace tabor::metrology::test {

using namespace tabor::test;
namespace {

/// Slow and obviously right: what the definitions say, pair of pixels by pair of pixels.
class NaiveWatershed {
 public:
  NaiveWatershed(const topography::Topography& topography, double least_difference)
      : z_(topography.height), grid_(topography.grid), periodic_(topography.periodic) {
    for (Index p = 0; p < z_.size(); ++p) hill_.push_back(std::isnan(z(p)) ? kNone : climb(p));
    while (prune_one(least_difference)) {
    }
  }

  std::set<Index> peaks() const {
    std::set<Index> all(hill_.begin(), hill_.end());
    all.erase(kNone);
    return all;
  }
  Index hill(Index p) const { return hill_[static_cast<std::size_t>(p)]; }

  struct Pass {
    double height = -std::numeric_limits<double>::infinity();
    double slope = 0;
    Index to = kNone;
  };
  /// The highest pass from a hill to another: over pairs of neighbours on both sides of the border.
  Pass pass_of(Index hill_number) const {
    Pass best;
    for (Index p = 0; p < z_.size(); ++p) {
      for (const Index q : neighbours(p)) {
        if (hill(p) != hill_number || hill(q) == hill_number || hill(q) == kNone) continue;
        const double height = std::min(z(p), z(q));
        const double slope = std::abs(z(p) - z(q)) / distance(p, q);
        if (height > best.height || (height == best.height && slope > best.slope)) {
          best = {height, slope, hill(q)};
        }
      }
    }
    return best;
  }

  std::vector<Index> neighbours(Index p) const {
    std::vector<Index> result;
    for (Index dy = -1; dy <= 1; ++dy) {
      for (Index dx = -1; dx <= 1; ++dx) {
        Index y = p / grid_.nx + dy, x = p % grid_.nx + dx;
        if (periodic_) {
          y = (y + grid_.ny) % grid_.ny;
          x = (x + grid_.nx) % grid_.nx;
        }
        const bool inside = y >= 0 && x >= 0 && y < grid_.ny && x < grid_.nx;
        if (inside && (dx != 0 || dy != 0) && !std::isnan(z_(y, x))) {
          result.push_back(y * grid_.nx + x);
        }
      }
    }
    return result;
  }

 private:
  static constexpr Index kNone = -1;
  double z(Index p) const { return z_.data()[p]; }

  double distance(Index p, Index q) const {
    Index dx = std::abs(p % grid_.nx - q % grid_.nx), dy = std::abs(p / grid_.nx - q / grid_.nx);
    dx = std::min(dx, grid_.nx - dx);
    dy = std::min(dy, grid_.ny - dy);
    return std::hypot(static_cast<double>(dx) * grid_.dx(), static_cast<double>(dy) * grid_.dy());
  }

  Index climb(Index p) const {
    for (;;) {
      Index next = p;
      double steepest = 0;
      for (const Index q : neighbours(p)) {
        const double slope = (z(q) - z(p)) / distance(p, q);
        if (slope > steepest) {
          steepest = slope;
          next = q;
        }
      }
      if (next == p) return p;
      p = next;
    }
  }

  /// Wolf's rule: the smallest difference first.
  bool prune_one(double least_difference) {
    double smallest = least_difference;
    Index from = kNone, to = kNone;
    for (const Index peak : peaks()) {
      const Pass pass = pass_of(peak);
      if (pass.to != kNone && z(peak) - pass.height < smallest) {
        smallest = z(peak) - pass.height;
        from = peak;
        to = pass.to;
      }
    }
    std::replace(hill_.begin(), hill_.end(), from, to);
    return from != kNone;
  }

  const Field& z_;
  Grid grid_;
  bool periodic_;
  std::vector<Index> hill_;
};

topography::Topography random_map(Index nx, Index ny, std::uint64_t seed, double hole_share,
                                  bool periodic) {
  auto topography =
      noise({nx, ny, 1e-6 * static_cast<double>(nx), 1.7e-6 * static_cast<double>(ny)}, seed);
  punch_holes(topography, hole_share, seed + 1000);
  topography.periodic = periodic;
  return topography;
}

double at(const topography::Topography& topography, PixelIndex p) {
  return topography.height.data()[p];
}

/// Without the hills of areas that holes cut off: the naive method has no rule for these.
void expect_like_naive(const topography::Topography& topography, double least_difference) {
  const auto fast = segment(topography, MotifKind::hill, least_difference);
  const NaiveWatershed naive(topography, least_difference);
  std::set<Index> peaks;
  for (const Motif& motif : fast.motifs) peaks.insert(motif.extremum);
  ASSERT_EQ(peaks, naive.peaks());
  for (std::size_t i = 0; i < fast.label.size(); ++i) {
    const auto label = fast.label[i];
    ASSERT_EQ(label == kNoMotif ? -1 : Index{fast.motifs[label].extremum},
              naive.hill(static_cast<Index>(i)))
        << "pixel " << i;
  }
  for (const Motif& motif : fast.motifs) {
    const auto pass = naive.pass_of(motif.extremum);
    ASSERT_EQ(motif.saddle == kNoPixel, pass.to < 0);
    if (motif.saddle != kNoPixel) {
      ASSERT_EQ(at(topography, motif.saddle), pass.height);
    }
  }
}

TEST(Segment, EqualsTheDefinitionOnRandomMaps) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Index nx = 3 + static_cast<Index>(seed % 9), ny = 3 + static_cast<Index>(seed % 7);
    const auto topography = random_map(nx, ny, seed, 0, seed % 3 == 0);
    for (const double least : {0.0, 0.4e-6, 1e-6, 2e-6}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << " least difference " << least);
      expect_like_naive(topography, least);
    }
  }
}

TEST(Segment, EqualsTheDefinitionOnRandomMapsWithHoles) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    auto topography = random_map(9, 8, seed, 0.15, seed % 2 == 0);
    // Holes may cut off areas; their last peaks obey a rule of their own (tested below), which
    // does nothing where the least difference is zero and no area is a single pixel.
    bool cut_off = false;
    const NaiveWatershed unpruned(topography, 1e9);
    for (const Index peak : unpruned.peaks()) {
      cut_off = cut_off || unpruned.neighbours(peak).empty();
    }
    if (cut_off) continue;
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    expect_like_naive(topography, 0);
    if (unpruned.peaks().size() == 1) expect_like_naive(topography, 0.8e-6);
  }
}

TEST(Segment, LeavesOneHillWhenEverythingIsPruned) {
  const auto topography = random_map(40, 30, 3, 0, false);
  const double range = topography.height.maxCoeff() - topography.height.minCoeff();
  const auto hills = segment(topography, MotifKind::hill, range);
  ASSERT_EQ(hills.motifs.size(), 1U);
  EXPECT_EQ(at(topography, hills.motifs[0].extremum), topography.height.maxCoeff());
  EXPECT_EQ(hills.motifs[0].n_pixels, 1200U);
  EXPECT_EQ(hills.motifs[0].saddle, kNoPixel);
}

TEST(Segment, KeepsEveryStrictMaximumWithoutPruning) {
  const auto topography = random_map(40, 30, 4, 0.02, true);
  const NaiveWatershed naive(topography, 0);
  Index n_maxima = 0;
  for (Index p = 0; p < topography.height.size(); ++p) {
    bool maximum = !std::isnan(topography.height.data()[p]);
    for (const Index q : naive.neighbours(p)) {
      maximum = maximum && topography.height.data()[q] < topography.height.data()[p];
    }
    n_maxima += maximum ? 1 : 0;
  }
  EXPECT_EQ(static_cast<Index>(segment(topography, MotifKind::hill, 0).motifs.size()), n_maxima);
}

TEST(Segment, FindsThePitsOfAMapWhereItsNegativeHasPeaks) {
  auto topography = random_map(50, 40, 5, 0.05, false);
  for (double& z : topography.height.reshaped()) z = std::round(z * 3e6) * 1e-6;  // with plateaus
  const auto dales = segment(topography, MotifKind::dale, 1.5e-6);
  auto negative = topography;
  negative.height = -topography.height;
  const auto hills = segment(negative, MotifKind::hill, 1.5e-6);
  ASSERT_EQ(dales.motifs.size(), hills.motifs.size());
  EXPECT_GT(dales.motifs.size(), 10U);
  EXPECT_EQ(dales.label, hills.label);
  for (std::size_t i = 0; i < hills.motifs.size(); ++i) {
    EXPECT_EQ(dales.motifs[i].extremum, hills.motifs[i].extremum);
    EXPECT_EQ(dales.motifs[i].saddle, hills.motifs[i].saddle);
    EXPECT_EQ(dales.motifs[i].volume, hills.motifs[i].volume);
  }
}

/// Each hill as the sorted heights of its pixels: what no turning of the map may change.
std::set<std::vector<double>> hills_by_heights(const topography::Topography& topography,
                                               double least) {
  const auto hills = segment(topography, MotifKind::hill, least);
  std::vector<std::vector<double>> heights(hills.motifs.size());
  for (std::size_t i = 0; i < hills.label.size(); ++i) {
    if (hills.label[i] != kNoMotif) heights[hills.label[i]].push_back(topography.height.data()[i]);
  }
  for (auto& hill : heights) std::sort(hill.begin(), hill.end());
  return {heights.begin(), heights.end()};
}

TEST(Segment, DoesNotDependOnTheOrientation) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto topography = random_map(31, 22, seed, 0.03, seed % 2 == 0);
    const auto expected = hills_by_heights(topography, 0.7e-6);
    auto turned = topography;
    turned.height = topography.height.rowwise().reverse();
    EXPECT_EQ(hills_by_heights(turned, 0.7e-6), expected);
    turned.height = topography.height.colwise().reverse();
    EXPECT_EQ(hills_by_heights(turned, 0.7e-6), expected);
    turned.height = topography.height.transpose();
    turned.grid = {topography.grid.ny, topography.grid.nx, topography.grid.ly, topography.grid.lx};
    EXPECT_EQ(hills_by_heights(turned, 0.7e-6), expected);
  }
}

/// Peaks by what is connected above each level: counts areas of equal height once.
Index count_plateau_peaks(const topography::Topography& topography, double least_difference) {
  const NaiveWatershed helper(topography, 0);
  const Index n = topography.height.size();
  const double* z = topography.height.data();
  const std::set<double> levels(z, z + n);
  Index count = 0;
  for (Index peak = 0; peak < n; ++peak) {
    // A peak is the first pixel, by height then by place, of its connected area at its own level;
    // it lasts down to the first level whose connected area holds an earlier pixel.
    double died_at = *levels.begin();
    for (auto level = levels.rbegin(); level != levels.rend(); ++level) {
      if (*level > z[peak]) continue;
      std::vector<Index> area{peak};
      std::set<Index> seen{peak};
      bool earlier = false;
      for (std::size_t head = 0; head < area.size(); ++head) {
        const Index p = area[head];
        earlier = earlier || z[p] > z[peak] || (z[p] == z[peak] && p < peak);
        for (const Index q : helper.neighbours(p)) {
          if (z[q] >= *level && seen.insert(q).second) area.push_back(q);
        }
      }
      if (earlier) {
        died_at = *level;
        break;
      }
    }
    const double difference = z[peak] - died_at;
    count += difference > 0 && difference >= least_difference ? 1 : 0;
  }
  return count;
}

TEST(Segment, CountsAPlateauOnce) {
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    auto topography = random_map(10, 9, seed, 0, seed % 2 == 0);
    for (double& z : topography.height.reshaped()) z = std::round(z * 1.5e6);
    for (const double least : {0.0, 1.0, 2.0, 3.0}) {
      EXPECT_EQ(static_cast<Index>(segment(topography, MotifKind::hill, least).motifs.size()),
                count_plateau_peaks(topography, least))
          << "seed " << seed << " least difference " << least;
    }
  }
}

TEST(Segment, SharesAPlainBetweenTheNearestHills) {
  const Grid grid{21, 5, 21, 5};
  auto topography = surface(grid, [](double, double) { return 0.0; });
  topography.height(2, 4) = 1;
  topography.height(2, 16) = 2;
  const auto hills = segment(topography, MotifKind::hill, 0);
  ASSERT_EQ(hills.motifs.size(), 2U);
  for (Index x = 0; x < 21; ++x) {
    if (x != 10) {  // as near to one as to the other
      EXPECT_EQ(hills.label[static_cast<std::size_t>(2 * 21 + x)], x < 10 ? 1U : 0U) << x;
    }
  }
}

TEST(Segment, HasNoMotifOnAFlatMap) {
  for (const bool periodic : {false, true}) {
    auto flat = surface({8, 8, 1, 1}, [](double, double) { return 3.0; });
    flat.periodic = periodic;
    EXPECT_TRUE(segment(flat, MotifKind::hill, 0).motifs.empty());
    EXPECT_TRUE(segment(flat, MotifKind::dale, 0).motifs.empty());
  }
}

TEST(Segment, MeasuresAnAreaCutOffByHolesFromItsLowestPoint) {
  auto topography = surface({12, 5, 12, 5}, [](double x, double) { return x < 6 ? 0.0 : 1.0; });
  topography.height.col(6).setConstant(kHole);
  topography.height(2, 3) = 10;
  topography.height(2, 9) = 1.5;  // stands 0.5 above its area, which holes cut off
  EXPECT_EQ(segment(topography, MotifKind::hill, 0.4).motifs.size(), 2U);
  const auto hills = segment(topography, MotifKind::hill, 0.6);
  ASSERT_EQ(hills.motifs.size(), 1U);
  EXPECT_EQ(hills.motifs[0].extremum, 2U * 12 + 3);
  EXPECT_EQ(hills.label[2 * 12 + 9], kNoMotif);
  EXPECT_EQ(hills.label[2 * 12 + 6], kNoMotif);
}

TEST(Segment, MapsOfOneRowOrColumnAreProfiles) {
  auto row = surface({50, 1, 50, 1}, [](double x, double) { return -std::cos(2 * pi * x / 10); });
  EXPECT_EQ(segment(row, MotifKind::hill, 0.1).motifs.size(), 5U);
  auto column = surface({1, 50, 1, 50}, [](double, double y) { return std::cos(2 * pi * y / 10); });
  EXPECT_EQ(segment(column, MotifKind::dale, 0.1).motifs.size(), 5U);
}

TEST(Segment, OrdersSaddlesTooCloseForTheSortingKeys) {
  auto topography = random_map(12, 9, 9, 0, false);
  topography.height *= 1e-9;          // differences far below 2^-32 of the range ...
  topography.height(0, 0) = 1;        // ... that this point makes
  topography.height(8, 11) = -1e-16;  // and this one
  for (const double least : {0.0, 0.4e-15, 1e-15}) expect_like_naive(topography, least);
}

TEST(Segment, StopsWhenTheObserverAsks) {
  const auto topography = random_map(20, 20, 1, 0, false);
  EXPECT_THROW(segment(topography, MotifKind::hill, 0, [](const Progress&) { return false; }),
               Interrupted);
}

}  // namespace
}  // namespace tabor::metrology::test
