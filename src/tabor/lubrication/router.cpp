#include "tabor/lubrication/router.hpp"

#include <algorithm>
#include <numeric>

#include "tabor/lubrication/large_pages.hpp"

namespace tabor::lubrication {
namespace {

constexpr std::int32_t kVisited = std::numeric_limits<std::int32_t>::min();

/// Disjoint sets of 0..n-1.
class Sets {
 public:
  explicit Sets(std::size_t n) : up_(n) { std::iota(up_.begin(), up_.end(), 0); }
  std::int32_t root(std::int32_t i) {
    while (up_[static_cast<std::size_t>(i)] != i) {
      auto& up = up_[static_cast<std::size_t>(i)];
      up = up_[static_cast<std::size_t>(up)];
      i = up;
    }
    return i;
  }
  void unite(std::int32_t i, std::int32_t j) { up_[static_cast<std::size_t>(root(i))] = root(j); }

 private:
  std::vector<std::int32_t> up_;
};

std::int32_t place_of(Pixel p, std::span<const Pixel> sorted) {
  return static_cast<std::int32_t>(std::lower_bound(sorted.begin(), sorted.end(), p) -
                                   sorted.begin());
}

}  // namespace

Router::Router(Pools& pools) : pools_(pools) {
  const auto n = static_cast<std::size_t>(pools.terrain().size());
  reserve_large_pages(ways_, n);
  ways_.resize(n);
}

void Router::Choice::consider(const Candidate& candidate) {
  const bool same_pool = candidate.wet_by != kNoPool && candidate.wet_by == best.wet_by;
  const Candidate other = candidate.before(best) ? best : candidate;
  if (candidate.before(best)) {
    best = candidate;
  }
  if (!same_pool) {
    doubt = std::min(doubt, other.height);
  }
}

Router::Way Router::Choice::way(Height below) const {
  const Height bound = doubt < below ? doubt : kNoRim;
  if (best.wet_by != kNoPool) {
    return {best.wet_by, bound};
  }
  return {best.pixel == kOutside ? kOcean : toward(best.pixel), bound};
}

bool Router::valid(const Way& way) {
  if (way.bound == kDry) {
    return false;
  }
  const PoolId pool = is_pool(way.target) ? way.target : pools_.home(~way.target);
  return pools_[pools_.owner(pool)].level < way.bound;
}

Router::Candidate Router::candidate(Pixel q) {
  if (q == kOutside) {
    return {kDry, kOutside, kNoPool};
  }
  const PoolId pool = pools_.owner(pools_.home(q));
  const Height level = pools_[pool].level;
  const Height solid = pools_.height(q);
  return solid <= level ? Candidate{level, q, pool} : Candidate{solid, q, kNoPool};
}

Router::Choice Router::choose(Pixel p) {
  Choice choice;
  for_each_neighbour(pools_.terrain(), p, [&](Pixel q) { choice.consider(candidate(q)); });
  return choice;
}

PoolId Router::from_pixel(Pixel start) {
  const Way& way = ways_[static_cast<std::size_t>(start)];
  if (is_pool(way.target)) {
    const PoolId pool = pools_.owner(way.target);
    if (pools_[pool].level < way.bound && !pools_[pool].full()) {
      return pool;
    }
  }
  return follow(toward(start));
}

PoolId Router::follow(Target at) {
  trail_.clear();
  plateau_.clear();
  while (true) {
    if (is_pool(at)) {
      at = pools_.owner(at);
      if (!pools_[at].full()) {
        record(at);
        return at;
      }
      if (const Pixel saddle = pools_.saddle(at); saddle != kSeveral) {
        at = toward(saddle);
      } else {
        record(at);
        at = drain_of_saddle(pools_[at].parent, at, kOutside);
      }
      continue;
    }
    const Pixel p = ~at;
    const bool known = valid(ways_[static_cast<std::size_t>(p)]);
    const Way way = known ? ways_[static_cast<std::size_t>(p)] : step(p);
    if (way.target == at) {  // stationary on a saddle of equal heights: the way is cut here
      record(at);
      at = drain_of_saddle(pools_.home(p), kNoPool, p);
    } else {
      const bool doubtful = !known && way.bound < kNoRim;
      trail_.push_back({p, way.bound, plateau_.size(), doubtful});
      at = way.target;
    }
  }
}

/// One step of the rule from a pixel; a way to itself where equal heights join pools.
Router::Way Router::step(Pixel p) {
  if (const Candidate here = candidate(p); here.wet_by != kNoPool) {
    return {here.wet_by, kNoRim};
  }
  const Height height = pools_.height(p);
  const Choice choice = choose(p);
  if (choice.leads_below(height)) {
    return choice.way(height);
  }
  const PoolId home = pools_.home(p);
  if (!pools_[home].active() && pools_.height(pools_.bottom(home).front()) == height) {
    return {toward(p), kNoRim};
  }
  return across_plateau(p);
}

/// A dry plateau on a slope: all its pixels without a lower neighbour of their own go the same way.
Router::Way Router::across_plateau(Pixel p) {
  const Height height = pools_.height(p);
  const auto way_of = [&](Pixel q) -> Way& { return ways_[static_cast<std::size_t>(q)]; };
  std::vector<Pixel> plateau{p};
  way_of(p).target = kVisited;
  Choice choice;
  for (std::size_t i = 0; i < plateau.size(); ++i) {
    bool stationary = true;
    for_each_neighbour(pools_.terrain(), plateau[i], [&](Pixel q) {
      const Candidate next = candidate(q);
      if (next.height < height) {
        choice.consider(next);
        stationary = false;
      } else if (next.height == height && way_of(q).target != kVisited) {
        way_of(q).target = kVisited;
        plateau.push_back(q);
      }
    });
    if (stationary && i > 0) {
      plateau_.push_back(plateau[i]);
    }
  }
  for (const Pixel q : plateau) {
    way_of(q) = Way{};
  }
  return choice.way(height);
}

Router::Target Router::drain_of_saddle(PoolId above, PoolId full, Pixel on) {
  Saddle& saddle = saddles_[above];
  for (bool fresh = false;; fresh = true) {
    if (fresh || saddle.open_children != pools_[above].open_children) {
      saddle = find_regions(above);
    }
    const std::int32_t place =
        full == kNoPool ? place_of(on, pools_.bottom(above)) : saddle.region_of_full.at(full);
    const auto region = static_cast<std::size_t>(saddle.region_of[static_cast<std::size_t>(place)]);
    const Choice& drain = saddle.drain[region];
    const Candidate now = candidate(drain.best.pixel);
    if (fresh || now.height == drain.best.height || now.height < drain.doubt) {
      return Choice{now}.way(kNoRim).target;
    }
  }
}

Router::Saddle Router::find_regions(PoolId above) {
  const auto pixels = pools_.bottom(above);
  const Height height = pools_.height(pixels.front());
  Saddle saddle{pools_[above].open_children, {}, {}, std::vector<Choice>(pixels.size())};
  Sets regions(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const auto here = static_cast<std::int32_t>(i);
    for_each_neighbour(pools_.terrain(), pixels[i], [&](Pixel q) {
      const Candidate next = candidate(q);
      if (next.height == height && next.wet_by == kNoPool) {
        regions.unite(here, place_of(q, pixels));
      } else if (next.height == height) {
        regions.unite(here, saddle.region_of_full.try_emplace(next.wet_by, here).first->second);
      }
    });
  }
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    saddle.region_of.push_back(regions.root(static_cast<std::int32_t>(i)));
    Choice& drain = saddle.drain[static_cast<std::size_t>(saddle.region_of.back())];
    for_each_neighbour(pools_.terrain(), pixels[i], [&](Pixel q) {
      if (const Candidate next = candidate(q); next.height < height) {
        drain.consider(next);
      }
    });
  }
  return saddle;
}

