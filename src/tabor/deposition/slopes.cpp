#include "tabor/deposition/slopes.hpp"

#include <algorithm>
#include <unordered_set>

#include "tabor/core/large_pages.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/core/watch.hpp"
#include "tabor/deposition/confluences.hpp"
#include "tabor/deposition/descent.hpp"

namespace tabor::deposition {
namespace {

// What a pixel is known to lead to before that has been followed downhill, below all numbers of
// forks: nothing yet, a fork still to be made, or another pixel, as kFirstStep plus its number.
constexpr Slopes::Target kUnknown = std::numeric_limits<Slopes::Target>::min();
constexpr Slopes::Target kFork = kUnknown + 1;
constexpr Slopes::Target kFirstStep = kUnknown + 2;

}  // namespace

/// Fills in Slopes: follows every pixel downhill to what is known, a pool or a fork.
class SlopeFinder {
 public:
  SlopeFinder(Slopes& result, const Pools& pools, const Descent& descent)
      : to_(result), pools_(pools), descent_(descent) {}

  void find() {
    const Pixel n = pools_.terrain().size();
    first_known_ = kFirstStep + n;
    reserve_large_pages(to_.leads_to_, static_cast<std::size_t>(n));
    to_.leads_to_.resize(static_cast<std::size_t>(n));
    choose_everywhere();
    for (Pixel start = 0; start < n; ++start) {
      go_on_or_throw(static_cast<std::size_t>(start));
      path_.clear();
      Pixel p = start;
      while (p != kOutside && known(p) < first_known_) p = pass(p);
      const Slopes::Target target = p == kOutside ? kOcean : known(p);
      for (const Pixel passed : path_) known(passed) = target;
    }
    for (std::size_t number = 0; number < to_.forks_.size(); ++number) {
      const auto branches = to_.branches(~static_cast<Slopes::Target>(number));
      for (Slopes::Branch& branch : branches) {
        if (branches.size() > 1) branch.leads_to = known(branch.pixel);
      }
    }
  }

 private:
  Slopes::Target& known(Pixel p) { return to_.leads_to_[static_cast<std::size_t>(p)]; }

  Height height(Pixel p) const { return p == kOutside ? kDry : pools_.height(p); }
  PoolId pool_at(Pixel p) const { return p == kOutside ? kOcean : pools_.pool_at(p); }

  /// Finds for each pixel with lower neighbours which one it leads to, or that it is a fork, and
  /// reserves memory for the forks.
  void choose_everywhere() {
    const Pixel nx = pools_.terrain().nx;
    const auto counts = sum_over_rows<2>(pools_.terrain().ny, [&](Index row) {
      Eigen::Array2d n = Eigen::Array2d::Zero();  // forks, and branches of those that have not two
      std::vector<Pixel> lower;
      for (Pixel p = static_cast<Pixel>(row) * nx, end = p + nx; p < end; ++p) {
        lower.clear();
        add_lower_neighbours(p, lower);
        known(p) = lower.empty() ? kUnknown : choice(lower);
        if (known(p) != kFork) continue;
        n += Eigen::Array2d(1, lower.size() == 2 ? 0 : static_cast<double>(lower.size()));
      }
      return n;
    });
    reserve_large_pages(to_.forks_, static_cast<std::size_t>(counts[0]));
    reserve_large_pages(to_.branches_, static_cast<std::size_t>(counts[1]));
  }

  /// Puts p on the path and returns the next pixel, or makes p known and returns it.
  Pixel pass(Pixel p) {
    const Slopes::Target chosen = known(p);
    if (chosen >= kFirstStep) {
      path_.push_back(p);
      return chosen - kFirstStep;
    }
    lower_.clear();
    if (chosen == kFork) {
      add_lower_neighbours(p, lower_);
      return make_fork(p);
    }
    const PoolId pool = pools_.pool_at(p);
    const Height here = pools_.height(p);
    if (!pools_.waits(pool) && pools_[pool].level == here) {
      known(p) = pool;
      return p;
    }
    if (pools_.waits(pool) && pools_.height(pools_.bottom(pool).front()) == here) {
      lower_ = {p};
      return make_fork(p);
    }
    add_plateau(p);
    const Slopes::Target next = choice(lower_);
    return next == kFork ? make_fork(p) : next == kOcean ? kOutside : next - kFirstStep;
  }

  void add_lower_neighbours(Pixel p, std::vector<Pixel>& lower) const {
    for_each_neighbour(pools_.terrain(), p, [&](Pixel q) {
      if (height(q) < pools_.height(p)) lower.push_back(q);
    });
  }

  /// A dry plateau on a slope: all its pixels without a lower neighbour of their own lead to
  /// the same place, and all lower neighbours of any of its pixels are theirs.
  void add_plateau(Pixel p) {
    std::vector<Pixel> plateau{p};
    std::unordered_set<Pixel> seen{p};
    for (std::size_t i = 0; i < plateau.size(); ++i) {
      const std::size_t n_before = lower_.size();
      add_lower_neighbours(plateau[i], lower_);
      if (lower_.size() == n_before) path_.push_back(plateau[i]);
      for_each_neighbour(pools_.terrain(), plateau[i], [&](Pixel q) {
        if (height(q) == pools_.height(p) && seen.insert(q).second) plateau.push_back(q);
      });
    }
  }

