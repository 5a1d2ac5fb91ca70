#include "tabor/synthesis/craters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "tabor/core/random.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/synthesis/streams.hpp"

namespace tabor::synthesis {
namespace {

using std::numbers::pi;

constexpr double kTypicalCrater = 90e-6;  // diameter [m], the median
constexpr double kCoverage = 2;           // crater area over scan area
constexpr double kCraterStretch = 1.15;   // rolling lengthens craters along x
constexpr double kWallWidth = 0.1;        // of a crater, over its radius
constexpr double kShoulder = 0.35;        // raised rim over crater depth
constexpr double kOutlineIrregularity = 0.06;
constexpr std::size_t kOutlineModes = 5;  // 2 to 6 lobes

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

}  // namespace

Field craters(const Grid& grid, std::uint64_t seed) {
  Field z = Field::Zero(grid.ny, grid.nx);
  const CounterRandom random(seed, kCraterStream);
  const double crater_area = pi / 4 * kTypicalCrater * kTypicalCrater;
  const auto n_craters =
      std::max<std::uint64_t>(1, static_cast<std::uint64_t>(kCoverage * grid.area() / crater_area));
  for (std::uint64_t number = 0; number < n_craters; ++number) {
    strike(z, grid, draw_crater(random, number, grid));
  }
  return z;
}

}  // namespace tabor::synthesis
