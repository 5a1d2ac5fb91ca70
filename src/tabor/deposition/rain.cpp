#include "tabor/deposition/rain.hpp"

#include <algorithm>

#include "tabor/core/parallel.hpp"
#include "tabor/core/random.hpp"
#include "tabor/core/watch.hpp"
#include "tabor/deposition/catchments.hpp"
#include "tabor/deposition/router.hpp"
#include "tabor/deposition/scouts.hpp"

namespace tabor::deposition {
namespace {

constexpr Pixel kLargestBatch = 1 << 16;     // start pixels drawn at once, on all threads
constexpr std::int64_t kRarestSettling = 2;  // droplets per pixel between two settlings of slopes

class Rain {
 public:
  Rain(Pools& pools, Height droplet, Reading reading, std::uint64_t seed)
      : pools_(pools),
        router_(pools),
        scouts_(pools, router_.slopes()),
        random_(seed),
        droplet_(droplet),
        reading_(reading),
        batch_size_(static_cast<std::size_t>(std::min(pools.terrain().size(), kLargestBatch))),
        starts_(batch_size_ + Scouts::kAhead + Scouts::kBlock),
        settle_at_(pools.terrain().size() / 4 + 1) {}

  const RainState& state() const { return state_; }

  /// Droplets until `dose` is reached or the batch ends; false when the dose is reached.
  bool rain_batch(Volume dose) {
    draw_starts();
    auto place = static_cast<std::size_t>(state_.n_droplets) % batch_size_;
    for (; place < batch_size_ && state_.dosed < dose; ++place) {
      if (state_.n_droplets == settle_at_) {
        router_.settle();
        scouts_.start();
        settle_at_ += std::min(settle_at_, kRarestSettling * pools_.terrain().size());
      }
      if (place % Scouts::kBlock == 0) scouts_.advance(&starts_[place]);
      state_.dosed += drop(starts_[place]);
      ++state_.n_droplets;
    }
    return state_.dosed < dose;
  }

  /// Under a flat level without a rim every droplet does the same: all of them at once.
  void rain_on_flood(Volume dose) {
    const Volume each = reading_ == Reading::literal ? Volume{droplet_} * pools_.terrain().size()
                                                     : Volume{droplet_};
    const std::int64_t n = std::max<Volume>(0, (dose - state_.dosed + each - 1) / each);
    pools_.pour(pools_.owner(pools_.home(0)), n * each);
    state_.n_droplets += n;
    state_.dosed += n * each;
  }

 private:
  void draw_starts() {
    const std::int64_t batch = state_.n_droplets / static_cast<std::int64_t>(batch_size_);
    if (batch == drawn_) return;
    drawn_ = batch;
    const auto n = static_cast<std::uint64_t>(pools_.terrain().size());
    const auto first = static_cast<std::uint64_t>(batch) * batch_size_;
    parallel_for(static_cast<Index>(starts_.size()), 4096, [&](Index begin, Index end) {
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
        starts_[i] = static_cast<Pixel>(random_.below(first + i, n));
      }
    });
  }

  Volume drop(Pixel start) {
    PoolId pool = router_.from_pixel(start);
    if (reading_ == Reading::literal) return pools_.raise(pool, droplet_);
    for (Volume carried = pools_.pour(pool, droplet_); carried > 0;
         carried = pools_.pour(pool, carried)) {
      pool = router_.from_full_pool(pool);
    }
    return droplet_;
  }

  Pools& pools_;
  Router router_;
  Scouts scouts_;
  CounterRandom random_;
  Height droplet_;
  Reading reading_;
  std::size_t batch_size_;
  std::vector<Pixel> starts_;
  std::int64_t drawn_ = -1;
  std::int64_t settle_at_;  ///< droplets
  RainState state_;
};

}  // namespace

void rain_droplets(Pools& pools, Height droplet, Reading reading, std::uint64_t seed,
                   const std::vector<Volume>& doses, const DoseReached& reached,
                   const Observer& observer) {
  Watch watch(observer, "rain");
  Rain rain(pools, droplet, reading, seed);
  for (std::size_t i = 0; i < doses.size(); ++i) {
    while (!pools.flooded() && rain.rain_batch(doses[i])) {
      watch.tell(static_cast<double>(rain.state().dosed) / static_cast<double>(doses.back()));
    }
    if (pools.flooded()) rain.rain_on_flood(doses[i]);
    reached(i, rain.state());
  }
}

void rain_evenly(Pools& pools, const std::vector<Volume>& films, const DoseReached& reached,
                 const Observer& observer) {
  Watch watch(observer, "fill");
  Catchments catchments(pools);
  Volume film = 0;
  for (std::size_t i = 0; i < films.size(); ++i) {
    watch.tell(static_cast<double>(i) / static_cast<double>(films.size()));
    catchments.rain(films[i] - film);
    film = films[i];
    reached(i, {0, film * pools.terrain().size()});
  }
}

}  // namespace tabor::deposition
