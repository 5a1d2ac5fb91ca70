#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/core/mirror_images.hpp"
#include "tabor/core/watch.hpp"
#include "tabor/deposition/catchments.hpp"
#include "tabor/deposition/deposition.hpp"
#include "tabor/deposition/doses.hpp"
#include "tabor/deposition/images.hpp"

namespace tabor::deposition {
namespace {

/// Pixels of a map by their pools, and in each from the lowest up, as its level reaches them.
class PixelsOfPools {
 public:
  /// Places of the pixels of one pool that have not been taken.
  struct Part {
    std::int32_t begin = 0;
    std::int32_t end = 0;
  };

  PixelsOfPools(const Pools& pools, const Mask& where)
      : entries_(static_cast<std::size_t>(where.count())) {
    const auto n_pixels = static_cast<Pixel>(where.size());
    ends_.assign(pools.count() + 1, 0);
    for (Pixel p = 0; p < n_pixels; ++p) {
      if (where.data()[p]) ++ends_[place(pools.pool_at(p)) + 1];
    }
    std::partial_sum(ends_.begin(), ends_.end(), ends_.begin());
    std::vector<std::int32_t> next(ends_.begin(), ends_.end() - 1);
    for (Pixel p = 0; p < n_pixels; ++p) {
      if (where.data()[p]) entries_[place(next[place(pools.pool_at(p))]++)] = {pools.height(p), p};
    }
    for (std::size_t pool = 0; pool + 1 < ends_.size(); ++pool) {
      if (ends_[pool] == ends_[pool + 1]) continue;
      go_on_or_throw(pool);
      std::sort(entries_.begin() + ends_[pool], entries_.begin() + ends_[pool + 1],
                [](const Entry& a, const Entry& b) { return a.height < b.height; });
    }
  }

  Part of(PoolId pool) const { return {ends_[place(pool)], ends_[place(pool) + 1]}; }
  Height height(std::int32_t entry) const { return entries_[place(entry)].height; }
  Pixel pixel(std::int32_t entry) const { return entries_[place(entry)].pixel; }

 private:
  struct Entry {
    Height height;
    Pixel pixel;
  };

  static std::size_t place(std::int32_t number) { return static_cast<std::size_t>(number); }

  std::vector<Entry> entries_;
  std::vector<std::int32_t> ends_;  ///< per pool where the entries of the one before end
};

/// Rains evenly, dose by dose, and notes which dose wets a pixel first. What a pool holds is
/// proportional to the dose until it is full or another one spills into it: it is looked at only
/// then, and when it wets a pixel.
class WettingRain {
 public:
  WettingRain(Pools& pools, const Mask& where, const std::vector<Volume>& films)
      : pools_(pools),
        catchments_(pools),
        dry_(pools, where),
        films_(films),
        states_(pools.count()),
        due_(films.size()) {
    for (const Catchments::Source& source : catchments_.sources()) {
      state(source.pool).catchment = source.area;
      due_.front().push_back(source.pool);
    }
    for (std::size_t i = 0; i < states_.size(); ++i) {
      states_[i].dry = dry_.of(static_cast<PoolId>(i));
    }
  }