  /// A step to the lowest of these lower neighbours if they are nested, else a fork.
  Slopes::Target choice(std::vector<Pixel>& lower) const {
    std::sort(lower.begin(), lower.end(), [&](Pixel a, Pixel b) {
      return height(a) < height(b) || (height(a) == height(b) && a < b);
    });
    if (lower.front() == kOutside) return kOcean;
    for (std::size_t i = 1; i < lower.size(); ++i) {
      if (!is_nested(lower[i - 1], lower[i])) return kFork;
    }
    return kFirstStep + lower.front();
  }

  /// True if water that reaches b covers a too; a is the lower pixel. Not if b is one of
  /// several equal pixels of a saddle: full up to there, the pool of a may be as high as b, still
  /// dry.
  bool is_nested(Pixel a, Pixel b) const {
    const PoolId inner = pool_at(a);
    const PoolId outer = pool_at(b);
    if (inner == outer) return true;
    if (!descent_.within(inner, outer)) return false;
    const auto bottom = pools_.bottom(outer);
    return bottom.size() == 1 || height(b) > height(bottom.front());
  }

  Slopes::Branch branch(Pixel q) const {
    return {.height = height(q), .pool = pool_at(q), .pixel = q};
  }

  /// Makes a fork of the lower neighbours in lower_; makes p known and returns it.
  Pixel make_fork(Pixel p) {
    std::sort(lower_.begin(), lower_.end());
    lower_.erase(std::unique(lower_.begin(), lower_.end()), lower_.end());
    known(p) = ~static_cast<Slopes::Target>(to_.forks_.size());
    Slopes::Fork& fork = to_.forks_.emplace_back();
    if (lower_.size() == 2) {
      fork.two = {branch(lower_[0]), branch(lower_[1])};
    } else {
      fork.listed = {.first = static_cast<std::int32_t>(to_.branches_.size()),
                     .n = static_cast<std::int32_t>(lower_.size())};
      for (const Pixel q : lower_) to_.branches_.push_back(branch(q));
    }
    return p;
  }

  Slopes& to_;
  const Pools& pools_;
  const Descent& descent_;
  Slopes::Target first_known_ = 0;  ///< the least number of a fork; all below are steps
  std::vector<Pixel> path_;
  std::vector<Pixel> lower_;
};

Slopes::Slopes(const Pools& pools, const Descent& descent) {
  SlopeFinder(*this, pools, descent).find();
}

/// Calls change(target) for every place that a pixel or a branch leads to.
template <class Change>
void Slopes::change_targets(const Change& change) {
  parallel_for(static_cast<Index>(leads_to_.size()), kBlock, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) change(leads_to_[static_cast<std::size_t>(i)]);
  });
  for (std::size_t number = 0; number < forks_.size(); ++number) {
    const auto all = branches(~static_cast<Target>(number));
    for (Branch& branch : all) {
      if (all.size() > 1) change(branch.leads_to);
    }
  }
}

void Slopes::rename_pools(const std::vector<PoolId>& renamed) {
  const auto rename = [&](Target& target) {
    if (is_pool(target)) target = renamed[static_cast<std::size_t>(target)];
  };
  change_targets(rename);
  for (std::size_t number = 0; number < forks_.size(); ++number) {
    rename(forks_[number].path.end);
    for (Branch& branch : branches(~static_cast<Target>(number))) rename(branch.pool);
  }
}

/// Keeps the forks where paths part; returns what each old number has become.
std::vector<Slopes::Target> Slopes::drop_forks(const Confluences& confluences) {
  std::vector<Target> now(forks_.size());
  std::size_t n_kept = 0;
  for (std::size_t number = 0; number < forks_.size(); ++number) {
    const Target fork = ~static_cast<Target>(number);
    if (confluences.of(fork) != fork) continue;
    now[number] = ~static_cast<Target>(n_kept);
    forks_[n_kept++] = forks_[number];
  }
  forks_.resize(n_kept);
  give_back_unused(forks_);
  return now;
}

void Slopes::settle(Pools& pools, const std::vector<PoolId>& renamed) {
  rename_pools(renamed);
  go_on_or_throw();
  const Confluences confluences(*this, pools);
  const std::vector<Target> now = drop_forks(confluences);
  change_targets([&](Target& target) {
    const Target meeting = confluences.of(target);
    target = is_pool(meeting) ? meeting : now[place_of(meeting)];
  });
  const auto n_pools = static_cast<PoolId>(pools.count());
  for (PoolId id = 0; id < n_pools; ++id) {
    const Target meeting = confluences.of(id);
    if (meeting != id && is_pool(meeting)) pools.remember_overflow(id, {meeting, kNoRim});
  }
}

}  // namespace tabor::deposition
