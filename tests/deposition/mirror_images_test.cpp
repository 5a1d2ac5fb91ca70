// Rain on a map of 2 x 2 mirror images, which falls on one of them.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tabor/core/mirror_images.hpp"
#include "tabor/core/random.hpp"
#include "tabor/deposition/deposition.hpp"
#include "tabor/deposition/images.hpp"

namespace tabor::deposition {
namespace {

constexpr Index kNx = 24, kNy = 20;
constexpr Grid kQuarter{kNx, kNy, kNx * 1e-6, kNy * 1e-6};
constexpr Grid kWhole{2 * kNx, 2 * kNy, 2 * kNx * 1e-6, 2 * kNy * 1e-6};

Field rough_quarter() {
  const CounterRandom random(11);
  return Field::NullaryExpr(kNy, kNx, [&](Index y, Index x) {
    const auto place = static_cast<std::uint64_t>(y * kNx + x);
    return 1e-6 * (random.uniform(place) + 0.3 * std::sin(0.5 * static_cast<double>(x)));
  });
}

Dose dose_with(Model model, Edge edge, std::uint64_t seed = 1) {
  return {.mean_films = {0.3e-7, 2e-7},
          .droplet_height = 1e-8,
          .model = model,
          .edge = edge,
          .seed = seed,
          .mirrored = true};
}

TEST(RainOnMirrorImages, IsThatOfTheFirstWithWalls) {
  const Field quarter = rough_quarter();
  const Field whole = mirror_images(quarter);
  for (const Model model : {Model::droplets, Model::limit}) {
    for (const Edge edge : {Edge::closed, Edge::periodic}) {
      const Dose dose = dose_with(model, edge);
      const std::vector<Film> films = deposit(whole, kWhole, dose);
      const std::vector<Film> expected = deposit(quarter, kQuarter, dose_of_image(dose));
      for (std::size_t i = 0; i < films.size(); ++i) {
        EXPECT_TRUE((films[i].thickness == mirror_images(expected[i].thickness)).all());
        EXPECT_EQ(films[i].request, i);
        EXPECT_EQ(films[i].n_droplets, 4 * expected[i].n_droplets);
        EXPECT_DOUBLE_EQ(films[i].dosed_volume, 4 * expected[i].dosed_volume);
        EXPECT_NEAR(
            films[i].deposited_volume, films[i].thickness.mean() * kWhole.area(),
            films[i].height_quantum * kWhole.area());  // less than a quantum lies above each pixel
        EXPECT_DOUBLE_EQ(films[i].wet_fraction, expected[i].wet_fraction);
        EXPECT_EQ(films[i].max_film, expected[i].max_film);
      }
    }
  }
}

TEST(RainOnMirrorImages, WetsTheFirstAtTheSameDoses) {
  const Field quarter = rough_quarter();
  const Field whole = mirror_images(quarter);
  const Dose dose = dose_with(Model::limit, Edge::closed);
  Mask where = Mask::Constant(whole.rows(), whole.cols(), true);
  where.bottomRightCorner(5, 7) = false;
  const std::vector<Film> films = deposit(whole, kWhole, dose);
  const FilmSink is_the_same = [&](Film&& film) {
    EXPECT_TRUE((film.thickness == films[film.request].thickness).all());
  };
  const auto first =
      first_wetting_doses(whole, kWhole, dose, {dose.mean_films, where}, is_the_same);
  for (Index p = 0; p < whole.size(); ++p) {
    std::size_t expected = where.data()[p] ? 0 : films.size();
    while (expected < films.size() && !(films[expected].thickness.data()[p] > 0)) ++expected;
    EXPECT_EQ(first[static_cast<std::size_t>(p)], expected) << p;
  }
}

TEST(RainOnMirrorImages, FallsOnTheWholeWhereLiquidRunsOffOrHeightsDiffer) {
  const Field whole = mirror_images(rough_quarter());
  EXPECT_FALSE(rains_on_one_image(whole, dose_with(Model::limit, Edge::open)));
  EXPECT_FALSE(rains_on_one_image(whole, dose_with(Model::uniform, Edge::closed)));
  Field other = whole;
  other(3, 2 * kNx - 1) += 1e-9;
  EXPECT_FALSE(rains_on_one_image(other, dose_with(Model::limit, Edge::closed)));
  other(3, 2 * kNx - 1) = whole(3, 2 * kNx - 1) + 1e-15;  // what a filter rounds
  EXPECT_TRUE(rains_on_one_image(other, dose_with(Model::limit, Edge::closed)));
  const Field odd = whole.leftCols(2 * kNx - 1);
  EXPECT_FALSE(rains_on_one_image(odd, dose_with(Model::limit, Edge::closed)));
}

/// Share of the map that is wet, mean over rains.
double mean_wet_fraction(const Field& whole, bool mirrored) {
  constexpr std::uint64_t n_rains = 60;
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= n_rains; ++seed) {
    Dose dose = dose_with(Model::droplets, Edge::closed, seed);
    dose.mirrored = mirrored;
    sum += deposit(whole, kWhole, dose).back().wet_fraction;
  }
  return sum / n_rains;
}

TEST(RainOnMirrorImages, WetsAsMuchInTheMeanAsRainOnTheWhole) {
  const Field whole = mirror_images(rough_quarter());
  EXPECT_NEAR(mean_wet_fraction(whole, true), mean_wet_fraction(whole, false), 2e-3);
}

}  // namespace
}  // namespace tabor::deposition