  void run(std::vector<std::uint16_t>& first, const Observer& observer) {
    Watch watch(observer, "fill");
    for (dose_ = 0; dose_ < films_.size(); ++dose_) {
      watch.tell(static_cast<double>(dose_) / static_cast<double>(films_.size()));
      const std::vector<PoolId> due = std::exchange(due_[dose_], {});
      for (std::size_t i = 0; i < due.size(); ++i) {
        go_on_or_throw(i);
        if (i + kFar < due.size()) prefetch(due[i + kFar]);
        if (state(due[i]).due == dose_) look(due[i], first);
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
    std::uint16_t n_rained = 0;  ///< doses whose rain it has taken
    std::uint16_t due = 0;       ///< dose at which it is looked at
    PixelsOfPools::Part dry;     ///< its own pixels
    std::int32_t rest = kNone;  ///< the first of rests_: pixels of its children at its lowest level
  };

  /// Dry pixels of a full pool, as high as its rim.
  struct Rest {
    PixelsOfPools::Part dry;
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
  void look(PoolId id, std::vector<std::uint16_t>& first) {
    Volume carried = take_rain(id);
    while (true) {
      if (!pools_[id].full()) {
        const Volume left = pools_.pour(id, carried);
        state(id).missing -= carried - left;
        carried = left;
        if (state(id).missing <= 0) wet(id, first);
      }
      if (!pools_[id].full()) break;
      state(id).due = static_cast<std::uint16_t>(films_.size());  // never again
      pass_on_dry_pixels(id);
      const PoolId next = catchments_.overflow(id);
      carried += take_rain(next);
      state(next).catchment += std::exchange(state(id).catchment, 0);
      id = next;
    }
    if (id != kOcean || pools_.terrain().edge != Edge::open) schedule(id);
  }

  /// The rain on its catchment since the last look.
  Volume take_rain(PoolId id) {
    State& of = state(id);
    const std::size_t before = std::exchange(of.n_rained, static_cast<std::uint16_t>(dose_ + 1));
    return of.catchment * (films_[dose_] - film(before));
  }

  void wet(PoolId id, std::vector<std::uint16_t>& first) {
    State& of = state(id);
    const bool floods = pools_.terrain().edge != Edge::open && pools_.beyond() > 0;
    const Height level = floods ? kNoRim : pools_[id].level;
    wet(of.dry, level, first);
    for (std::int32_t& number = of.rest; number != kNone; number = rest(number).next) {
      wet(rest(number).dry, level, first);
      if (rest(number).dry.begin < rest(number).dry.end) return;
    }
  }

  void wet(PixelsOfPools::Part& part, Height level, std::vector<std::uint16_t>& first) {
    for (; part.begin < part.end && level > dry_.height(part.begin); ++part.begin) {
      first[static_cast<std::size_t>(dry_.pixel(part.begin))] = static_cast<std::uint16_t>(dose_);
    }
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
    of.due = static_cast<std::uint16_t>(due);
    if (of.due < films_.size()) due_[of.due].push_back(id);
  }

  /// The level at which a pool wets another pixel; kNoRim if none is left.
  Height next_wetting_level(PoolId id) {
    const State& of = state(id);
    if (of.rest != kNone) return dry_.height(rest(of.rest).dry.begin) + 1;
    return of.dry.begin < of.dry.end ? dry_.height(of.dry.begin) + 1 : kNoRim;
  }

  Pools& pools_;
  Catchments catchments_;
  PixelsOfPools dry_;
  const std::vector<Volume>& films_;  ///< the doses, rising [quanta]
  std::size_t dose_ = 0;
  std::vector<State> states_;  ///< per pool
  std::vector<Rest> rests_;
  std::vector<std::vector<PoolId>> due_;  ///< per dose
};

/// Row by row the first dose that wets each pixel of `where`.
std::vector<std::uint16_t> first_doses(const Field& height, const Dose& dose, const Mask& where,
                                       const Observer& observer) {
  Terrain terrain = quantise(height, dose.edge);
  Pools pools(terrain, Ties::ordered);
  terrain.height = {};
  const std::vector<Volume> films = volumes(dose.mean_films, terrain, 1);
  std::vector<std::uint16_t> first(static_cast<std::size_t>(height.size()),
                                   static_cast<std::uint16_t>(films.size()));
  WettingRain(pools, where, films).run(first, observer);
  return first;
}

void check_rising(const Dose& dose) {
  if (dose.model != Model::limit ||
      !std::is_sorted(dose.mean_films.begin(), dose.mean_films.end())) {
    throw InputError("doses that wet a pixel first", std::string(name(dose.model)) + ", any order",
                     "rising doses of the limit of small droplets", "");
  }
  constexpr std::size_t most = std::numeric_limits<std::uint16_t>::max();
  if (dose.mean_films.size() > most) {
    throw InputError("doses that wet a pixel first", fmt::format("{}", dose.mean_films.size()),
                     fmt::format("{} at most", most), "");
  }
}

}  // namespace

std::vector<std::uint16_t> first_wetting_doses(const Field& height, const Grid& grid,
                                               const Dose& dose, const Mask& where,
                                               const Observer& observer) {
  const Watch watch(observer, "pools");
  check(height, grid, dose);
  check_rising(dose);
  if (where.rows() != grid.ny || where.cols() != grid.nx) {
    throw InputError("pixels that a dose wets first",
                     fmt::format("a map of {} x {}", where.cols(), where.rows()),
                     fmt::format("{} x {} as the heights", grid.nx, grid.ny), "");
  }
  if (!rains_on_one_image(height, dose)) return first_doses(height, dose, where, observer);
  const Mask on_any_image =
      where || where.rowwise().reverse() || where.colwise().reverse() || where.reverse();
  const Index ny = grid.ny / 2;
  const Index nx = grid.nx / 2;
  const std::vector<std::uint16_t> of_image = first_doses(
      first_image(height), dose_of_image(dose), on_any_image.topLeftCorner(ny, nx), observer);
  using Doses = Eigen::Array<std::uint16_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  std::vector<std::uint16_t> first(static_cast<std::size_t>(height.size()));
  Eigen::Map<Doses> all(first.data(), grid.ny, grid.nx);
  all = mirror_images<Doses>(Eigen::Map<const Doses>(of_image.data(), ny, nx));
  const auto none = static_cast<std::uint16_t>(dose.mean_films.size());
  all = where.select(all, none);
  return first;
}

}  // namespace tabor::deposition
