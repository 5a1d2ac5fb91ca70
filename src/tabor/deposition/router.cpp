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

bool Router::holds(Target at, const FlowPath& path) {
  return valid(path) &&
         (!is_cut(at) || n_open_[static_cast<std::size_t>(at)] == pools_.n_open_siblings(at));
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
    ++n_looks_;
    if (Slopes::is_pool(at)) {
      at = pools_.holder(at);
      if (!pools_[at].full()) {
        record(at);
        return at;
      }
    }
    if (const FlowPath path = slopes_.path_from(pools_, at); holds(at, path)) {
      if (is_cut(at)) {
        record(at);
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

/// Pools get new numbers: paths from cuts are found anew.
void Router::forget_cuts() {
  for (std::size_t id = 0; id < is_cut_.size(); ++id) {
    if (is_cut_[id]) pools_.remember_overflow(static_cast<PoolId>(id), {});
  }
  is_cut_ = {};
  n_open_ = {};
}

void Router::settle() {
  forget_cuts();
  const std::vector<PoolId> renamed = pools_.renumber();
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
  if (is_cut_.empty()) {
    is_cut_.resize(pools_.count(), false);
    n_open_.resize(pools_.count());
  }
  is_cut_[static_cast<std::size_t>(full)] = true;
  n_open_[static_cast<std::size_t>(full)] = pools_.n_open_siblings(full);
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
