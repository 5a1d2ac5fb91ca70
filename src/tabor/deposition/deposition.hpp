#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "tabor/core/convergence.hpp"
#include "tabor/core/names.hpp"
#include "tabor/core/types.hpp"

// Lays oil on a surface, as random droplets, as their limit of vanishing size, as one level or as a
// uniform film.
namespace tabor::deposition {

/// Model of how the liquid gets onto the surface.
enum class Model {
  droplets,     ///< random droplets run downhill, one after the other (Costagliola et al. 2021)
  limit,        ///< the same for vanishing droplets: fill, spill, merge (Barnes et al. 2020)
  bottom_fill,  ///< one flat level for the whole surface
  uniform       ///< the same thickness everywhere
};

/// Excess of a droplet that fills a depression: conserve or drop (Model::droplets only).
enum class Reading {
  conserving,  ///< N pixels rise by droplet/N, never above the rim; the rest flows on
  literal      ///< N pixels rise by a whole droplet, never above the rim; the rest is dropped
};

/// Border condition of the map.
enum class Edge {
  closed,    ///< a wall: nothing leaves
  periodic,  ///< opposite borders are neighbours
  open       ///< liquid that reaches a border pixel runs off, and is counted
};

inline constexpr auto kModels = names<Model>("droplets", "limit", "bottom-fill", "uniform");
inline constexpr auto kReadings = names<Reading>("conserving", "literal");
inline constexpr auto kEdges = names<Edge>("closed", "periodic", "open");

/// Settings of a deposition. docs/lubrication.md states the rule to the last bit.
struct Dose {
  std::vector<double> mean_films;  ///< dosed volume / nominal area [m], any order, each >= 0
  double droplet_height = 1e-7;    ///< droplet volume / pixel area [m], > 0 (Model::droplets)
  Model model = Model::droplets;
  Reading reading = Reading::conserving;
  Edge edge = Edge::closed;
  std::uint64_t seed = 1;  ///< chooses the start pixels (Model::droplets)
  /// The map is 2 x 2 mirror images of its first quarter. Rain that stays falls on that quarter
  /// alone, whose borders are walls, and the images get the same film.
  bool mirrored = false;
};

/// Liquid on the surface at one dose, with the numbers that a user reads about it.
struct Film {
  Field thickness;              ///< [m], >= 0, exactly 0 where dry, shape of the height
  double mean_film = 0;         ///< as asked [m]
  double dosed_volume = 0;      ///< rained [m^3] = deposited + lost; a droplet is never cut
  double deposited_volume = 0;  ///< on the surface [m^3]
  double lost_volume = 0;       ///< ran off open edges [m^3]
  std::int64_t n_droplets = 0;  ///< 0 for the models without droplets
  int n_images = 1;             ///< that hold the same film: the rain fell on one of them
  Index n_pools = 0;            ///< 4-connected wet regions
  double wet_fraction = 0;      ///< share of pixels with thickness > 0
  double max_film = 0;          ///< [m]
  bool flooded = false;         ///< the highest pixel is under a flat level
  double height_quantum = 0;    ///< heights were rounded to multiples of this [m]
  std::size_t request = 0;      ///< position of mean_film in Dose::mean_films
  double seconds = 0;           ///< from the start of the run to this film
};

/// Receives each film when its dose is reached, in ascending order of dose.
using FilmSink = std::function<void(Film&& film)>;

/// Lays down the films of all doses in one run; returns them in the order of dose.mean_films.
/// `height` [m], asperities up, shape (grid.ny, grid.nx), no NaN. Throws InputError for input that
/// is invalid, Interrupted when the observer asks to stop. Memory beside `height` and the films:
/// about 30 bytes per pixel.
std::vector<Film> deposit(const Field& height, const Grid& grid, const Dose& dose,
                          const Observer& observer = {});

/// Lays down many doses on a large map: only one film is in memory at a time.
void deposit(const Field& height, const Grid& grid, const Dose& dose, const FilmSink& sink,
             const Observer& observer = {});

/// Question which dose of Model::limit wets each pixel first.
struct Wetting {
  std::vector<double> mean_films;  ///< [m], >= 0, at most 65535 that rise
  Mask where;                      ///< pixels asked for, shape of the height; empty for all
};

/// Returns, row by row, the first dose that wets each pixel of `wetting.where`: its place in
/// wetting.mean_films, or their number where none does and elsewhere. It is that of Model::limit.
/// The films of `dose`, which may have none, are laid down in the same run, in droplets or as their
/// limit. Throws as deposit().
std::vector<std::uint16_t> first_wetting_doses(const Field& height, const Grid& grid,
                                               const Dose& dose, const Wetting& wetting,
                                               const FilmSink& sink, const Observer& observer = {});

/// Liquid that has come to rest.
struct Settled {
  Field thickness;  ///< [m], shape of the height
  double lost = 0;  ///< ran off open edges, over the nominal area [m]
};

/// Lets the liquid that lies on a surface, `thickness` [m] >= 0, run downhill, fill pools and spill
/// over, as the limit of vanishing droplets does. No volume is lost but what runs off an open
/// edge. Throws as deposit().
Settled settle(const Field& height, const Grid& grid, const Field& thickness, Edge edge,
               const Observer& observer = {});

/// Returns the mean film [m] of an areal lubricant density [kg/m^2] and an oil density [kg/m^3].
double mean_film(double lubricant_density, double oil_density);

/// Return "droplets", "limit", "bottom-fill", "uniform" and so on, as on the command line.
std::string_view name(Model model);
std::string_view name(Reading reading);
std::string_view name(Edge edge);

/// Return the enumerator of a name. Throw InputError with the nearest match.
Model parse_model(std::string_view text);
Reading parse_reading(std::string_view text);
Edge parse_edge(std::string_view text);

}  // namespace tabor::deposition
