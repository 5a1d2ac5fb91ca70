#include "tabor/metrology/features/watershed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "tabor/core/error.hpp"
#include "tabor/core/watch.hpp"
#include "tabor/metrology/features/steepest_ways.hpp"

namespace tabor::metrology {
namespace {

/// Pixels with a neighbour, not lower, of another unpruned hill: at the highest of them areas meet.
/// From the highest on, equal ones by rising pixel.
class Borders {
 public:
  Borders(const Relief& relief, const std::vector<std::uint32_t>& label) {
    collect(relief, label);
    sort(relief);
  }

  std::size_t size() const { return keys_.size(); }
  PixelIndex operator[](std::size_t i) const { return static_cast<PixelIndex>(keys_[i]); }

 private:
  /// Sorting whole numbers is several times as fast as sorting places by the heights they point
  /// to: the upper half of a key is the depth below the highest point in 2^32 steps of the range.
  void collect(const Relief& relief, const std::vector<std::uint32_t>& label) {
    const Field& z = relief.map.height;
    const double low = z.minCoeff<Eigen::PropagateNumbers>();
    const double high = z.maxCoeff<Eigen::PropagateNumbers>();
    const double top = relief.sign > 0 ? high : -low;
    const double steps = 0xFFFFFFFFU / (high - low);
    const double scale = high > low && std::isfinite(steps) ? steps : 0;
    std::size_t n = 0;
    for_each_border(relief, label, [&](PixelIndex) { ++n; });
    keys_.reserve(n);
    for_each_border(relief, label, [&](PixelIndex p) {
      const auto depth = scale > 0 ? static_cast<std::uint64_t>((top - relief(p)) * scale) : 0;
      keys_.push_back(depth << 32U | p);
    });
  }

  template <typename Visit>
  static void for_each_border(const Relief& relief, const std::vector<std::uint32_t>& label,
                              const Visit& visit) {
    const Index nx = relief.map.height.cols();
    for (Index y = 0; y < relief.map.height.rows(); ++y) {
      go_on_or_throw();
      for (Index x = 0; x < nx; ++x) {
        const auto p = static_cast<PixelIndex>(y * nx + x);
        bool border = false;
        relief.neighbours.for_each(y, x, [&](PixelIndex q, double) {
          border = border || (label[q] != label[p] && relief(q) >= relief(p));
        });
        if (border) visit(p);
      }
    }
  }

  void sort(const Relief& relief) {
    std::sort(keys_.begin(), keys_.end());
    const auto exactly = [&](std::uint64_t a, std::uint64_t b) {
      const auto p = static_cast<PixelIndex>(a), q = static_cast<PixelIndex>(b);
      return relief(p) > relief(q) || (relief(p) == relief(q) && p < q);
    };
    for (auto begin = keys_.begin(); begin != keys_.end();) {
      const auto end = std::find_if(begin, keys_.end(), [depth = *begin >> 32U](std::uint64_t key) {
        return key >> 32U != depth;
      });
      std::sort(begin, end, exactly);
      begin = end;
    }
  }

  std::vector<std::uint64_t> keys_;
};

/// Lowers a level over the map. Where two connected areas above it meet, at a saddle, the area with
/// the lower peak either loses that peak or keeps it for good: the difference of this peak to this
/// saddle is the one that Wolf's rule compares, because every smaller one of the same area has been
/// decided before.
class ChangeTree {
 public:
  ChangeTree(const Relief& relief, Ascents ascents, double least_difference)
      : relief_(relief), ascents_(std::move(ascents)), least_difference_(least_difference) {
    branches_.reserve(ascents_.peaks.size());
    for (std::uint32_t i = 0; i < ascents_.peaks.size(); ++i) branches_.push_back({i, i, kNoPixel});
  }

  const std::vector<std::uint32_t>& label() const { return ascents_.label; }

  /// Joins the connected areas that meet at a pixel, along the steepest ways first, so that the
  /// result does not depend on the order of rows and columns.
  void meet_at(PixelIndex p) {
    struct Way {
      double slope = 0;
      std::uint32_t to = 0;
    };
    std::array<Way, 8> ways;
    std::size_t n_ways = 0;
    const auto here = label()[p];
    relief_.neighbours.for_each(p, [&](PixelIndex q, double inverse_distance) {
      const auto there = label()[q];
      if (there != here && relief_(q) >= relief_(p) && area_of(there) != area_of(here)) {
        ways[n_ways++] = {(relief_(q) - relief_(p)) * inverse_distance, there};
      }
    });
    if (n_ways == 0) return;
    std::stable_sort(ways.begin(), ways.begin() + n_ways,
                     [](const Way& a, const Way& b) { return a.slope > b.slope; });
    for (std::size_t i = 0; i < n_ways; ++i) join(here, ways[i].to, p);
  }

  /// After the last saddle: peaks that never met a higher one stand above the lowest point of
  /// what is connected.
  void decide_last_peaks() {
    std::vector<PixelIndex> lowest = ascents_.peaks;
    for (PixelIndex p = 0; p < relief_.n_pixels(); ++p) {
      if (label()[p] != kNoMotif) {
        PixelIndex& low = lowest[area_of(label()[p])];
        if (relief_(p) < relief_(low)) low = p;
      }
    }
    for (std::uint32_t i = 0; i < branches_.size(); ++i) {
      if (branches_[i].area == i && too_low(height_of(i) - relief_(lowest[i]))) {
        branches_[i].hill = kNoMotif;
      }
    }
  }

