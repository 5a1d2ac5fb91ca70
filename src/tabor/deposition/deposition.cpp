#include "tabor/deposition/deposition.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "tabor/core/error.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/core/units.hpp"
#include "tabor/core/watch.hpp"
#include "tabor/deposition/film_measures.hpp"
#include "tabor/deposition/pool_builder.hpp"
#include "tabor/deposition/rain.hpp"

namespace tabor::deposition {
namespace {

constexpr double kMostVolume = 4e18;  // quanta * pixels, fits 63 bits with a last droplet

void check(const Field& height, const Grid& grid, const Dose& dose) {
  if (height.rows() != grid.ny || height.cols() != grid.nx) {
    throw InputError("surface to lubricate",
                     fmt::format("{} x {} heights", height.cols(), height.rows()),
                     fmt::format("{} x {} as in its grid", grid.nx, grid.ny), "");
  }
  if (!(grid.lx > 0 && grid.ly > 0)) {
    throw InputError("surface to lubricate", fmt::format("a size of {} m x {} m", grid.lx, grid.ly),
                     "a positive size", "");
  }
  if (dose.mean_films.empty()) {
    throw InputError("lubricant dose", "no mean film", "at least one", "give a density");
  }
  for (const double film : dose.mean_films) {
    if (!(film >= 0 && std::isfinite(film))) {
      throw InputError("mean film", fmt::format("{} m", film), "zero or more", "");
    }
  }
  if (!(dose.droplet_height > 0 && std::isfinite(dose.droplet_height))) {
    throw InputError("droplet height", fmt::format("{} m", dose.droplet_height), "more than zero",
                     "the droplet's volume is this height times the pixel area, e.g. 0.1 um");
  }
}

/// One run of deposit(): the doses in ascending order, and films made of the state of the liquid.
class Deposition {
 public:
  Deposition(const Field& height, const Grid& grid, const Dose& dose, const FilmSink& sink)
      : height_(height), grid_(grid), dose_(dose), sink_(sink), requests_(dose.mean_films.size()) {
    std::iota(requests_.begin(), requests_.end(), std::size_t{0});
    std::stable_sort(requests_.begin(), requests_.end(), [&](std::size_t a, std::size_t b) {
      return dose.mean_films[a] < dose.mean_films[b];
    });
  }

  void run(const Observer& observer) {
    if (dose_.model == Model::uniform) {
      spread_uniformly();
      return;
    }
    if (dose_.model == Model::bottom_fill) {
      terrain_ = quantise(height_, dose_.edge);
      fill_from_the_bottom();
      return;
    }
    rain([&](std::size_t i, const RainState& state, Pools& pools) { emit(i, state, pools); },
         observer);
  }

  /// Calls `look` at each dose, with its place among the ascending ones.
  template <typename Look>
  void rain(const Look& look, const Observer& observer) {
    terrain_ = quantise(height_, dose_.edge);
    const Ties ties = dose_.model == Model::droplets ? Ties::connected : Ties::ordered;
    Pools pools(terrain_, ties);
    terrain_.height = {};
    const auto reached = [&](std::size_t i, const RainState& state) { look(i, state, pools); };
    if (dose_.model == Model::droplets) {
      rain_droplets(pools, droplet(), dose_.reading, dose_.seed, doses(terrain_.size()), reached,
                    observer);
    } else {
      rain_evenly(pools, doses(1), reached, observer);
    }
  }

 private:
  Film new_film(std::size_t i) const {
    Film film;
    film.request = requests_[i];
    film.mean_film = dose_.mean_films[film.request];
    return film;
  }

  double cubic_metres(double quanta) const {
    return quanta * terrain_.quantum * grid_.pixel_area();
  }

  /// Ascending doses in quanta, for `n_pixels` pixels.
  std::vector<Volume> doses(Pixel n_pixels) const {
    std::vector<Volume> result;
    for (const std::size_t request : requests_) {
      const double film = dose_.mean_films[request] / terrain_.quantum;
      if (film * static_cast<double>(terrain_.size()) > kMostVolume) {
        throw InputError("mean film", format_si(dose_.mean_films[request], "m"),
                         "at most " + format_si(kMostVolume / static_cast<double>(terrain_.size()) *
                                                    terrain_.quantum,
                                                "m"),
                         "that much liquid drowns the surface");
      }
      result.push_back(std::llround(film * n_pixels));
    }
    return result;
  }

  Height droplet() const {
    const double quanta = std::nearbyint(dose_.droplet_height / terrain_.quantum);
    if (quanta < 1 || quanta > kNoRim) {
      throw InputError("droplet height", format_si(dose_.droplet_height, "m"),
                       format_si(terrain_.quantum, "m") + " to " +
                           format_si(terrain_.quantum * kNoRim, "m") + " for this range of heights",
                       "");
    }
    return static_cast<Height>(quanta);
  }

