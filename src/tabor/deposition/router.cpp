#include "tabor/deposition/router.hpp"

#include <algorithm>

namespace tabor::deposition {
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
  cuts_.follow_pools();
  passed_.clear();
  while (true) {
    ++n_looks_;
    if (Slopes::is_pool(at)) {
      at = pools_.holder(at);
      if (!pools_[at].full()) {
        record(at);
        cuts_.join(passed_);
        return at;
      }
    }
    const bool is_cut = Slopes::is_pool(at) && cuts_.has(at);
    if (is_cut && valid(cuts_.whole(at))) {
      record(at);
      at = cuts_.whole(at).end;
      continue;
    }
    if (const FlowPath path = slopes_.path_from(pools_, at); valid(path)) {
      if (is_cut) {
        record(at);
        passed_.push_back(at);
      } else {
        trail_.push_back({at, path.bound});
      }
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
  cuts_.forget();
  const std::vector<PoolId> renamed = pools_.renumber();
  descent_.renumber(renamed, pools_.count());
  slopes_.settle(pools_, renamed);
  saddles_.forget();
}

Router::Target Router::spill(PoolId full) {
  if (const Pixel saddle = pools_.saddle(full); saddle != kSeveral) {
    trail_.push_back({full, kNoRim});
    return slopes_.from(saddle);
  }
  record(full);
  const Drain drain = saddles_.drain_of_child(pools_[full].parent, full);
  cuts_.cut(full);
  passed_.push_back(full);
  pools_.remember_overflow(full, {});  // until it is known where this one ends
  trail_.push_back({full, drain.doubt});
  return toward(drain.lowest);
}

/// The lowest branch as the levels stand. Under water all branches belong to one pool: that one.
Router::Target Router::take_branch(Target fork) {
  const auto branches = slopes_.branches(fork);
  n_looks_ += static_cast<std::int64_t>(branches.size());
  if (branches.size() == 1) {
    const Slopes::Branch& on = branches.front();
    const PoolId above = pools_.owner(on.pool);
    trail_.clear();
    return pools_[above].level >= on.height ? above
                                            : toward(saddles_.drain_of_pixel(on.pool, on.pixel));
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

}  // namespace tabor::deposition
