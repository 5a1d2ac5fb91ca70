// The limit of vanishing droplets against what defines it: stratified rain, every pixel once per
// sweep in a fixed permutation, droplets of 2 nm.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

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

}  // namespace
}  // namespace tabor::deposition
