#include "tabor/deposition/router.hpp"

#include <algorithm>

#include "tabor/numerics/disjoint_sets.hpp"

namespace tabor::deposition {
namespace {

std::int32_t place_of(Pixel p, std::span<const Pixel> sorted) {
  return static_cast<std::int32_t>(std::lower_bound(sorted.begin(), sorted.end(), p) -
                                   sorted.begin());
}

}  // namespace

void Router::Choice::consider(const Candidate& candidate) {
  const bool same_pool = candidate.wet_by != kNoPool && candidate.wet_by == best.wet_by;
  const Candidate other = candidate.before(best) ? best : candidate;
  if (candidate.before(best)) best = candidate;
  if (!same_pool) doubt = std::min(doubt, other.height);
}

Router::Candidate Router::candidate(Pixel q) {
  if (q == kOutside) return {kDry, kOutside, kNoPool};
  const PoolId pool = pools_.owner(pools_.pool_at(q));
  const Height level = pools_[pool].level;
  const Height solid = pools_.height(q);
  return solid <= level ? Candidate{level, q, pool} : Candidate{solid, q, kNoPool};
}

Router::Target Router::toward(const Candidate& candidate) const {
  if (candidate.wet_by != kNoPool) return candidate.wet_by;
  return candidate.pixel == kOutside ? kOcean : slopes_.from(candidate.pixel);
}

bool Router::valid(const FlowPath& path) {
  return path.bound != kDry && pools_[pools_.owner(path.end)].level < path.bound;
}

void Router::prefetch(Target start) const {
  if (Slopes::is_pool(start)) {
    pools_.prefetch(start);
  } else {
    slopes_.prefetch_fork(start);
  }
}

void Router::prefetch_end(Target start) const {
  const bool stays = Slopes::is_pool(start) && !pools_[start].spills();
  pools_.prefetch(stays ? pools_[start].owner : slopes_.path_from(pools_, start).end);
}

PoolId Router::follow(Target at) {
  while (true) {
    if (Slopes::is_pool(at)) {
      at = pools_.holder(at);
      if (!pools_[at].full()) {
        record(at);
        return at;
      }
    }
    if (const FlowPath path = slopes_.path_from(pools_, at); valid(path)) {
      trail_.push_back({at, path.bound});
      at = path.end;
    } else if (!Slopes::is_pool(at)) {
      at = take_branch(at);
    } else {
      const PoolId owner = pools_.owner(at);
      at = owner == at ? spill(at) : owner;
    }
  }
}

void Router::settle() {
  const std::vector<PoolId> renamed = pools_.renumber();
  slopes_.settle(pools_, renamed);
  saddles_.clear();
}

Router::Target Router::spill(PoolId full) {
  if (const Pixel saddle = pools_.saddle(full); saddle != kSeveral) {
    trail_.push_back({full, kNoRim});
    return slopes_.from(saddle);
  }
  record(full);
  return drain_of_saddle(pools_[full].parent, full, kOutside);
}

/// The lowest branch as the levels stand. Under water all branches belong to one pool: that one.
Router::Target Router::take_branch(Target fork) {
  const auto branches = slopes_.branches(fork);
  if (branches.size() == 1) {
    const Slopes::Branch& on = branches.front();
    const PoolId above = pools_.owner(on.pool);
    trail_.clear();
    return pools_[above].level >= on.height ? above : drain_of_saddle(on.pool, kNoPool, on.pixel);
  }
  Height lowest = kNoRim;
  Height doubt = kNoRim;
  Target target = kNoPool;
  for (Slopes::Branch& branch : branches) {
    const PoolId pool = branch.pool = pools_.owner(branch.pool);
    const Height level = pools_[pool].level;
    const bool wet = level >= branch.height;
    const Height height = wet ? level : branch.height;
    const Target to = wet ? pool : branch.leads_to;
    if (height < lowest) {
      doubt = wet && to == target ? doubt : lowest;
      lowest = height;
      target = to;
    } else if (!(wet && to == target)) {
      doubt = std::min(doubt, height);
    }
  }
  trail_.push_back({fork, doubt});
  return target;
}

/// The trail up to here leads to `end`, and is valid below the lowest bound on it.
void Router::record(PoolId end) {
  Height bound = kNoRim;
  for (std::size_t i = trail_.size(); i-- > 0;) {
    bound = std::min(bound, trail_[i].bound);
    if (Slopes::is_pool(trail_[i].from)) {
      pools_.remember_overflow(trail_[i].from, {end, bound});
    } else {
      slopes_.remember(trail_[i].from, {end, bound});
    }
  }
  trail_.clear();
}

Router::Target Router::drain_of_saddle(PoolId above, PoolId full, Pixel on) {
  Saddle& saddle = saddles_[above];
  for (bool fresh = false;; fresh = true) {
    if (fresh || saddle.open_children != pools_[above].open_children) saddle = find_regions(above);
    const std::int32_t place =
        full == kNoPool ? place_of(on, pools_.bottom(above)) : saddle.region_of_full.at(full);
    const auto region = static_cast<std::size_t>(saddle.region_of[static_cast<std::size_t>(place)]);
    const Choice& drain = saddle.drain[region];
    const Candidate now = candidate(drain.best.pixel);
    if (fresh || now.height == drain.best.height || now.height < drain.doubt) return toward(now);
  }
}

Router::Saddle Router::find_regions(PoolId above) {
  const auto pixels = pools_.bottom(above);
  const Height height = pools_.height(pixels.front());
  Saddle saddle{pools_[above].open_children, {}, {}, std::vector<Choice>(pixels.size())};
  numerics::DisjointSets<std::int32_t> regions(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const auto here = static_cast<std::int32_t>(i);
    for_each_neighbour(pools_.terrain(), pixels[i], [&](Pixel q) {
      const Candidate next = candidate(q);
      if (next.height == height && next.wet_by == kNoPool) {
        regions.join(here, place_of(q, pixels));
      } else if (next.height == height) {
        regions.join(here, saddle.region_of_full.try_emplace(next.wet_by, here).first->second);
      }
    });
  }
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    saddle.region_of.push_back(regions.root(static_cast<std::int32_t>(i)));
    Choice& drain = saddle.drain[static_cast<std::size_t>(saddle.region_of.back())];
    for_each_neighbour(pools_.terrain(), pixels[i], [&](Pixel q) {
      if (const Candidate next = candidate(q); next.height < height) drain.consider(next);
    });
  }
  return saddle;
}

}  // namespace tabor::deposition
