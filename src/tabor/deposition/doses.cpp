#include "tabor/deposition/doses.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "tabor/core/error.hpp"
#include "tabor/core/units.hpp"

namespace tabor::deposition {
namespace {

constexpr double kMostVolume = 4e18;  // quanta * pixels, fits 63 bits with a last droplet

}  // namespace

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
    throw InputError("<droplet_height>", fmt::format("{} m", dose.droplet_height), "more than zero",
                     "the droplet's volume is this height times the pixel area, e.g. 0.1 um");
  }
}

void check(const Grid& grid, const Dose& dose, const Wetting& wetting) {
  constexpr auto most = std::numeric_limits<std::uint16_t>::max();
  const bool runs_down = dose.model == Model::droplets || dose.model == Model::limit;
  if (!runs_down || !std::is_sorted(wetting.mean_films.begin(), wetting.mean_films.end())) {
    throw InputError("doses that wet a pixel first", std::string(name(dose.model)) + ", any order",
                     "rising doses of droplets or of their limit", "");
  }
  if (wetting.mean_films.size() > most) {
    throw InputError("doses that wet a pixel first", fmt::format("{}", wetting.mean_films.size()),
                     fmt::format("{} at most", most), "");
  }
  if (wetting.where.size() > 0 &&
      (wetting.where.rows() != grid.ny || wetting.where.cols() != grid.nx)) {
    throw InputError("pixels that a dose wets first",
                     fmt::format("a map of {} x {}", wetting.where.cols(), wetting.where.rows()),
                     fmt::format("{} x {} as the heights", grid.nx, grid.ny), "");
  }
}

std::vector<Volume> volumes(const std::vector<double>& mean_films, const Terrain& terrain,
                            Pixel n_pixels) {
  const double most = kMostVolume / static_cast<double>(terrain.size());  // quanta
  std::vector<Volume> result;
  result.reserve(mean_films.size());
  for (const double mean_film : mean_films) {
    const double film = mean_film / terrain.quantum;
    if (film > most) {
      throw InputError("mean film", format_si(mean_film, "m"),
                       "at most " + format_si(most * terrain.quantum, "m"),
                       "that much liquid drowns the surface");
    }
    result.push_back(std::llround(film * n_pixels));
  }
  return result;
}

}  // namespace tabor::deposition
