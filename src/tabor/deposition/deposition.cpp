#include "tabor/deposition/deposition.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tabor/core/error.hpp"
#include "tabor/core/large_pages.hpp"
#include "tabor/core/mirror_images.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/core/units.hpp"
#include "tabor/core/watch.hpp"
#include "tabor/deposition/doses.hpp"
#include "tabor/deposition/even_rain.hpp"
#include "tabor/deposition/film_measures.hpp"
#include "tabor/deposition/images.hpp"
#include "tabor/deposition/pools.hpp"
#include "tabor/deposition/rain.hpp"
#include "tabor/deposition/ranks.hpp"

namespace tabor::deposition {
namespace {

/// One run of deposit(): the doses in ascending order, and films made of the state of the liquid.
class Deposition {
 public:
  /// `wetting`: null where no first doses are asked for.
  Deposition(const Field& height, const Grid& grid, const Dose& dose, const Wetting* wetting,
             const FilmSink& sink)
      : height_(height),
        grid_(grid),
        dose_(dose),
        wetting_(wetting),
        sink_(sink),
        requests_(dose.mean_films.size()) {
    std::iota(requests_.begin(), requests_.end(), std::size_t{0});
    std::stable_sort(requests_.begin(), requests_.end(), [&](std::size_t a, std::size_t b) {
      return dose.mean_films[a] < dose.mean_films[b];
    });
  }

  /// Returns the first doses that wet the pixels, if they are asked for.
  std::vector<std::uint16_t> run(const Observer& observer) {
    if (dose_.model == Model::uniform) {
      spread_uniformly();
    } else if (dose_.model == Model::bottom_fill) {
      terrain_ = quantise(height_, dose_.edge);
      fill_from_the_bottom();
    } else {
      rain(observer);
    }
    return std::move(first_);
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
    std::vector<double> ascending;
    for (const std::size_t request : requests_) ascending.push_back(dose_.mean_films[request]);
    return volumes(ascending, terrain_, n_pixels);
  }

  Height droplet() const {
    const double quanta = std::nearbyint(dose_.droplet_height / terrain_.quantum);
    if (quanta < 1 || quanta > kNoRim) {
      throw InputError("<droplet_height>", format_si(dose_.droplet_height, "m"),
                       format_si(terrain_.quantum, "m") + " to " +
                           format_si(terrain_.quantum * kNoRim, "m") + " for this range of heights",
                       "");
    }
    return static_cast<Height>(quanta);
  }

  void rain(const Observer& observer) {
    terrain_ = quantise(height_, dose_.edge);
    if (dose_.model == Model::droplets) {
      rain_droplets(observer);
    } else {
      rain_evenly(observer);
    }
  }

  void rain_droplets(const Observer& observer) {
    Pools pools(terrain_, Ties::ordered, wetting_ != nullptr);
    release(terrain_.height);
    if (wetting_ != nullptr) find_first_doses(pools, {}, {}, observer);
    pools.connect_ties();
    deposition::rain_droplets(pools, droplet(), dose_.reading, dose_.seed, doses(terrain_.size()),
                              to_films(pools), observer);
  }

  void rain_evenly(const Observer& observer) {
    Pools pools(terrain_, Ties::ordered, wetting_ != nullptr);
    release(terrain_.height);
    if (wetting_ == nullptr) {
      deposition::rain_evenly(pools, doses(1), to_films(pools), observer);
    } else {
      find_first_doses(pools, doses(1), to_films(pools), observer);
    }
  }

  void find_first_doses(Pools& pools, const std::vector<Volume>& films, const DoseReached& reached,
                        const Observer& observer) {
    deposition::rain_evenly(pools, films, reached,
                            {volumes(wetting_->mean_films, terrain_, 1), wetting_->where, first_},
                            observer);
  }

  DoseReached to_films(Pools& pools) {
    return [this, &pools](std::size_t i, const RainState& state) { emit(i, state, pools); };
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
  const Wetting* wetting_;
  const FilmSink& sink_;
  std::vector<std::size_t> requests_;  // positions in mean_films, ascending in dose
  Stopwatch watch_;
  Terrain terrain_;
  std::vector<std::uint16_t> first_;  // doses that wet the pixels
};

/// Lays films down on the map or, where it is made of mirror images, on one of them; returns the
/// first doses that `wetting` asks for, if it is not null.
std::vector<std::uint16_t> lay_down(const Field& height, const Grid& grid, const Dose& dose,
                                    const Wetting* wetting, const FilmSink& sink,
                                    const Observer& observer) {
  if (!rains_on_one_image(height, dose)) {
    return Deposition(height, grid, dose, wetting, sink).run(observer);
  }
  const Field image = first_image(height);
  const Grid grid_on_image = grid_of_image(grid);
  const Dose on_image = dose_of_image(dose);
  const Wetting wetting_on_image = wetting == nullptr ? Wetting() : of_image(*wetting);
  const FilmSink mirror = [&](Film&& film) { sink(with_images(std::move(film), dose.edge)); };
  const std::vector<std::uint16_t> first =
      Deposition(image, grid_on_image, on_image, wetting == nullptr ? nullptr : &wetting_on_image,
                 mirror)
          .run(observer);
  return wetting == nullptr ? first : with_images(first, grid, *wetting);
}

}  // namespace

void deposit(const Field& height, const Grid& grid, const Dose& dose, const FilmSink& sink,
             const Observer& observer) {
  const Watch watch(observer, "pools");
  check(height, grid, dose);
  lay_down(height, grid, dose, nullptr, sink, observer);
}

std::vector<std::uint16_t> first_wetting_doses(const Field& height, const Grid& grid,
                                               const Dose& dose, const Wetting& wetting,
                                               const FilmSink& sink, const Observer& observer) {
  const Watch watch(observer, "pools");
  Dose all = dose;
  all.mean_films.insert(all.mean_films.end(), wetting.mean_films.begin(), wetting.mean_films.end());
  check(height, grid, all);
  check(grid, dose, wetting);
  return lay_down(height, grid, dose, &wetting, sink, observer);
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