  void emit(std::size_t i, const RainState& state, Pools& pools) {
    Film film = new_film(i);
    const Volume lost = dose_.edge == Edge::open ? pools.beyond() : 0;
    const double flood = static_cast<double>(pools.beyond() - lost) / terrain_.size();
    film.thickness = thickness_in(pools, flood);
    film.dosed_volume = cubic_metres(static_cast<double>(state.dosed));
    film.lost_volume = cubic_metres(static_cast<double>(lost));
    film.deposited_volume = cubic_metres(static_cast<double>(state.dosed - lost));
    film.n_droplets = state.n_droplets;
    film.flooded = flood > 0;
    finish(std::move(film));
  }

  void fill_from_the_bottom() {
    const std::vector<Pixel> ascending = ascending_pixels(terrain_);
    const std::vector<Volume> volumes = doses(terrain_.size());
    const auto height = [&](std::size_t place) -> Volume {
      return terrain_.height[static_cast<std::size_t>(ascending[place])];
    };
    std::size_t area = 0;  // pixels below the level
    Volume level = height(0);
    Volume below = 0;  // liquid below the level
    for (std::size_t i = 0; i < volumes.size(); ++i) {
      while (area < ascending.size()) {
        const Volume step = (height(area) - level) * static_cast<Volume>(area);
        if (below + step > volumes[i]) break;
        below += step;
        level = height(area++);
      }
      const double rest = static_cast<double>(volumes[i] - below) / static_cast<double>(area);
      emit_level(i, static_cast<double>(level) + rest, volumes[i], area == ascending.size());
    }
  }

  void emit_level(std::size_t i, double level, Volume volume, bool all_under) {
    Film film = new_film(i);
    film.thickness.resize(grid_.ny, grid_.nx);
    for (std::size_t p = 0; p < terrain_.height.size(); ++p) {
      film.thickness.data()[p] = std::max(0.0, level - terrain_.height[p]) * terrain_.quantum;
    }
    film.dosed_volume = film.deposited_volume = cubic_metres(static_cast<double>(volume));
    film.flooded = all_under && film.thickness.minCoeff() > 0;
    finish(std::move(film));
  }

  void spread_uniformly() {
    for (std::size_t i = 0; i < requests_.size(); ++i) {
      Film film = new_film(i);
      film.thickness = Field::Constant(grid_.ny, grid_.nx, film.mean_film);
      film.dosed_volume = film.deposited_volume = film.mean_film * grid_.area();
      finish(std::move(film));
    }
  }

  void finish(Film film) {
    measure(film, dose_.edge);
    film.height_quantum = dose_.model == Model::uniform ? 0 : terrain_.quantum;
    film.seconds = watch_.seconds();
    sink_(std::move(film));
  }

  const Field& height_;
  const Grid& grid_;
  const Dose& dose_;
  const FilmSink& sink_;
  std::vector<std::size_t> requests_;  // positions in mean_films, ascending in dose
  Stopwatch watch_;
  Terrain terrain_;
};

/// Pixels of a surface that no dose has wet yet, by their pools and in each from the lowest up, as
/// its level reaches them: what is still dry then costs nothing.
class DryPixels {
 public:
  DryPixels(const Pools& pools, const Mask& where)
      : dry_(static_cast<std::size_t>(where.count())), n_pools_(pools.count()) {
    const auto n_pixels = static_cast<Pixel>(where.size());
    std::vector<std::int32_t> end(pools.count() + 1, 0);
    for (Pixel p = 0; p < n_pixels; ++p) {
      if (where.data()[p]) ++end[pool_of(pools, p) + 1];
    }
    std::partial_sum(end.begin(), end.end(), end.begin());
    std::vector<std::int32_t> next(end.begin(), end.end() - 1);
    for (Pixel p = 0; p < n_pixels; ++p) {
      if (!where.data()[p]) continue;
      dry_[static_cast<std::size_t>(next[pool_of(pools, p)]++)] = {pools.height(p), p};
    }
    for (std::size_t pool = 0; pool + 1 < end.size(); ++pool) {
      if (end[pool] == end[pool + 1]) continue;
      go_on_or_throw(pool);
      std::sort(dry_.begin() + end[pool], dry_.begin() + end[pool + 1],
                [](const Dry& a, const Dry& b) { return a.height < b.height; });
      parts_.push_back({static_cast<PoolId>(pool), end[pool], end[pool + 1]});
    }
  }

