#include "tabor/deposition/basins.hpp"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "tabor/core/large_pages.hpp"
#include "tabor/core/rows.hpp"

namespace tabor::deposition {
namespace {

/// Which of the eight pixels around one are lower, a bit each: clockwise from the one above.
using Ring = std::uint8_t;
constexpr int kRing = 8;
constexpr Ring kNeighbours = 0b01010101;

constexpr bool has(int ring, int place) { return (ring >> (place % kRing) & 1) != 0; }

/// Returns the number of groups in which the lower ones of the four neighbours are connected by
/// lower pixels of the ring.
constexpr int n_groups(int ring) {
  if (ring == 0xFF) return 1;
  int first_gap = 0;
  while (has(ring, first_gap)) ++first_gap;
  int n = 0;
  bool has_neighbour = false;
  for (int place = first_gap; place <= first_gap + kRing; ++place) {
    if (has(ring, place)) {
      has_neighbour = has_neighbour || place % 2 == 0;
    } else {
      n += has_neighbour ? 1 : 0;
      has_neighbour = false;
    }
  }
  return n;
}

constexpr auto kIsSaddle = [] {
  std::array<bool, 256> is_saddle{};
  for (int ring = 0; ring < 256; ++ring) {
    is_saddle[static_cast<std::size_t>(ring)] = n_groups(ring) > 1;
  }
  return is_saddle;
}();

/// What is seen from one pixel.
struct View {
  Ring lower = 0;
  Pixel downhill = 0;  ///< the lowest neighbour if it is lower, else the pixel itself
};

class Finder {
 public:
  explicit Finder(const Terrain& terrain)
      : terrain_(terrain), parts_(static_cast<std::size_t>(terrain.ny / kRowsPerBlock + 1)) {}

  Basins run() {
    basins_.of_pixel.resize(static_cast<std::size_t>(terrain_.size()));
    for_each_row(terrain_.ny, [&](Index row) { look_along(row); });
    number_bottoms();
    for_each_row(terrain_.ny, [&](Index row) { drain(row); });
    return std::move(basins_);
  }

 private:
  /// What a few rows hold.
  struct Part {
    std::vector<Rank> bottoms;
    std::vector<Rank> saddles;
  };

  Height height(Pixel p) const { return terrain_.height[static_cast<std::size_t>(p)]; }

  /// Stores one step of each pixel as the complement of the next one.
  void look_along(Index row) {
    Part& part = parts_[static_cast<std::size_t>(row / kRowsPerBlock)];
    const Pixel nx = terrain_.nx;
    const auto first = static_cast<Pixel>(row * nx);
    const bool is_inside = row > 0 && row + 1 < terrain_.ny;
    for (Pixel p = first; p < first + nx; ++p) {
      const bool is_on_border = !is_inside || p == first || p == first + nx - 1;
      const View view = is_on_border ? view_on_border(p) : view_inside(p);
      if ((view.lower & kNeighbours) == 0) part.bottoms.push_back(rank_of(height(p), p));
      if (kIsSaddle[view.lower]) part.saddles.push_back(rank_of(height(p), p));
      basins_.of_pixel[static_cast<std::size_t>(p)] =
          view.downhill == kOutside ? kOcean : ~view.downhill;
    }
  }

  /// Pixels before this one have smaller numbers: where they are as high, they count as lower.
  View view_inside(Pixel p) const {
    const Height* const at = &terrain_.height[static_cast<std::size_t>(p)];
    const std::ptrdiff_t nx = terrain_.nx;
    const Height here = *at;
    const Height above = at[-nx], left = at[-1], right = at[1], below = at[nx];
    View view;
    view.lower = static_cast<Ring>((above <= here) | (at[-nx + 1] <= here) << 1 |
                                   (right < here) << 2 | (at[nx + 1] < here) << 3 |
                                   (below < here) << 4 | (at[nx - 1] < here) << 5 |
                                   (left <= here) << 6 | (at[-nx - 1] <= here) << 7);
    std::ptrdiff_t step = above <= here ? -nx : 0;
    Height lowest = above <= here ? above : here;
    const bool goes_left = left < lowest || (left == lowest && step == 0);
    step = goes_left ? -1 : step;
    lowest = goes_left ? left : lowest;
    step = right < lowest ? 1 : step;
    lowest = right < lowest ? right : lowest;
    step = below < lowest ? nx : step;
    view.downhill = static_cast<Pixel>(p + step);
    return view;
  }

