#include "tabor/deposition/even_rain.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

#include "tabor/core/watch.hpp"
#include "tabor/deposition/catchments.hpp"

namespace tabor::deposition {
namespace {

/// Rains evenly, dose by dose, and notes which dose wets a pixel first. What a pool holds is
/// proportional to the dose until it is full or another one spills into it: it is looked at only
/// then, when it wets a pixel, and when a film is asked for.
class EvenRain {
 public:
  /// `films` holds those of `wetting`, whose lists must outlive the rain.
  EvenRain(Pools& pools, std::vector<Volume> films, const FirstWetting& wetting)
      : pools_(pools),
        catchments_(pools),
        wetting_(wetting),
        films_(std::move(films)),
        states_(pools.count()),
        due_(films_.size() + 1) {
    for (const Catchments::Source& source : catchments_.sources()) {
      state(source.pool).catchment = source.area;
      due_.front().push_back(source.pool);
    }
    if (wetting.films.empty()) return;
    for (std::size_t i = 0; i < states_.size(); ++i) {
      go_on_or_throw(i);
      states_[i].dry = asked_from(pools_.places_of(static_cast<PoolId>(i)));
    }
  }

  /// Calls `reached` at those of the doses that are `asked`.
  void run(const std::vector<Volume>& asked, const DoseReached& reached, const Observer& observer) {
    Watch watch(observer, "fill");
    std::size_t n_reached = 0;
    for (dose_ = 0; dose_ < films_.size(); ++dose_) {
      watch.tell(static_cast<double>(dose_) / static_cast<double>(films_.size()));
      wets_ = static_cast<std::uint16_t>(
          std::lower_bound(wetting_.films.begin(), wetting_.films.end(), films_[dose_]) -
          wetting_.films.begin());
      const std::vector<PoolId> due = std::exchange(due_[dose_], {});
      for (std::size_t i = 0; i < due.size(); ++i) {
        go_on_or_throw(i);
        if (i + kFar < due.size()) prefetch(due[i + kFar]);
        if (state(due[i]).due == dose_) look(due[i]);
      }
      if (n_reached == asked.size() || asked[n_reached] != films_[dose_]) continue;
      bring_to_dose();
      while (n_reached < asked.size() && asked[n_reached] == films_[dose_]) {
        reached(n_reached++, {.dosed = films_[dose_] * pools_.terrain().size()});
      }
    }
  }

 private:
  static constexpr std::size_t kFar = 16;  ///< how far ahead of its turn memory is asked for a pool
  static constexpr std::int32_t kNone = -1;

  /// One pool in the rain.
  struct State {
    Volume missing = 0;          ///< until it is full or wets a pixel; not known if not positive
    std::int32_t catchment = 0;  ///< pixels whose rain it takes
    std::uint32_t n_rained = 0;  ///< doses whose rain it has taken
    std::uint32_t due = 0;       ///< dose at which it is looked at
    Pools::Places dry = {};      ///< of its own pixels, from the lowest that is asked for
    std::int32_t rest = kNone;  ///< the first of rests_: pixels of its children at its lowest level
  };

  /// Dry pixels of a full pool, as high as its rim.
  struct Rest {
    Pools::Places dry;
    std::int32_t next = kNone;
  };

  State& state(PoolId id) { return states_[static_cast<std::size_t>(id)]; }
  Rest& rest(std::int32_t number) { return rests_[static_cast<std::size_t>(number)]; }
  Volume film(std::size_t n_rained) const { return n_rained > 0 ? films_[n_rained - 1] : 0; }

  void prefetch(PoolId id) const {
    pools_.prefetch(id);
    __builtin_prefetch(&states_[static_cast<std::size_t>(id)]);
  }

  /// Pours the rain of a pool since the last look into it, and what it cannot hold into the next.
  void look(PoolId id) {
    Volume carried = take_rain(id);
    while (true) {
      if (!pools_[id].full()) {
        const Volume left = pools_.pour(id, carried);
        state(id).missing -= carried - left;
        carried = left;
        if (state(id).missing <= 0) wet(id);
      }
      if (!pools_[id].full()) break;
      state(id).due = static_cast<std::uint32_t>(films_.size());  // never again
      pass_on_dry_pixels(id);
      const PoolId next = catchments_.overflow(id);
      carried += take_rain(next);
      state(next).catchment += std::exchange(state(id).catchment, 0);
      id = next;
    }
    if (id != kOcean || pools_.terrain().edge != Edge::open) schedule(id);
  }

  /// Pours the rain since their last look into all pools: none is full by it, or it had been due.
  void bring_to_dose() {
    const auto n_pools = static_cast<PoolId>(states_.size());
    for (PoolId id = 0; id < n_pools; ++id) {
      if (state(id).catchment == 0) continue;
      const Volume rain = take_rain(id);
      pools_.pour(id, rain);
      state(id).missing -= rain;
    }
  }