/// The trail up to here leads to `target`, and is valid below the lowest bound on it.
void Router::record(Target target) {
  Height bound = kNoRim;
  for (std::size_t i = trail_.size(); i-- > 0;) {
    const Step& step = trail_[i];
    if (step.doubtful && is_pool(target)) {
      bound = std::min(bound, std::max(step.bound, bound_of_agreement(step.pixel, target, bound)));
    } else {
      bound = std::min(bound, step.bound);
    }
    const Way way{target, bound};
    ways_[static_cast<std::size_t>(step.pixel)] = way;
    for (std::size_t j = i == 0 ? 0 : trail_[i - 1].plateau_end; j < step.plateau_end; ++j) {
      ways_[static_cast<std::size_t>(plateau_[j])] = way;
    }
  }
  trail_.clear();
  plateau_.clear();
}

/// Where all lower neighbours of p are known to lead to the same pool, p does not care which of
/// them it prefers: the lowest of their bounds; kDry if they disagree, or are not known, or if p
/// has none because it lies on a plateau.
Height Router::bound_of_agreement(Pixel p, PoolId end, Height way_bound) {
  Height bound = way_bound;
  bool any = false;
  bool agree = true;
  const Height height = pools_.height(p);
  for_each_neighbour(pools_.terrain(), p, [&](Pixel q) {
    if (agree && candidate(q).height < height) {
      any = true;
      agree = known_end(q, bound) == end;
    }
  });
  return any && agree ? bound : kDry;
}

/// The pool that is not full which p is known to lead to, lowering `bound` by what that needs.
PoolId Router::known_end(Pixel p, Height& bound) {
  constexpr int most_hops = 8;  // an answer not worth more than that
  static_assert(kSeveral == kOutside);
  for (int hop = 0; hop < most_hops && p != kOutside; ++hop) {
    const Candidate here = candidate(p);
    const Way way =
        here.wet_by != kNoPool ? Way{here.wet_by, kNoRim} : ways_[static_cast<std::size_t>(p)];
    if (!is_pool(way.target) || !valid(way)) {
      return kNoPool;
    }
    bound = std::min(bound, way.bound);
    const PoolId pool = pools_.owner(way.target);
    if (!pools_[pool].full()) {
      return pool;
    }
    p = pools_.saddle(pool);
  }
  return kNoPool;
}

}  // namespace tabor::lubrication
