#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <vector>

#include "tabor/core/checks.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/random.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/core/units.hpp"
#include "tabor/spectral/fft.hpp"
#include "tabor/synthesis/random_field.hpp"
#include "tabor/synthesis/recipe_checks.hpp"
#include "tabor/synthesis/synthesis.hpp"

// The recipe: sparks leave overlapping craters (section 3 of Costagliola et al. 2021 shows plateaus
// with asperities on asperities); skin-pass rolling limits the height of what stands between them;
// finer self-affine roughness covers everything. The amplitudes of the sum are then set to the
// power law that such sheets are measured to follow, while its phases keep the craters and
// plateaus. Lengths below are those of common textures; heights are relative until the last step.
namespace tabor::synthesis {
namespace {

using std::numbers::pi;

constexpr double kSmallestCrater = 50e-6;  // diameter [m]
constexpr double kLargestCrater = 150e-6;  // diameter [m]
constexpr double kTypicalCrater = 90e-6;   // diameter [m], the median
constexpr double kCoverage = 2;            // crater area over scan area
constexpr double kCraterStretch = 1.15;    // rolling lengthens craters along x ...
constexpr double kRoughnessStretch = 1.3;  // ... and the finer roughness more
constexpr double kWallWidth = 0.1;         // of a crater, over its radius
constexpr double kShoulder = 0.35;         // raised rim over crater depth
constexpr double kPlateauCap = 0.5;        // rms heights at which rolling stops the plateaus
constexpr double kPlateauShare = 0.12;     // of the area
constexpr double kPlateauRelief = 0.1;     // what rolling leaves of the height above a plateau
constexpr double kSplit = 25e-6;           // [m], shorter roughness survives rolling
constexpr double kFineShare = 0.5;         // rms of the finer roughness over that of the craters
constexpr double kFineRollOff = 60e-6;     // [m]
constexpr double kRollOff = 100e-6;        // [m], of the power law
constexpr double kOutlineIrregularity = 0.06;
constexpr std::size_t kOutlineModes = 5;  // 2 to 6 lobes

enum Stream : std::uint64_t {
  kRoughnessStream = 1,
  kCraterStream = 2,
  kGrooveStream = 3,
  kPlateauStream = 4
};

/// One spark's mark.
struct Crater {
  double x, y;    // centre [m]
  double radius;  // [m]
  double level;   // of its floor, relative
  double depth;
  std::array<std::complex<double>, kOutlineModes> outline;  // of lobes 2, 3, ...
};

Crater draw_crater(const CounterRandom& random, std::uint64_t number, const Grid& grid) {
  const std::uint64_t k = 32 * number;  // numbers k ... k + 31 belong to this crater
  Crater crater;
  crater.x = random.uniform(k) * grid.lx;
  crater.y = random.uniform(k + 1) * grid.ly;
  const double diameter =
      kSmallestCrater * std::pow(kLargestCrater / kSmallestCrater, random.uniform(k + 2));
  crater.radius = diameter / 2;
  crater.depth = std::pow(diameter / kTypicalCrater, 0.7);
  crater.level = 0.3 * random.normal(k + 3);
  for (std::size_t lobe = 0; lobe < kOutlineModes; ++lobe) {
    crater.outline[lobe] = std::polar(kOutlineIrregularity * random.normal(k + 4 + 2 * lobe),
                                      2 * pi * random.uniform(k + 5 + 2 * lobe));
  }
  return crater;
}

/// Distance from the centre over the outline's radius in that direction.
double relative_radius(const Crater& crater, double x, double y) {
  const double r = std::hypot(x, y);
  if (r == 0) return 0;
  const std::complex<double> direction(x / r, y / r);
  std::complex<double> turn = direction;
  double outline = 1;
  for (const auto& lobe : crater.outline) {
    turn *= direction;
    outline += (turn * lobe).real();
  }
  return r / (crater.radius * std::max(outline, 0.5));
}

/// Share of the old surface that the spark removes: 1 inside, 0 outside.
double removal(double r) { return 0.5 * (1 - std::tanh((r - 1) / kWallWidth)); }

/// The pixels around a crater, each once even where the crater is larger than the scan.
struct Patch {
  Index x0, y0, nx, ny;
};

Patch patch_of(const Crater& crater, const Grid& grid) {
  const double reach = 1.9 * crater.radius * std::sqrt(kCraterStretch);
  const auto span = [reach](double centre, double spacing, Index n, Index& first, Index& count) {
    const auto half = static_cast<Index>(std::ceil(reach / spacing));
    count = std::min(2 * half + 1, n);
    first = static_cast<Index>(centre / spacing) - count / 2;
  };
  Patch patch{};
  span(crater.x, grid.dx(), grid.nx, patch.x0, patch.nx);
  span(crater.y, grid.dy(), grid.ny, patch.y0, patch.ny);
  return patch;
}

Index wrapped(Index i, Index n) { return ((i % n) + n) % n; }

/// Replaces the surface inside the crater by its floor, tied to the mean height found there, and
/// raises a shoulder around it.
void strike(Field& z, const Grid& grid, const Crater& crater) {
  const Patch patch = patch_of(crater, grid);
  const double root = std::sqrt(kCraterStretch);
  const auto radius_at = [&](Index row, Index column) {
    const double x = static_cast<double>(patch.x0 + column) * grid.dx() - crater.x;
    const double y = static_cast<double>(patch.y0 + row) * grid.dy() - crater.y;
    return relative_radius(crater, x / root, y * root);
  };
  Field radius(patch.ny, patch.nx);
  const auto sums = sum_over_rows<2>(patch.ny, [&](Index row) {
    Eigen::Array2d total = Eigen::Array2d::Zero();
    const Index y = wrapped(patch.y0 + row, grid.ny);
    for (Index column = 0; column < patch.nx; ++column) {
      radius(row, column) = radius_at(row, column);
      const double share = radius(row, column) < 1.8 ? removal(radius(row, column)) : 0;
      total += Eigen::Array2d(share * z(y, wrapped(patch.x0 + column, grid.nx)), share);
    }
    return total;
  });
  const double floor = crater.level + (sums[1] > 0 ? 0.25 * sums[0] / sums[1] : 0);
  for_each_row(patch.ny, [&](Index row) {
    const Index y = wrapped(patch.y0 + row, grid.ny);
    for (Index column = 0; column < patch.nx; ++column) {
      const double r = radius(row, column);
      if (r < 1.8) {
        const double share = removal(r);
        const double bowl = -crater.depth * (1 - 0.35 * std::pow(std::min(r, 1.3), 2));
        const double shoulder = kShoulder * std::exp(-std::pow((r - 1.25) / 0.18, 2));
        double& height = z(y, wrapped(patch.x0 + column, grid.nx));
        height = (height + shoulder) * (1 - share) + (floor + bowl) * share;
      }
    }
  });
}

/// Zero mean, unit mean square.
void normalise(Field& z) {
  z -= sum(z) / static_cast<double>(z.size());
  const double square = sum_over_rows<1>(
      z.rows(), [&](Index y) { return Eigen::Array<double, 1, 1>(z.row(y).square().sum()); })[0];
  if (square > 0) z /= std::sqrt(square / static_cast<double>(z.size()));
}

Field crater_field(const Grid& grid, std::uint64_t seed) {
  Field z = Field::Zero(grid.ny, grid.nx);
  const CounterRandom random(seed, kCraterStream);
  const double crater_area = pi / 4 * kTypicalCrater * kTypicalCrater;
  const auto n_craters =
      std::max<std::uint64_t>(1, static_cast<std::uint64_t>(kCoverage * grid.area() / crater_area));
  for (std::uint64_t number = 0; number < n_craters; ++number) {
    strike(z, grid, draw_crater(random, number, grid));
  }
  normalise(z);
  // Skin-pass rolling: what stands above the plateaus is pressed down.
  z = (z > 0).select(kPlateauCap * (z / kPlateauCap).tanh(), z);
  normalise(z);
  return z;
}

Field roughness(const Grid& grid, double hurst, double roll_off, double stretch, std::uint64_t seed,
                Stream stream) {
  const double corner = 2 * pi / roll_off;
  auto field = random_field({grid, stretch, true, seed, stream, [&](double q) {
                               return std::pow(std::max(q / corner, 1.0), -2 * (1 + hurst));
                             }});
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

/// Skin-pass rolling of a normalised field: the highest parts become plateaus of nearly one height.
void press(Field& z) {
  const double plateau = quantile(z, 1 - kPlateauShare);
  z = (z > plateau).select(plateau + kPlateauRelief * (z - plateau), z);
}

/// Self-affine roughness of wavelengths from `shortest` to `longest`, in units of the whole.
Field roughness_band(const Grid& grid, const Edt& recipe, double shortest, double longest,
                     Stream stream) {
  const double corner = 2 * pi / kFineRollOff, low = 2 * pi / longest, high = 2 * pi / shortest;
  const double modes = grid.area() / (4 * pi * pi);  // per unit of wavevector area
  const double variance = pi * corner * corner * (1 + 1 / recipe.hurst) * modes;  // of all bands
  return random_field({grid, kRoughnessStretch, true, recipe.seed, stream,
                       [&](double q) {
                         return q < low || q >= high
                                    ? 0
                                    : std::pow(std::max(q / corner, 1.0), -2 * (1 + recipe.hurst)) /
                                          variance;
                       }})
      .height;
}

/// Periodic and unscaled. The roughness shorter than the split is added after rolling: it is what
/// makes pockets on top of the plateaus.
Field virgin_surface(const Grid& grid, const Edt& recipe) {
  constexpr double all = std::numeric_limits<double>::infinity();
  Field z = crater_field(grid, recipe.seed);
  z += kFineShare * roughness_band(grid, recipe, kSplit, all, kRoughnessStream);
  press(z);
  z += kFineShare * roughness_band(grid, recipe, 0, kSplit, kPlateauStream);
  impose_power_law(z, grid, recipe.hurst, 2 * pi / kRollOff, kRoughnessStretch);
  return z;
}

/// Sliding flattens what stands above the quantile to a tenth of its height and scratches grooves
/// into the flats along x.
void slide(Field& z, const Grid& grid, const Edt& recipe) {
  constexpr double untouched = 0.8;
  constexpr double flattening = 0.1;
  const double groove_depth = 0.06 * recipe.mean_abs_height;  // rms
  const double transition = 0.2 * recipe.mean_abs_height;
  const double tops = quantile(z, untouched);
  const Field grooves = roughness(grid, 0.7, 95e-6, 40, recipe.seed, kGrooveStream);
  for_each_row(grid.ny, [&](Index y) {
    for (Index x = 0; x < grid.nx; ++x) {
      const double above = z(y, x) - tops;
      const double t = std::clamp(above / transition + 1, 0.0, 1.0);
      z(y, x) = tops + (above > 0 ? flattening * above : above) +
                t * t * (3 - 2 * t) * groove_depth * grooves(y, x);
    }
  });
}

void scale_to(Field& z, double mean_abs_height) {
  z -= sum(z) / static_cast<double>(z.size());
  const double mean_abs =
      sum_over_rows<1>(
          z.rows(), [&](Index y) { return Eigen::Array<double, 1, 1>(z.row(y).abs().sum()); })[0] /
      static_cast<double>(z.size());
  z *= mean_abs_height / mean_abs;
}

/// A cut-out's parent: large enough that opposite edges of the cut-out are not neighbours.
Grid parent_grid(const Grid& grid) {
  const auto larger = [](Index n, double spacing) {
    return spectral::good_fft_size(n + static_cast<Index>(std::ceil(2 * kLargestCrater / spacing)));
  };
  const Index nx = larger(grid.nx, grid.dx()), ny = larger(grid.ny, grid.dy());
  return {nx, ny, static_cast<double>(nx) * grid.dx(), static_cast<double>(ny) * grid.dy()};
}

void check_recipe(const Edt& recipe) {
  check_grid(recipe.grid, "EDT surface");
  check_positive("Sa of the EDT surface", recipe.mean_abs_height);
  if (!(recipe.hurst > 0 && recipe.hurst <= 1)) {
    throw InputError("Hurst exponent", fmt::format("{}", recipe.hurst), "0 < H <= 1", "");
  }
  if (recipe.grid.nx < 4 || recipe.grid.ny < 4) {
    throw InputError("EDT surface", fmt::format("{} x {} pixels", recipe.grid.nx, recipe.grid.ny),
                     "at least 4 x 4 pixels", "");
  }
}

std::string describe(const Edt& recipe) {
  return fmt::format("generate edt: {} sliding, Sa before sliding {}, H = {}, {}, seed {}",
                     recipe.stage == EdtStage::before ? "before" : "after",
                     format_si(recipe.mean_abs_height, "m"), recipe.hurst,
                     recipe.periodic ? "periodic" : "not periodic", recipe.seed);
}

}  // namespace

topography::Topography edt(const Edt& recipe) {
  check_recipe(recipe);
  const Grid grid = recipe.periodic ? recipe.grid : parent_grid(recipe.grid);
  Field z = virgin_surface(grid, recipe);
  if (!recipe.periodic) z = Field(z.topLeftCorner(recipe.grid.ny, recipe.grid.nx));
  scale_to(z, recipe.mean_abs_height);
  if (recipe.stage == EdtStage::after) {
    slide(z, recipe.grid, recipe);
    z -= sum(z) / static_cast<double>(z.size());
  }
  return generated(recipe.grid, std::move(z), recipe.periodic, describe(recipe));
}

}  // namespace tabor::synthesis
