#include "tabor/deposition/rain.hpp"

#include <algorithm>
#include <array>

#include "tabor/core/parallel.hpp"
#include "tabor/core/random.hpp"
#include "tabor/core/watch.hpp"
#include "tabor/deposition/router.hpp"

namespace tabor::deposition {
namespace {

constexpr std::int64_t kLargestBatch = 1 << 18;  // droplets drawn at once, on all threads
constexpr Index kBlockOfDraws = 1 << 14;         // of them, by one thread
constexpr Index kDrawsAtOnce = 1 << 8;           // and fetched from memory together
constexpr std::int64_t kRarestSettling = 2;  // droplets per pixel between two settlings of slopes

// How many droplets ahead of its turn one is asked of the memory: what it meets lies anywhere.
constexpr std::size_t kNear = 16;
constexpr std::size_t kFar = 32;

class Rain {
 public:
  Rain(Pools& pools, Height droplet, Reading reading, std::uint64_t seed)
      : pools_(pools),
        router_(pools),
        random_(seed),
        droplet_(droplet),
        reading_(reading),
        settle_at_(pools.terrain().size() / 4 + 1) {}

  const RainState& state() const { return state_; }

  /// Droplets until `dose` is reached or the batch ends; false when the dose is reached.
  bool rain_batch(Volume dose) {
    if (state_.n_droplets >= settle_at_) {
      router_.settle();
      settle_at_ += std::min(settle_at_, kRarestSettling * pools_.terrain().size());
    }
    const std::size_t n = draw_targets(dose);
    for (std::size_t i = 0; i < n && state_.dosed < dose; ++i) {
      router_.prefetch(targets_[i + kFar]);
      router_.prefetch_end(targets_[i + kNear]);
      state_.dosed += drop(targets_[i]);
      ++state_.n_droplets;
    }
    state_.n_looks = router_.n_looks();
    return state_.dosed < dose;
  }

  /// Once nothing but what is beyond can change every droplet does the same: all of them at once.
  void rain_beyond(Volume dose) {
    const PoolId pool = pools_.pool_beyond();
    const Volume each =
        reading_ == Reading::literal ? Volume{droplet_} * pools_[pool].area : Volume{droplet_};
    const std::int64_t n = std::max<Volume>(0, (dose - state_.dosed + each - 1) / each);
    pools_.pour(pool, n * each);
    state_.n_droplets += n;
    state_.dosed += n * each;
  }

 private:
  /// Where the slopes under the next start pixels lead to; returns how many. Not more than until
  /// the slopes settle, nor than `dose` needs if each droplet counts with its own volume.
  std::size_t draw_targets(Volume dose) {
    const Volume n_missing = (dose - state_.dosed + droplet_ - 1) / droplet_;
    const std::int64_t n =
        std::clamp<Volume>(std::min(n_missing, settle_at_ - state_.n_droplets), 0, kLargestBatch);
    targets_.assign(static_cast<std::size_t>(n) + kFar, 0);
    parallel_for(n, kBlockOfDraws, [&](Index begin, Index end) {
      for (Index i = begin; i < end; i += kDrawsAtOnce) {
        draw_targets(i, std::min(i + kDrawsAtOnce, end));
      }
    });
    return static_cast<std::size_t>(n);
  }

  void draw_targets(Index begin, Index end) {
    const Slopes& slopes = router_.slopes();
    const auto first = static_cast<std::uint64_t>(state_.n_droplets);
    const auto n_pixels = static_cast<std::uint64_t>(pools_.terrain().size());
    std::array<Pixel, kDrawsAtOnce> starts;
    for (Index i = begin; i < end; ++i) {
      Pixel& start = starts[static_cast<std::size_t>(i - begin)];
      start = static_cast<Pixel>(random_.below(first + static_cast<std::uint64_t>(i), n_pixels));
      slopes.prefetch(start);
    }
    for (Index i = begin; i < end; ++i) {
      targets_[static_cast<std::size_t>(i)] =
          slopes.from(starts[static_cast<std::size_t>(i - begin)]);
    }
  }

  Volume drop(Slopes::Target target) {
    PoolId pool = router_.from(target);
    if (reading_ == Reading::literal) return pools_.raise(pool, droplet_);
    for (Volume carried = pools_.pour(pool, droplet_); carried > 0;
         carried = pools_.pour(pool, carried)) {
      pool = router_.from(pool);
    }
    return droplet_;
  }

  Pools& pools_;
  Router router_;
  CounterRandom random_;
  Height droplet_;
  Reading reading_;
  std::vector<Slopes::Target> targets_;  ///< of the batch, and kFar more
  std::int64_t settle_at_;               ///< droplets
  RainState state_;
};

}  // namespace

void rain_droplets(Pools& pools, Height droplet, Reading reading, std::uint64_t seed,
                   const std::vector<Volume>& doses, const DoseReached& reached,
                   const Observer& observer) {
  Watch watch(observer, "rain");
  Rain rain(pools, droplet, reading, seed);
  for (std::size_t i = 0; i < doses.size(); ++i) {
    while (!pools.replete() && rain.rain_batch(doses[i])) {
      watch.tell(static_cast<double>(rain.state().dosed) / static_cast<double>(doses.back()));
    }
    if (pools.replete()) rain.rain_beyond(doses[i]);
    reached(i, rain.state());
  }
}

}  // namespace tabor::deposition