  /// Numbers the hills that stand and relabels the pixels. The tree is of no use afterwards.
  Segmentation standing_hills() && {
    for (std::uint32_t i = 0; i < branches_.size(); ++i) branches_[i].hill = hill_of(i);
    std::uint32_t n_motifs = 0;
    for (std::uint32_t i = 0; i < branches_.size(); ++i) {
      branches_[i].area = branches_[i].hill == i ? n_motifs++ : kNoMotif;  // now its new number
    }
    Segmentation result;
    result.label = std::move(ascents_.label);
    for (auto& label : result.label) {
      const auto hill = label == kNoMotif ? kNoMotif : branches_[label].hill;
      label = hill == kNoMotif ? kNoMotif : branches_[hill].area;
    }
    result.motifs.reserve(n_motifs);
    for (std::uint32_t i = 0; i < branches_.size(); ++i) {
      if (branches_[i].hill == i) {
        result.motifs.push_back({.extremum = ascents_.peaks[i], .saddle = branches_[i].saddle});
      }
    }
    return result;
  }

 private:
  /// One per peak, the highest first. Links end at themselves.
  struct Branch {
    std::uint32_t area;  ///< a higher peak of the same connected area
    std::uint32_t hill;  ///< the hill this one became part of
    PixelIndex saddle;
  };

  double height_of(std::uint32_t peak) const { return relief_(ascents_.peaks[peak]); }
  bool too_low(double difference) const {
    return difference < least_difference_ || difference == 0;
  }

  void join(std::uint32_t here, std::uint32_t there, PixelIndex saddle) {
    const auto area_here = area_of(here), area_there = area_of(there);
    if (area_here == area_there) return;
    const auto lower = std::max(area_here, area_there);  // higher peaks have smaller numbers
    if (too_low(height_of(lower) - relief_(saddle))) {
      branches_[lower].hill = lower == area_here ? there : here;
    } else {
      for (const auto hill : {hill_of(here), hill_of(there)}) {
        if (branches_[hill].saddle == kNoPixel) branches_[hill].saddle = saddle;
      }
    }
    branches_[lower].area = std::min(area_here, area_there);
  }

  std::uint32_t area_of(std::uint32_t peak) { return end_of<&Branch::area>(peak); }
  std::uint32_t hill_of(std::uint32_t peak) { return end_of<&Branch::hill>(peak); }

  /// Follows links to their end, halving the way for the next time.
  template <std::uint32_t Branch::*link>
  std::uint32_t end_of(std::uint32_t i) {
    while (i != kNoMotif && branches_[i].*link != i) {
      const auto next = branches_[i].*link;
      if (next != kNoMotif) branches_[i].*link = branches_[next].*link;
      i = branches_[i].*link;
    }
    return i;
  }

  const Relief& relief_;
  Ascents ascents_;
  double least_difference_;
  std::vector<Branch> branches_;
};

/// Areas, volumes and what touches the edge or a hole, pixel by pixel in their order.
void measure(const Relief& relief, Segmentation& segmentation) {
  const Index nx = relief.map.height.cols();
  const double pixel_area = relief.map.grid.pixel_area();
  for (PixelIndex p = 0; p < relief.n_pixels(); ++p) {
    go_on_or_throw(p);
    if (segmentation.label[p] == kNoMotif) continue;
    Motif& motif = segmentation.motifs[segmentation.label[p]];
    ++motif.n_pixels;
    const bool complete = relief.neighbours.complete(p / nx, p % nx);
    motif.closed = motif.closed && complete;
    if (relief(p) == relief(motif.extremum)) {
      motif.inner_extremum = motif.inner_extremum && complete;
    }
    if (motif.saddle != kNoPixel) {
      motif.volume += std::max(0.0, relief(p) - relief(motif.saddle)) * pixel_area;
    }
  }
}

constexpr std::size_t kPixelsPerReport = std::size_t{1} << 18U;

}  // namespace

Segmentation segment(const topography::Topography& topography, MotifKind kind,
                     double least_difference, const Observer& observer) {
  if (topography.height.size() >= static_cast<Index>(kPixelLimit)) {
    throw InputError("segmentation into hills and dales",
                     fmt::format("{} pixels", topography.height.size()),
                     fmt::format("fewer than {}", kPixelLimit), "crop or resample the map");
  }
  const std::string_view stage = kind == MotifKind::hill ? "hills" : "dales";
  Watch watch(observer, stage);
  const Relief relief(topography, kind);
  go_on_or_throw();
  ChangeTree tree(relief, climb(relief), least_difference);
  watch.tell(0.25);
  {
    const Borders borders(relief, tree.label());
    for (std::size_t i = 0; i < borders.size(); ++i) {
      if (i % kPixelsPerReport == 0) {
        watch.tell(0.5 + 0.4 * static_cast<double>(i) / static_cast<double>(borders.size()));
      }
      go_on_or_throw(i);
      tree.meet_at(borders[i]);
    }
  }
  go_on_or_throw();
  tree.decide_last_peaks();
  go_on_or_throw();
  Segmentation result = std::move(tree).standing_hills();
  measure(relief, result);
  return result;
}

}  // namespace tabor::metrology