  /// Writes `dose` for those that have liquid above them now, or for all.
  void wet(std::uint16_t dose, Pools& pools, bool all, std::vector<std::uint16_t>& first) {
    if (pools.count() != n_pools_) follow_renumbering(pools);
    std::size_t n_left = 0;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      go_on_or_throw(i);
      if (i + kFar < parts_.size()) pools.prefetch(parts_[i + kFar].pool);
      if (i + kNear < parts_.size()) pools.prefetch(pools[parts_[i + kNear].pool].owner);
      Part part = parts_[i];
      const Height level = pools[part.pool].active() ? pools[pools.owner(part.pool)].level : kDry;
      while (part.begin < part.end && (all || level > dry(part.begin).height)) {
        first[static_cast<std::size_t>(dry(part.begin++).pixel)] = dose;
      }
      if (part.begin < part.end) parts_[n_left++] = part;
    }
    parts_.resize(n_left);
  }

 private:
  // How many parts ahead of its turn a pool, then its owner, is asked of the memory.
  static constexpr std::size_t kFar = 32;
  static constexpr std::size_t kNear = 16;

  struct Dry {
    Height height;
    Pixel pixel;
  };

  /// The dry pixels of one pool.
  struct Part {
    PoolId pool;
    std::int32_t begin;
    std::int32_t end;
  };

  static std::size_t pool_of(const Pools& pools, Pixel p) {
    return static_cast<std::size_t>(pools.pool_at(p));
  }

  const Dry& dry(std::int32_t place) const { return dry_[static_cast<std::size_t>(place)]; }

  void follow_renumbering(const Pools& pools) {
    for (Part& part : parts_) part.pool = pools.pool_at(dry(part.begin).pixel);
    n_pools_ = pools.count();
  }

  std::vector<Dry> dry_;
  std::vector<Part> parts_;
  std::size_t n_pools_;  // fewer once they have new numbers
};

}  // namespace

void deposit(const Field& height, const Grid& grid, const Dose& dose, const FilmSink& sink,
             const Observer& observer) {
  const Watch watch(observer, "pools");
  check(height, grid, dose);
  Deposition(height, grid, dose, sink).run(observer);
}

std::vector<std::uint16_t> first_wetting_doses(const Field& height, const Grid& grid,
                                               const Dose& dose, const Mask& where,
                                               const Observer& observer) {
  const Watch watch(observer, "pools");
  check(height, grid, dose);
  const bool runs_down = dose.model == Model::droplets || dose.model == Model::limit;
  if (!runs_down || !std::is_sorted(dose.mean_films.begin(), dose.mean_films.end())) {
    throw InputError("doses that wet a pixel first", std::string(name(dose.model)) + ", any order",
                     "rising doses of droplets or their limit", "");
  }
  constexpr std::size_t most = std::numeric_limits<std::uint16_t>::max();
  if (dose.mean_films.size() > most) {
    throw InputError("doses that wet a pixel first", fmt::format("{}", dose.mean_films.size()),
                     fmt::format("{} at most", most), "");
  }
  if (where.rows() != grid.ny || where.cols() != grid.nx) {
    throw InputError("pixels that a dose wets first",
                     fmt::format("a map of {} x {}", where.cols(), where.rows()),
                     fmt::format("{} x {} as the heights", grid.nx, grid.ny), "");
  }
  std::vector<std::uint16_t> first(static_cast<std::size_t>(height.size()),
                                   static_cast<std::uint16_t>(dose.mean_films.size()));
  std::optional<DryPixels> dry;
  const auto look = [&](std::size_t i, const RainState&, Pools& pools) {
    if (!dry) dry.emplace(pools, where);
    const bool all = dose.edge != Edge::open && pools.beyond() > 0;
    dry->wet(static_cast<std::uint16_t>(i), pools, all, first);
  };
  const FilmSink no_films;
  Deposition(height, grid, dose, no_films).rain(look, observer);
  return first;
}

std::vector<Film> deposit(const Field& height, const Grid& grid, const Dose& dose,
                          const Observer& observer) {
  std::vector<Film> films(dose.mean_films.size());
  deposit(
      height, grid, dose, [&](Film&& film) { films[film.request] = std::move(film); }, observer);
  return films;
}

double mean_film(double lubricant_density, double oil_density) {
  if (!(lubricant_density >= 0 && std::isfinite(lubricant_density))) {
    throw InputError("lubricant density", fmt::format("{} kg/m^2", lubricant_density),
                     "zero or more", "");
  }
  if (!(oil_density > 0 && std::isfinite(oil_density))) {
    throw InputError("oil density", fmt::format("{} kg/m^3", oil_density), "more than zero",
                     "mineral oil has about 900 kg/m^3");
  }
  return lubricant_density / oil_density;
}

}  // namespace tabor::deposition
