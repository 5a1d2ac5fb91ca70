#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "tabor/core/checks.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/random.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/core/units.hpp"
#include "tabor/numerics/root.hpp"
#include "tabor/spectral/fft.hpp"
#include "tabor/synthesis/craters.hpp"
#include "tabor/synthesis/random_field.hpp"
#include "tabor/synthesis/recipe_checks.hpp"
#include "tabor/synthesis/recipe_parameters.hpp"
#include "tabor/synthesis/streams.hpp"
#include "tabor/synthesis/synthesis.hpp"

// The recipe: sparks leave overlapping craters with roughness all over (section 3 of Costagliola et
// al. 2021 shows plateaus with asperities on asperities); skin-pass rolling presses what stands
// high into plateaus; on these comes finer roughness; the sheet is wavy, and the microscope adds
// its noise. Craters and their roughness are scaled such that Sa is what is asked for; the other
// parts have their own heights. docs/decisions/008 says where the numbers come from.
namespace tabor::synthesis {
namespace {

using std::numbers::pi;

constexpr double kCap = 0.5;                 // rms heights at which material between craters ends
constexpr double kCraterRoughness = 0.4;     // its rms over that of the craters
constexpr double kRoughnessRollOff = 60e-6;  // [m]
constexpr double kPlateauRollOff = 20e-6;    // [m], of the finer roughness
constexpr double kShortestWave = 250e-6;     // [m], of the waviness
constexpr double kLongWave = 1.1e-3;         // [m], longer waves are no higher
constexpr double kCrest = 0.7;               // rms heights at which the roll ends their crests
constexpr double kStretch = 1.3;             // rolling lengthens roughness along x
constexpr double kPlateauRelief = 0.02;      // what rolling leaves of the height above a plateau

/// Zero mean, and unit mean square unless it is flat.
void normalise(Field& z) {
  z -= sum(z) / static_cast<double>(z.size());
  const double square = sum_over_rows<1>(
      z.rows(), [&](Index y) { return Eigen::Array<double, 1, 1>(z.row(y).square().sum()); })[0];
  if (square > 0) z /= std::sqrt(square / static_cast<double>(z.size()));
}

/// What stands above zero ends smoothly at `most`.
Field capped(const Field& z, double most) { return (z > 0).select(most * (z / most).tanh(), z); }

/// Normalised self-affine roughness, flat above the roll-off.
Field roughness(const Grid& grid, double hurst, double roll_off, double stretch, std::uint64_t seed,
                EdtStream stream) {
  const double corner = 2 * pi / roll_off;
  auto field = random_field({grid, stretch, true, seed, stream, [&](double q) {
                               return std::pow(std::max(q / corner, 1.0), -2 * (1 + hurst));
                             }});
  normalise(field.height);
  return std::move(field.height);
}

/// Normalised waves, none shorter than kShortestWave, the longer ones higher: spectrum q^-4, and
/// level beyond kLongWave, so that a larger sheet has more waves and not higher ones; the roll has
/// pressed their crests to nearly one height. Flat where none fits.
Field waves(const Grid& grid, std::uint64_t seed) {
  auto field = random_field({grid, kStretch, true, seed, kWavinessStream, [](double q) {
                               return q <= 2 * pi / kShortestWave
                                          ? std::pow(std::max(q, 2 * pi / kLongWave), -4)
                                          : 0;
                             }});
  normalise(field.height);
  field.height = capped(field.height, kCrest);
  normalise(field.height);
  return std::move(field.height);
}

/// Height that `share` of the pixels lie below.
double quantile(const Field& z, double share) {
  std::vector<double> heights(z.data(), z.data() + z.size());
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(z.size() - 1));
  std::nth_element(heights.begin(), heights.begin() + rank, heights.end());
  return heights[static_cast<std::size_t>(rank)];
}

/// Normalised: craters and their roughness, rolled.
Field textured(const Grid& grid, const Edt& recipe) {
  Field z = craters(grid, recipe.seed);
  normalise(z);
  z = capped(z, kCap);
  normalise(z);
  z += kCraterRoughness *
       roughness(grid, recipe.hurst, kRoughnessRollOff, kStretch, recipe.seed, kRoughnessStream);
  const double plateau = quantile(z, 1 - recipe.plateau_share);
  z = (z > plateau).select(plateau + kPlateauRelief * (z - plateau), z);
  normalise(z);
  return z;
}

/// [m], what has a height of its own: waviness, roughness of the plateaus, noise.
Field overlay(const Grid& grid, const Edt& recipe) {
  Field z = recipe.plateau_roughness *
            roughness(grid, recipe.hurst, kPlateauRollOff, kStretch, recipe.seed, kPlateauStream);
  if (recipe.waviness > 0) z += recipe.waviness * waves(grid, recipe.seed);
  const CounterRandom random(recipe.seed, kNoiseStream);
  for_each_row(grid.ny, [&](Index y) {
    for (Index x = 0; x < grid.nx; ++x) {
      z(y, x) += recipe.noise * random.normal(static_cast<std::uint64_t>(y * grid.nx + x));
    }
  });
  return z;
}

double mean_abs(const Field& z) {
  const double mean = sum(z) / static_cast<double>(z.size());
  return sum_over_rows<1>(z.rows(),
                          [&](Index y) {
                            return Eigen::Array<double, 1, 1>((z.row(y) - mean).abs().sum());
                          })[0] /
         static_cast<double>(z.size());
}

/// What has a height of its own must leave some to the texture.
void check_overlay(const Field& overlay, double mean_abs_height) {
  const double alone = mean_abs(overlay);
  if (alone < mean_abs_height) return;
  throw InputError(
      "EDT surface",
      fmt::format("Sa {} of waviness, plateau roughness and noise alone", format_si(alone, "m")),
      fmt::format("less than the Sa of the whole, {}", format_si(mean_abs_height, "m")), "");
}

/// overlay + s texture with the s for which Sa is what the recipe asks for.
Field combined(const Field& texture, const Field& overlay, double mean_abs_height) {
  const double alone = mean_abs(overlay);
  // Sa of the whole is at least that of the texture less that of the rest.
  const double most = 1.01 * (mean_abs_height + alone) / mean_abs(texture);
  const double scale = numerics::increasing_root(
      [&](double s) { return mean_abs(overlay + s * texture) - mean_abs_height; }, 0, most, 1e-14);
  Field z = overlay + scale * texture;
  z -= sum(z) / static_cast<double>(z.size());
  return z;
}

/// What sliding does to the tops. The constants are ours: chosen so that tops get flatter with the
/// pressure and oil protects them, in the order of the sheets of Costagliola et al. 2022, Fig. 6.
struct Sliding {
  double share;   // of the area that is flattened
  double relief;  // what is left of the height above that
};

Sliding sliding_of(const Edt& recipe) {
  constexpr double kReferencePressure = 7e6;     // [Pa]
  constexpr double kReferenceDensity = 0.45e-3;  // [kg/m^2]
  const double severity = recipe.sliding_pressure / kReferencePressure /
                          std::pow((1 + recipe.sliding_density / kReferenceDensity) / 2, 0.25);
  return {.share = std::min(0.5, 0.2 * std::sqrt(severity)),
          .relief = std::min(1.0, 0.15 / severity)};
}

/// Flattens what stands above the quantile and scratches grooves into the flats along x.
void slide(Field& z, const Grid& grid, const Edt& recipe) {
  const Sliding sliding = sliding_of(recipe);
  const double groove_depth = 0.04 * recipe.mean_abs_height;  // rms
  const double transition = 0.2 * recipe.mean_abs_height;
  const double tops = quantile(z, 1 - sliding.share);
  const Field grooves = roughness(grid, 0.7, 95e-6, 40, recipe.seed, kGrooveStream);
  for_each_row(grid.ny, [&](Index y) {
    for (Index x = 0; x < grid.nx; ++x) {
      const double above = z(y, x) - tops;
      const double t = std::clamp(above / transition + 1, 0.0, 1.0);
      z(y, x) = tops + (above > 0 ? sliding.relief * above : above) +
                t * t * (3 - 2 * t) * groove_depth * grooves(y, x);
    }
  });
}

/// Pixels along x and y of a cut-out's parent: large enough that opposite edges of the cut-out are
/// not neighbours.
std::array<double, 2> parent_size(const Grid& grid) {
  const auto larger = [](Index n, double spacing) {
    return static_cast<double>(n) + std::ceil(2 * kLargestCrater / spacing);
  };
  return {larger(grid.nx, grid.dx()), larger(grid.ny, grid.dy())};
}

Grid parent_grid(const Grid& grid) {
  const std::array<double, 2> size = parent_size(grid);
  const Index nx = spectral::good_fft_size(static_cast<Index>(size[0]));
  const Index ny = spectral::good_fft_size(static_cast<Index>(size[1]));
  return {nx, ny, static_cast<double>(nx) * grid.dx(), static_cast<double>(ny) * grid.dy()};
}

void check_parent(const std::array<double, 2>& size) {
  constexpr double kBytesOfPixel = 24;  // heights, and those of one part with its transform
  check_memory("EDT surface",
               fmt::format("a cut-out of {:.0f} x {:.0f} pixels, enough for whole craters", size[0],
                           size[1]),
               kBytesOfPixel * size[0] * size[1], "take larger pixels, or a tile");
}

void check_recipe(const Edt& recipe) {
  check_grid(recipe.grid, "EDT surface");
  check_settings(recipe);
  const Grid& grid = recipe.grid;
  if (grid.nx < 4 || grid.ny < 4) {
    throw InputError("EDT surface", fmt::format("{} x {} pixels", grid.nx, grid.ny),
                     "at least 4 x 4 pixels", "");
  }
  check_two_pixels("EDT surface", "craters", kSmallestCrater, std::max(grid.dx(), grid.dy()));
  if (!recipe.periodic) check_parent(parent_size(grid));
}

}  // namespace

topography::Topography edt(const Edt& recipe) {
  check_recipe(recipe);
  const Grid grid = recipe.periodic ? recipe.grid : parent_grid(recipe.grid);
  const auto part = [&](const Field& whole) {
    return Field(whole.topLeftCorner(recipe.grid.ny, recipe.grid.nx));
  };
  const Field above = part(overlay(grid, recipe));
  check_overlay(above, recipe.mean_abs_height);
  Field z = combined(part(textured(grid, recipe)), above, recipe.mean_abs_height);
  if (recipe.stage == EdtStage::after) {
    slide(z, recipe.grid, recipe);
    z -= sum(z) / static_cast<double>(z.size());
  }
  return generated(recipe.grid, std::move(z), recipe.periodic, describe(recipe));
}

}  // namespace tabor::synthesis