  /// The rain on its catchment since the last look.
  Volume take_rain(PoolId id) {
    State& of = state(id);
    const std::size_t before = std::exchange(of.n_rained, static_cast<std::uint32_t>(dose_ + 1));
    return of.catchment * (films_[dose_] - film(before));
  }

  void wet(PoolId id) {
    State& of = state(id);
    const bool floods = pools_.terrain().edge != Edge::open && pools_.beyond() > 0;
    const Height level = floods ? kNoRim : pools_[id].level;
    wet(of.dry, level);
    for (std::int32_t& number = of.rest; number != kNone; number = rest(number).next) {
      wet(rest(number).dry, level);
      if (rest(number).dry.begin < rest(number).dry.end) return;
    }
  }

  void wet(Pools::Places& dry, Height level) {
    while (dry.begin < dry.end && level > pools_.height_at(dry.begin)) {
      wetting_.first[static_cast<std::size_t>(pools_.pixel_at(dry.begin))] = wets_;
      ++dry.begin;
      dry = asked_from(dry);
    }
  }

  /// Leaves out the first pixels, up to one that is asked for.
  Pools::Places asked_from(Pools::Places dry) const {
    const Mask& where = wetting_.where;
    if (where.size() == 0) return dry;
    while (dry.begin < dry.end && !where.data()[pools_.pixel_at(dry.begin)]) ++dry.begin;
    return dry;
  }

  /// Gives the pixels as high as the rim of a full pool to its parent, whose level begins there.
  void pass_on_dry_pixels(PoolId id) {
    while (pools_[id].full() && pools_[id].parent != kNoPool) {
      State& of = state(id);
      State& parent = state(pools_[id].parent);
      if (of.dry.begin < of.dry.end) {
        rests_.push_back({std::exchange(of.dry, {}), of.rest});
        of.rest = static_cast<std::int32_t>(rests_.size()) - 1;
      }
      if (of.rest != kNone) {
        std::int32_t last = of.rest;
        while (rest(last).next != kNone) last = rest(last).next;
        rest(last).next = std::exchange(parent.rest, std::exchange(of.rest, kNone));
        parent.missing = 0;  // where there are equal heights, it may have begun
      }
      id = pools_[id].parent;
    }
  }

  /// Finds the dose at which the pool, which is not full, is full or wets a pixel.
  void schedule(PoolId id) {
    State& of = state(id);
    if (of.missing <= 0) of.missing = pools_.volume_to(id, next_wetting_level(id));
    const Volume needed = films_[dose_] + (of.missing + of.catchment - 1) / of.catchment;
    const auto due = std::lower_bound(films_.begin(), films_.end(), needed) - films_.begin();
    of.due = static_cast<std::uint32_t>(due);
    if (of.due < films_.size()) due_[of.due].push_back(id);
  }

  /// The level at which a pool wets another pixel; kNoRim if none is left.
  Height next_wetting_level(PoolId id) {
    const State& of = state(id);
    if (of.rest != kNone) return pools_.height_at(rest(of.rest).dry.begin) + 1;
    return of.dry.begin < of.dry.end ? pools_.height_at(of.dry.begin) + 1 : kNoRim;
  }

  Pools& pools_;
  Catchments catchments_;
  const FirstWetting& wetting_;
  std::vector<Volume> films_;  ///< all doses, each once, rising [quanta]
  std::size_t dose_ = 0;
  std::uint16_t wets_ = 0;     ///< the first wetting dose that is not below it
  std::vector<State> states_;  ///< per pool
  std::vector<Rest> rests_;
  std::vector<std::vector<PoolId>> due_;  ///< per dose, and one more: there may be no dose
};

/// All doses, each once, rising.
std::vector<Volume> joined(const std::vector<Volume>& a, const std::vector<Volume>& b) {
  std::vector<Volume> all;
  all.reserve(a.size() + b.size());
  std::merge(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all));
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace

void rain_evenly(Pools& pools, const std::vector<Volume>& films, const DoseReached& reached,
                 const Observer& observer) {
  std::vector<std::uint16_t> none;
  const Mask nowhere;
  EvenRain(pools, joined(films, {}), {{}, nowhere, none}).run(films, reached, observer);
}

void rain_evenly(Pools& pools, const std::vector<Volume>& films, const DoseReached& reached,
                 const FirstWetting& wetting, const Observer& observer) {
  wetting.first.assign(static_cast<std::size_t>(pools.terrain().size()),
                       static_cast<std::uint16_t>(wetting.films.size()));
  EvenRain(pools, joined(films, wetting.films), wetting).run(films, reached, observer);
}

}  // namespace tabor::deposition
