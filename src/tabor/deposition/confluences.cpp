#include "tabor/deposition/confluences.hpp"

#include <utility>

#include "tabor/core/watch.hpp"

namespace tabor::deposition {
namespace {

constexpr Slopes::Target kUnknown = std::numeric_limits<Slopes::Target>::min();
constexpr Slopes::Target kAhead = 16;  // how many forks ahead their pools are prefetched

}  // namespace

Confluences::Confluences(const Slopes& slopes, const Pools& pools)
    : slopes_(slopes),
      pools_(pools),
      n_pools_(pools.count()),
      next_(pools.count() + slopes.n_forks(), kUnknown) {
  const auto n_pools = static_cast<PoolId>(pools.count());
  const auto n_forks = static_cast<Target>(slopes.n_forks());
  for (Target number = 0; number < n_forks; ++number) {  // in the order of memory, as their pools
    go_on_or_throw(static_cast<std::size_t>(number));
    if (number + kAhead < n_forks) prefetch_pools(~(number + kAhead));
    explore(~number);
  }
  for (PoolId id = 0; id < n_pools; ++id) {
    go_on_or_throw(static_cast<std::size_t>(id));
    explore(id);
  }
  for (Target number = 0; number < n_forks; ++number) last(~number);
  for (PoolId id = 0; id < n_pools; ++id) last(id);
}

void Confluences::prefetch_pools(Target fork) const {
  for (const Slopes::Branch& branch : slopes_.branches(fork)) pools_.prefetch(branch.pool);
}

/// The end of the chain of places from `at`, with path compression.
Confluences::Target Confluences::last(Target at) {
  Target end = at;
  while (next(end) != end) end = next(end);
  while (at != end) at = std::exchange(next(at), end);
  return end;
}

/// Depth first, without recursion: paths are as long as the surface has pools.
void Confluences::explore(Target start) {
  if (next(start) != kUnknown) return;
  enter(start);
  while (!visits_.empty()) {
    Visit& visit = visits_.back();
    if (visit.place == successors_.size()) {
      leave();
    } else if (const Target ahead = successors_[visit.place++]; next(ahead) == kUnknown) {
      enter(ahead);
    }
  }
}

void Confluences::enter(Target at) {
  next(at) = at;
  const std::size_t begin = successors_.size();
  visits_.push_back({at, begin, begin});
  if (Slopes::is_pool(at)) {
    add_overflow(at);
  } else {
    add_branches(at);
  }
}

/// Successors that lead back here are no choice: no droplet runs in circles.
void Confluences::leave() {
  const auto [at, begin, end] = visits_.back();
  visits_.pop_back();
  Target meeting = at;
  for (std::size_t i = begin; i < end; ++i) {
    const Target ahead = last(successors_[i]);
    if (ahead == at || ahead == meeting) continue;
    if (meeting != at) {  // two places: the paths part here
      meeting = at;
      break;
    }
    meeting = ahead;
  }
  next(at) = meeting;
  successors_.resize(begin);
}

/// On a dry saddle of several pixels (Slopes::Fork) and from a pool that is full up to one there
/// are no known successors: paths may part there.
void Confluences::add_branches(Target fork) {
  const auto branches = slopes_.branches(fork);
  for (const Slopes::Branch& branch : branches) {
    const Pool& pool = pools_[branch.pool];
    if (pool.level < branch.height) {
      if (branches.size() > 1) successors_.push_back(branch.leads_to);
      continue;
    }
    // The water of a full pool at its own saddle is as high as the saddle: nothing flows back.
    const Pixel saddle = pool.spills() ? pools_.saddle(branch.pool) : kSeveral;
    const bool spills_here = saddle != kSeveral && slopes_.from(saddle) == fork;
    if (!spills_here) successors_.push_back(branch.pool);
  }
}

void Confluences::add_overflow(PoolId full) {
  const Pixel saddle = pools_[full].spills() ? pools_.saddle(full) : kSeveral;
  if (saddle != kSeveral) successors_.push_back(slopes_.from(saddle));
}

}  // namespace tabor::deposition
