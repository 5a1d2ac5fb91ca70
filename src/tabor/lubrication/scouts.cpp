#include "tabor/lubrication/scouts.hpp"

namespace tabor::lubrication {

void Scouts::advance(const Pixel* starts, std::size_t k) {
  std::size_t droplet = k + kAhead;
  slopes_.prefetch(starts[droplet]);
  droplet -= kStride;
  Scout& fresh = ring_[droplet % ring_.size()];
  fresh.task = Task::look;
  go_to(fresh, slopes_.from(starts[droplet]));
  for (droplet -= kStride; droplet > k; droplet -= kStride) {
    step(ring_[droplet % ring_.size()]);
  }
}

void Scouts::step(Scout& scout) const {
  if (scout.task == Task::choose) {
    scout.task = Task::look;
    if (Slopes::is_pool(scout.from)) {
      const Pixel saddle = pools_.saddle(scout.from);
      go_to(scout, saddle < 0 ? scout.at : slopes_.from(saddle));
    } else {
      for (const Slopes::Branch& branch : slopes_.branches(scout.from)) {
        go_to(scout, branch.home);
      }
    }
    return;
  }
  if (scout.task == Task::judge &&
      pools_[scout.at].level >= slopes_.way_from(pools_, scout.from).bound) {
    scout.task = Task::choose;
    if (!Slopes::is_pool(scout.from)) {
      __builtin_prefetch(slopes_.branches(scout.from).data());
    } else if (const Pixel saddle = pools_.saddle(scout.from); saddle != kSeveral) {
      slopes_.prefetch(saddle);
    }
    return;
  }
  look(scout);
}

void Scouts::look(Scout& scout) const {
  const Slopes::Target at = scout.at;
  scout.task = Task::look;
  if (Slopes::is_pool(at)) {
    const Pool& pool = pools_[at];
    if (pool.owner != at) {
      go_to(scout, pool.owner);
      return;
    }
    if (!pool.full()) {
      return;
    }
  }
  scout.from = at;
  scout.task = Task::judge;
  go_to(scout, slopes_.way_from(pools_, at).end);
}

void Scouts::go_to(Scout& scout, Slopes::Target target) const {
  scout.at = target;
  if (Slopes::is_pool(target)) {
    pools_.prefetch(target);
  } else {
    slopes_.prefetch_fork(target);
  }
}

}  // namespace tabor::lubrication
