// The first dose that wets each pixel against films of all doses, laid one by one.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/core/random.hpp"
#include "tabor/deposition/deposition.hpp"

namespace tabor::deposition {
namespace {

constexpr Index kSide = 96;
constexpr Grid kGrid{kSide, kSide, kSide * 0.67e-6, kSide * 0.67e-6};

/// Noise on waves.
Field rough() {
  const CounterRandom random(7);
  return Field::NullaryExpr(kSide, kSide, [&](Index y, Index x) {
    const double noise = random.uniform(static_cast<std::uint64_t>(y * kSide + x));
    return 1e-6 * (noise + 2 * std::sin(0.3 * static_cast<double>(x + 2 * y)));
  });
}

/// Random heights of a few levels: many neighbours are equal.
Field steps(const Grid& grid, std::uint64_t seed) {
  const CounterRandom random(seed);
  const double n_levels = 2.0 + static_cast<double>(seed % 9);
  return Field::NullaryExpr(grid.ny, grid.nx, [&](Index y, Index x) {
    const auto place = static_cast<std::uint64_t>(y * grid.nx + x);
    return 1e-7 * std::floor(n_levels * random.uniform(place));
  });
}

/// How many pixels another dose wets first than films of all doses, laid one by one, say.
Index n_wrong(const Field& height, const Grid& grid, const Dose& dose, const Mask& where) {
  Dose no_films = dose;
  no_films.mean_films.clear();
  const auto first = first_wetting_doses(height, grid, no_films, {dose.mean_films, where}, {});
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
  const Field height = rough();
  for (const Edge edge : {Edge::closed, Edge::periodic, Edge::open}) {
    const Dose dose{
        .mean_films = {0, 1e-9, 1e-8, 1e-7, 3e-7, 1e-6, 2e-5}, .model = Model::limit, .edge = edge};
    Mask where = Mask::Constant(height.rows(), height.cols(), true);
    where(3, 5) = false;
    EXPECT_EQ(n_wrong(height, kGrid, dose, where), 0) << name(edge);
  }
}

TEST(FirstWettingDose, IsThatOfTheFirstFilmWhereHeightsAreEqual) {
  const Grid grid{9, 7, 9e-6, 7e-6};
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const CounterRandom random(seed);
    const Field height = steps(grid, seed);
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

TEST(FirstWettingDose, TakesRisingDosesOfRainAlone) {
  const Field height = rough();
  const Mask where = Mask::Constant(height.rows(), height.cols(), true);
  const auto find = [&](const Dose& dose, const Mask& pixels) {
    return first_wetting_doses(height, kGrid, {.mean_films = {}, .model = dose.model},
                               {dose.mean_films, pixels}, {});
  };
  const auto limit = [](std::vector<double> films) {
    return Dose{.mean_films = std::move(films), .model = Model::limit};
  };
  EXPECT_THROW(find(limit({2e-7, 1e-7}), where), InputError);
  EXPECT_THROW(find({.mean_films = {1e-7}, .model = Model::bottom_fill}, where), InputError);
  EXPECT_THROW(find(limit({1e-7}), Mask::Constant(1, 1, true)), InputError);
  EXPECT_THROW(find(limit(std::vector<double>(65536, 1e-7)), where), InputError);
}

/// How many films differ from those of a run of their own, and how many first doses from those of
/// the limit alone.
Index n_changed_together(const Field& height, const Grid& grid, const Dose& dose,
                         const Wetting& wetting) {
  Dose no_films = dose;
  no_films.mean_films.clear();
  no_films.model = Model::limit;
  const std::vector<Film> alone = deposit(height, grid, dose);
  Index n = 0;
  std::size_t n_films = 0;
  const FilmSink compare = [&](Film&& film) {
    const Film& expected = alone[film.request];
    const bool is_same = (film.thickness == expected.thickness).all() &&
                         film.dosed_volume == expected.dosed_volume &&
                         film.n_droplets == expected.n_droplets &&
                         film.lost_volume == expected.lost_volume;
    n += is_same ? 0 : 1;
    ++n_films;
  };
  const auto first = first_wetting_doses(height, grid, dose, wetting, compare);
  EXPECT_EQ(n_films, alone.size());
  n += first == first_wetting_doses(height, grid, no_films, wetting, {}) ? 0 : 1;
  return n;
}

// Doses of films below, between, at and above those of wetting, some of them twice; a surface
// without equal heights, and surfaces full of them.
TEST(FirstWettingDose, IsTheSameWithFilmsInTheSameRun) {
  Dose dose{.mean_films = {4e-7, 0, 1e-7, 5e-10, 1e-7, 3e-5}};
  const Wetting on_waves{{0, 1e-9, 1e-8, 1e-7, 3e-7, 3e-7, 1e-6, 2e-5},
                         Mask::Constant(kSide, kSide, true)};
  const Grid small{9, 7, 9e-6, 7e-6};
  for (const Model model : {Model::limit, Model::droplets}) {
    dose.model = model;
    for (const Edge edge : {Edge::closed, Edge::periodic, Edge::open}) {
      dose.edge = edge;
      EXPECT_EQ(n_changed_together(rough(), kGrid, dose, on_waves), 0) << name(edge);
      for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const Field height = steps(small, seed);
        const Wetting wetting{on_waves.mean_films, height > 1e-7};
        EXPECT_EQ(n_changed_together(height, small, dose, wetting), 0) << seed << ' ' << name(edge);
      }
    }
  }
}

}  // namespace
}  // namespace tabor::deposition