  View view_on_border(Pixel p) const {
    constexpr std::array<std::array<int, 2>, kRing> kAround{
        {{0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}}};
    View view{.downhill = p};
    for (std::size_t place = 0; place < kRing; ++place) {
      const Pixel q = beside(p, kAround[place][0], kAround[place][1]);
      view.lower = static_cast<Ring>(view.lower | (is_lower(q, p) ? 1 << place : 0));
      if (place % 2 == 0 && is_lower(q, view.downhill)) view.downhill = q;
    }
    return view;
  }

  /// The pixel `dx` columns and `dy` rows from p, at most one; p itself where there is none.
  Pixel beside(Pixel p, int dx, int dy) const {
    const Pixel row = p / terrain_.nx + dy;
    const Pixel column = p % terrain_.nx + dx;
    const bool is_inside = row >= 0 && row < terrain_.ny && column >= 0 && column < terrain_.nx;
    if (is_inside) return row * terrain_.nx + column;
    if (terrain_.edge == Edge::closed) return p;
    if (terrain_.edge == Edge::open) return kOutside;
    return (row + terrain_.ny) % terrain_.ny * terrain_.nx + (column + terrain_.nx) % terrain_.nx;
  }

  Rank rank(Pixel p) const { return p == kOutside ? kOceanRank : rank_of(height(p), p); }
  bool is_lower(Pixel a, Pixel b) const { return rank(a) < rank(b); }

  void number_bottoms() {
    std::size_t n_bottoms = 1;
    std::size_t n_saddles = 0;
    for (const Part& part : parts_) {
      n_bottoms += part.bottoms.size();
      n_saddles += part.saddles.size();
    }
    basins_.bottoms.reserve(n_bottoms);
    basins_.saddles.reserve(n_saddles);
    if (terrain_.edge == Edge::open) basins_.bottoms.push_back(kOceanRank);
    for (Part& part : parts_) {
      for (const Rank bottom : part.bottoms) {
        basins_.of_pixel[static_cast<std::size_t>(pixel_of(bottom))] =
            static_cast<PoolId>(basins_.bottoms.size());
        basins_.bottoms.push_back(bottom);
      }
      basins_.saddles.insert(basins_.saddles.end(), part.saddles.begin(), part.saddles.end());
      release(part.bottoms);
      release(part.saddles);
    }
  }

  /// Goes all steps from each pixel. Several threads may come by the same pixels; they find the
  /// same end.
  void drain(Index row) {
    const auto basin = [this](Pixel p) {
      return std::atomic_ref<PoolId>(basins_.of_pixel[static_cast<std::size_t>(p)]);
    };
    const auto step = [&](Pixel p) { return basin(p).load(std::memory_order_relaxed); };
    const auto first = static_cast<Pixel>(row * terrain_.nx);
    for (Pixel start = first; start < first + terrain_.nx; ++start) {
      PoolId end = step(start);
      while (end < 0) end = step(~end);
      Pixel p = start;
      for (PoolId next = step(p); next < 0; next = step(p)) {
        basin(p).store(end, std::memory_order_relaxed);
        p = ~next;
      }
    }
  }

  const Terrain& terrain_;
  std::vector<Part> parts_;
  Basins basins_;
};

}  // namespace

Basins find_basins(const Terrain& terrain) { return Finder(terrain).run(); }

}  // namespace tabor::deposition
