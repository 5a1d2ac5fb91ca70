#include "tabor/deposition/scouts.hpp"

namespace tabor::deposition {

void Scouts::advance(const Pixel* starts) {
  for (std::size_t i = kAhead; i < kAhead + kBlock; ++i) slopes_.prefetch(starts[i]);
  ++first_;
  land(block(8), starts + 8 * kBlock);
  run(block(7));
  judge(block(6));
  leave(block(5));
  cross(block(4));
  run(block(3));
  judge(block(2));
  leave(block(1));
}

/// On the slope under its start.
void Scouts::land(Block& block, const Pixel* starts) const {
  block.clear();
  for (std::size_t i = 0; i < kBlock; ++i) {
    const Target at = slopes_.from(starts[i]);
    block.keep({at, at});
    prefetch(at);
  }
}

/// To where the droplet before it ran.
void Scouts::run(Block& block) const {
  for (Scout& scout : block.all()) {
    scout.at = next(scout.at);
    prefetch(scout.at);
  }
}

/// Keeps those whose way has expired.
void Scouts::judge(Block& block) const {
  const auto judged = block.all();
  block.clear();
  for (const Scout& scout : judged) {
    const Target end = next(scout.at);
    prefetch(end);
    const bool is_way = !Slopes::is_pool(scout.from) || pools_[scout.from].full();
    if (is_way && pools_[scout.at].level >= slopes_.way_from(pools_, scout.from).bound) {
      block.keep(scout);
    }
  }
}

/// A fork asks for the pools on its branches, a full pool for the slope under its saddle.
void Scouts::leave(Block& block) const {
  const auto leaving = block.all();
  block.clear();
  for (const Scout& scout : leaving) {
    if (!Slopes::is_pool(scout.from)) {
      for (const Slopes::Branch& branch : slopes_.branches(scout.from)) {
        pools_.prefetch(branch.home);
      }
    } else if (const Pixel saddle = pools_.saddle(scout.from); saddle != kSeveral) {
      slopes_.prefetch(saddle);
      block.keep({scout.from, saddle});
    }
  }
}

void Scouts::cross(Block& block) const {
  for (Scout& scout : block.all()) {
    scout.from = scout.at = slopes_.from(scout.at);
    prefetch(scout.at);
  }
}

Scouts::Target Scouts::next(Target at) const {
  if (!Slopes::is_pool(at)) return slopes_.way_from(pools_, at).end;
  const Pool& pool = pools_[at];
  return pool.owner == at && pool.full() ? pool.overflow().end : pool.owner;
}

void Scouts::prefetch(Target target) const {
  if (Slopes::is_pool(target)) {
    pools_.prefetch(target);
  } else {
    slopes_.prefetch_fork(target);
  }
}

}  // namespace tabor::deposition
