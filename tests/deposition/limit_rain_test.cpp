// The limit of vanishing droplets against what defines it: stratified rain, every pixel once per
// sweep in a fixed permutation, droplets of 2 nm.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/core/random.hpp"
#include "tabor/deposition/deposition.hpp"
#include "tabor/deposition/pools.hpp"
#include "tabor/deposition/router.hpp"

namespace tabor::deposition {
namespace {

constexpr Index kSide = 256;
constexpr Grid kGrid{kSide, kSide, kSide * 0.67e-6, kSide * 0.67e-6};

/// Noise of many wavelengths, down to the pixel, amplitudes as wavelength^0.75, Sa 0.9 um: the
/// scales of an electro-discharge textured sheet.
Field textured() {
  Field height = Field::Zero(kSide, kSide);
  std::uint64_t octave = 0;
  for (double wavelength = 224; wavelength >= 1; wavelength /= 1.7) {
    const CounterRandom random(7, ++octave);
    const auto knot = [&](Index i, Index j) {
      return random.uniform(static_cast<std::uint64_t>(i * 1024 + j)) - 0.5;
    };
    const auto blend = [](double t) { return t * t * (3 - 2 * t); };
    for (Index y = 0; y < kSide; ++y) {
      for (Index x = 0; x < kSide; ++x) {
        const double v = static_cast<double>(y) / wavelength;
        const double u = static_cast<double>(x) / wavelength;
        const auto i = static_cast<Index>(v);
        const auto j = static_cast<Index>(u);
        const double s = blend(v - static_cast<double>(i));
        const double t = blend(u - static_cast<double>(j));
        height(y, x) +=
            std::pow(wavelength, 0.75) * ((1 - s) * ((1 - t) * knot(i, j) + t * knot(i, j + 1)) +
                                          s * ((1 - t) * knot(i + 1, j) + t * knot(i + 1, j + 1)));
      }
    }
  }
  height -= height.mean();
  return height * (0.9e-6 / height.abs().mean());
}

Field stratified_rain(const Field& height, double film, double droplet_height) {
  const Terrain terrain = quantise(height, Edge::closed);
  Pools pools(terrain, Ties::connected);
  Router router(pools);
  const auto droplet = static_cast<Volume>(std::llround(droplet_height / terrain.quantum));
  const auto n_sweeps = std::llround(film / droplet_height);
  const Index n = height.size();
  const Index stride = 40503;  // odd, so coprime with 256^2: visits every pixel once per sweep
  for (Index k = 0; k < n * n_sweeps; ++k) {
    PoolId pool = router.from(router.slopes().from(static_cast<Pixel>(k % n * stride % n)));
    for (Volume carried = pools.pour(pool, droplet); carried > 0;
         carried = pools.pour(pool, carried)) {
      pool = router.from(pool);
    }
  }
  Field thickness(kSide, kSide);
  for (Pixel p = 0; p < terrain.size(); ++p) {
    const Height level = pools[pools.owner(pools.pool_at(p))].level;
    thickness.data()[p] = level > pools.height(p)
                              ? terrain.quantum * (static_cast<double>(level) - pools.height(p))
                              : 0;
  }
  return thickness;
}

TEST(LimitFill, IsWhatStratifiedRainOfTinyDropletsTendsTo) {
  const Field height = textured();
  Dose dose;
  dose.mean_films = {0.02e-6, 0.1e-6, 0.5e-6};
  dose.model = Model::limit;
  const auto films = deposit(height, kGrid, dose);
  for (const Film& film : films) {
    const Field rain = stratified_rain(height, film.mean_film, 2e-9);
    const double rms = std::sqrt((rain - film.thickness).square().mean());
    const auto differing = ((rain > 0) != (film.thickness > 0)).count();
    const double mask = static_cast<double>(differing) / static_cast<double>(height.size());
    EXPECT_LT(rms, 1.7e-9);   // the differences of static catchments that the
    EXPECT_LT(mask, 2.5e-4);  // specification of this model allows
  }
}

TEST(LimitFill, IsWhatRandomDropletsTendToAsTheyShrink) {
  const Field height = textured();
  Dose dose;
  dose.mean_films = {0.02e-6};
  dose.model = Model::limit;
  const Field limit = deposit(height, kGrid, dose).front().thickness;
  const auto distance = [&](double droplet_height) {
    dose.model = Model::droplets;
    dose.droplet_height = droplet_height;
    const Field difference = deposit(height, kGrid, dose).front().thickness - limit;
    return std::sqrt(difference.square().mean());
  };
  // The noise falls like the root of the number of droplets: 3.2 times for ten times as many.
  EXPECT_LT(distance(0.4e-9), distance(4e-9) / 2);
}

/// How many pixels another dose wets first than films of all doses, laid one by one, say.
Index n_wrong(const Field& height, const Grid& grid, const Dose& dose, const Mask& where) {
  const auto first = first_wetting_doses(height, grid, dose, where);
  const std::vector<Film> films = deposit(height, grid, dose);
  Index n = 0;
  for (Index p = 0; p < height.size(); ++p) {
    std::size_t expected = where.data()[p] ? 0 : films.size();
    while (expected < films.size() && !(films[expected].thickness.data()[p] > 0)) ++expected;
    n += first[static_cast<std::size_t>(p)] == expected ? 0 : 1;
  }
  return n;
}

TEST(FirstWettingDose, IsThatOfTheFirstFilmThatIsThere) {
  const Field height = textured();
  for (const Edge edge : {Edge::closed, Edge::periodic, Edge::open}) {
    const Dose dose{.mean_films = {0, 1e-8, 1e-7, 1e-6, 2e-5}, .model = Model::limit, .edge = edge};
    Mask where = Mask::Constant(height.rows(), height.cols(), true);
    where(3, 5) = false;
    EXPECT_EQ(n_wrong(height, kGrid, dose, where), 0) << name(edge);
  }
}

TEST(FirstWettingDose, IsThatOfTheFirstFilmWhereHeightsAreEqual) {
  const Grid grid{9, 7, 9e-6, 7e-6};
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const CounterRandom random(seed);
    const double n_levels = 2.0 + static_cast<double>(seed % 9);
    const Field height = Field::NullaryExpr(grid.ny, grid.nx, [&](Index y, Index x) {
      const auto place = static_cast<std::uint64_t>(y * grid.nx + x);
      return 1e-7 * std::floor(n_levels * random.uniform(place));
    });
    Dose dose{.mean_films = {0, 0}, .model = Model::limit};
    for (double film = 1e-9; film < 2e-6; film *= 1.0 + random.uniform(1000)) {
      dose.mean_films.push_back(film);
    }
    const Mask where = Mask::NullaryExpr(grid.ny, grid.nx, [&](Index y, Index x) {
      return random.uniform(static_cast<std::uint64_t>(2000 + y * grid.nx + x)) < 0.7;
    });
    for (const Edge edge : {Edge::closed, Edge::periodic, Edge::open}) {
      dose.edge = edge;
      EXPECT_EQ(n_wrong(height, grid, dose, where), 0) << seed << ' ' << name(edge);
    }
  }
}

TEST(FirstWettingDose, TakesRisingDosesOfTheLimitAlone) {
  const Field height = textured();
  const Mask where = Mask::Constant(height.rows(), height.cols(), true);
  const auto find = [&](const Dose& dose, const Mask& pixels) {
    return first_wetting_doses(height, kGrid, dose, pixels);
  };
  const auto limit = [](std::vector<double> films) {
    return Dose{.mean_films = std::move(films), .model = Model::limit};
  };
  EXPECT_THROW(find(limit({2e-7, 1e-7}), where), InputError);
  EXPECT_THROW(find({.mean_films = {1e-7}, .model = Model::droplets}, where), InputError);
  EXPECT_THROW(find({.mean_films = {1e-7}, .model = Model::bottom_fill}, where), InputError);
  EXPECT_THROW(find(limit({1e-7}), Mask::Constant(1, 1, true)), InputError);
  EXPECT_THROW(find(limit(std::vector<double>(65536, 1e-7)), where), InputError);
}

}  // namespace
}  // namespace tabor::deposition
