#include "tabor/deposition/naive.hpp"

#include <algorithm>
#include <numeric>

namespace tabor::deposition {
namespace {

constexpr std::int64_t kBelowEverything = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kAboveEverything = std::numeric_limits<std::int64_t>::max();

}  // namespace

NaiveRain::NaiveRain(Terrain terrain, Reading reading)
    : terrain_(std::move(terrain)),
      reading_(reading),
      level_(terrain_.height.begin(), terrain_.height.end()),
      remainder_(terrain_.height.size(), 0) {}

NaiveRain::Place NaiveRain::place(Pixel p) const {
  if (p == kOutside) return {kBelowEverything, kOutside};
  return {level_[static_cast<std::size_t>(p)], p};
}

NaiveRain::Place NaiveRain::lowest_neighbour(Pixel p) const {
  Place lowest{kAboveEverything, 0};
  for_each_neighbour(terrain_, p, [&](Pixel q) { lowest = std::min(lowest, place(q)); });
  return lowest;
}

std::vector<Pixel> NaiveRain::region_of(Pixel p) const {
  std::vector<Pixel> region{p};
  std::vector<bool> seen(level_.size(), false);
  seen[static_cast<std::size_t>(p)] = true;
  for (std::size_t i = 0; i < region.size(); ++i) {
    for_each_neighbour(terrain_, region[i], [&](Pixel q) {
      if (place(q).level == place(p).level && !seen[static_cast<std::size_t>(q)]) {
        seen[static_cast<std::size_t>(q)] = true;
        region.push_back(q);
      }
    });
  }
  return region;
}

NaiveRain::Place NaiveRain::lowest_around(const std::vector<Pixel>& region) const {
  const std::int64_t level = place(region.front()).level;
  Place lowest{kAboveEverything, 0};
  for (const Pixel p : region) {
    for_each_neighbour(terrain_, p, [&](Pixel q) {
      if (place(q).level != level) lowest = std::min(lowest, place(q));
    });
  }
  return lowest;
}

Volume NaiveRain::fill(const std::vector<Pixel>& region, std::int64_t rim, Volume carried) {
  const auto keeper = static_cast<std::size_t>(*std::min_element(region.begin(), region.end()));
  const auto area = static_cast<Volume>(region.size());
  const std::int64_t level = level_[keeper];
  const Volume total = remainder_[keeper] + carried;
  const bool fits = rim == kAboveEverything || total < (rim - level) * area;
  const std::int64_t rise = fits ? total / area : rim - level;
  for (const Pixel p : region) level_[static_cast<std::size_t>(p)] += rise;
  remainder_[keeper] = fits ? total % area : 0;
  return fits ? 0 : total - rise * area;
}

Volume NaiveRain::fill_literally(const std::vector<Pixel>& region, std::int64_t rim,
                                 Height volume) {
  const std::int64_t level = place(region.front()).level;
  const std::int64_t rise =
      rim == kAboveEverything ? volume : std::min<std::int64_t>(volume, rim - level);
  for (const Pixel p : region) level_[static_cast<std::size_t>(p)] += rise;
  return rise * static_cast<Volume>(region.size());
}

Volume NaiveRain::drop(Pixel start, Height volume) {
  Pixel p = start;
  Volume carried = volume;
  while (carried > 0) {
    Place next = lowest_neighbour(p);
    if (next.level >= place(p).level) {
      const std::vector<Pixel> region = region_of(p);
      next = lowest_around(region);
      if (next.level > place(p).level) {
        if (reading_ == Reading::literal) return fill_literally(region, next.level, volume);
        carried = fill(region, next.level, carried);
        continue;  // from the same pixel: the region has grown, or it holds the whole droplet
      }
    }
    if (next.pixel == kOutside) {
      lost_ += carried;
      return volume;
    }
    p = next.pixel;
  }
  return volume;
}

Volume NaiveRain::remainders() const {
  return std::accumulate(remainder_.begin(), remainder_.end(), Volume{0});
}

}  // namespace tabor::deposition
