// What must hold of every film, on surfaces small enough to see why.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/core/random.hpp"
#include "tabor/deposition/deposition.hpp"
#include "tabor/deposition/film_measures.hpp"
#include "tabor/deposition/terrain.hpp"

namespace tabor::deposition {
namespace {

constexpr double kMicrometre = 1e-6;

Grid grid_of(const Field& height) {
  return {height.cols(), height.rows(), kMicrometre * static_cast<double>(height.cols()),
          kMicrometre * static_cast<double>(height.rows())};
}

/// White noise smoothed once: pits of all depths, no ties.
Field rough(Index nx, Index ny, std::uint64_t seed) {
  const CounterRandom random(seed);
  Field noise(ny, nx);
  for (Index i = 0; i < noise.size(); ++i) {
    noise.data()[i] = kMicrometre * random.uniform(static_cast<std::uint64_t>(i));
  }
  Field height = noise;
  for (Index y = 0; y < ny; ++y) {
    for (Index x = 0; x < nx; ++x) height(y, x) += noise((y + 1) % ny, x) + noise(y, (x + 1) % nx);
  }
  return height;
}

Dose dose_of(std::vector<double> films, Model model = Model::droplets, Edge edge = Edge::closed) {
  Dose dose;
  dose.mean_films = std::move(films);
  dose.droplet_height = 0.002 * kMicrometre;
  dose.model = model;
  dose.edge = edge;
  return dose;
}

Film film_of(const Field& height, const Dose& dose) {
  return deposit(height, grid_of(height), dose).front();
}

double volume(const Film& film, const Field& height) {
  return film.thickness.sum() * grid_of(height).pixel_area();
}

/// Calls check(p, q) for every pair of neighbours of a closed map.
template <class Check>
void for_each_pair(const Field& field, Check check) {
  for (Index y = 0; y < field.rows(); ++y) {
    for (Index x = 0; x < field.cols(); ++x) {
      if (x + 1 < field.cols()) check(y, x, y, x + 1);
      if (y + 1 < field.rows()) check(y, x, y + 1, x);
    }
  }
}

TEST(Deposition, ConservesTheLiquidInEveryModelAndEdge) {
  const Field height = rough(40, 30, 1);
  for (const Model model : {Model::droplets, Model::limit, Model::bottom_fill, Model::uniform}) {
    for (const Edge edge : {Edge::closed, Edge::periodic, Edge::open}) {
      const Film film = film_of(height, dose_of({0.3 * kMicrometre}, model, edge));
      const double asked = 0.3 * kMicrometre * grid_of(height).area();
      EXPECT_NEAR(film.dosed_volume / asked, 1, 1e-5) << name(model) << name(edge);
      EXPECT_NEAR((film.deposited_volume + film.lost_volume) / film.dosed_volume, 1, 1e-12);
      EXPECT_NEAR(volume(film, height) / film.deposited_volume, 1, 1e-7);
    }
  }
}

TEST(Deposition, LosesLiquidOnlyOverOpenEdges) {
  const Field height = rough(40, 30, 1);
  const auto lost = [&](Edge edge) {
    return film_of(height, dose_of({0.3 * kMicrometre}, Model::droplets, edge)).lost_volume;
  };
  EXPECT_EQ(lost(Edge::closed), 0);
  EXPECT_EQ(lost(Edge::periodic), 0);
  EXPECT_GT(lost(Edge::open), 0);
}

/// 9 x 9 pixels of a square bowl: 0, 1, 2, 3, 4 um from the middle to the border.
Field bowl() {
  Field height(9, 9);
  for (Index y = 0; y < 9; ++y) {
    for (Index x = 0; x < 9; ++x) {
      height(y, x) = kMicrometre * static_cast<double>(std::max(std::abs(x - 4), std::abs(y - 4)));
    }
  }
  return height;
}

// What falls on the border is lost; the rest stays in the bowl until that is full to its rim.
TEST(Deposition, LosesWhatAnOpenBowlCannotHold) {
  const double pixel = kMicrometre * kMicrometre;                               // [m^2]
  const double capacity = (4 + 8 * 3 + 16 * 2 + 24 * 1) * kMicrometre * pixel;  // [m^3]
  for (const double mean_film : {0.5 * kMicrometre, 10 * kMicrometre}) {
    const Film film = film_of(bowl(), dose_of({mean_film}, Model::limit, Edge::open));
    const double dosed = 81 * mean_film * pixel;
    const double kept = std::min(49 * mean_film * pixel, capacity);
    EXPECT_NEAR(film.dosed_volume / dosed, 1, 1e-6);
    EXPECT_NEAR(film.deposited_volume / kept, 1, 1e-6);
    EXPECT_NEAR(film.lost_volume / (dosed - kept), 1, 1e-6);
    EXPECT_NEAR(film.thickness.sum() * pixel / kept, 1, 1e-6);
  }
}

TEST(Deposition, LeavesNeighbouringWetPixelsAtOneLevel) {
  const Field height = rough(50, 50, 2);
  for (const Model model : {Model::droplets, Model::limit}) {
    const Film film = film_of(height, dose_of({0.3 * kMicrometre}, model));
    for_each_pair(height, [&](Index y, Index x, Index v, Index u) {
      if (film.thickness(y, x) > 0 && film.thickness(v, u) > 0) {
        EXPECT_NEAR(height(y, x) + film.thickness(y, x), height(v, u) + film.thickness(v, u),
                    2 * film.height_quantum);
      }
    });
  }
}

TEST(Deposition, NeverRisesAboveARim) {
  const Field height = rough(50, 50, 3);
  for (const Model model : {Model::droplets, Model::limit}) {
    const Film film = film_of(height, dose_of({0.3 * kMicrometre}, model));
    const Field level = height + film.thickness;
    for_each_pair(height, [&](Index y, Index x, Index v, Index u) {
      const double slack = 2 * film.height_quantum;
      if (film.thickness(y, x) > 0) {
        EXPECT_LE(level(y, x), level(v, u) + slack);
      }
      if (film.thickness(v, u) > 0) {
        EXPECT_LE(level(v, u), level(y, x) + slack);
      }
    });
  }
}

TEST(Deposition, GrowsEverywhereWithTheDose) {
  const Field height = rough(40, 40, 4);
  for (const Model model : {Model::droplets, Model::limit, Model::bottom_fill}) {
    const auto films =
        deposit(height, grid_of(height),
                dose_of({0.1 * kMicrometre, 0.2 * kMicrometre, 3 * kMicrometre}, model));
    EXPECT_TRUE((films[1].thickness >= films[0].thickness).all());
    EXPECT_TRUE((films[2].thickness >= films[1].thickness).all());
  }
}

TEST(Deposition, PassesThroughLowerDosesAsIfTheyWereTheLast) {
  const Field height = rough(40, 40, 5);
  for (const Model model : {Model::droplets, Model::limit, Model::bottom_fill, Model::uniform}) {
    for (const Edge edge : {Edge::closed, Edge::open}) {
      const auto both = deposit(height, grid_of(height),
                                dose_of({0.4 * kMicrometre, 0.1 * kMicrometre}, model, edge));
      const Film low = film_of(height, dose_of({0.1 * kMicrometre}, model, edge));
      const Film high = film_of(height, dose_of({0.4 * kMicrometre}, model, edge));
      EXPECT_TRUE((both[1].thickness == low.thickness).all()) << name(model);
      EXPECT_TRUE((both[0].thickness == high.thickness).all()) << name(model);
      EXPECT_EQ(both[0].request, 0U);
    }
  }
}

TEST(Deposition, HasTheSameBitsForAnyNumberOfThreads) {
  const Field height = rough(60, 40, 6);
  const Dose dose = dose_of({0.3 * kMicrometre});
  set_thread_count(1);
  const Film one = film_of(height, dose);
  set_thread_count(4);
  const Film four = film_of(height, dose);
  set_thread_count(0);
  EXPECT_TRUE((one.thickness == four.thickness).all());
  EXPECT_EQ(one.n_droplets, four.n_droplets);
}

TEST(Deposition, FillsAFlatSurfaceUniformly) {
  const Field flat = Field::Constant(7, 9, 3 * kMicrometre);
  for (const Model model : {Model::droplets, Model::limit, Model::bottom_fill, Model::uniform}) {
    const Film film = film_of(flat, dose_of({0.5 * kMicrometre}, model));
    EXPECT_NEAR(film.thickness.minCoeff(), 0.5 * kMicrometre, 1e-4 * kMicrometre) << name(model);
    EXPECT_EQ(film.thickness.minCoeff(), film.thickness.maxCoeff()) << name(model);
    EXPECT_EQ(film.wet_fraction, 1);
    EXPECT_EQ(film.n_pools, 1);
  }
}

/// A plain at 1 um with one-pixel pits: depths in um at columns 2 and 5 of the middle row, and a
/// saddle between them at 0.8 um.
Field two_pits() {
  Field height = Field::Constant(3, 8, kMicrometre);
  height(1, 2) = 0;
  height(1, 3) = height(1, 4) = 0.8 * kMicrometre;
  height(1, 5) = 0.2 * kMicrometre;
  return height;
}

TEST(Deposition, FillsOnePitBeforeItsRimIsWet) {
  Field height = Field::Constant(5, 5, kMicrometre);
  height(2, 2) = 0;
  const double pit = kMicrometre / 25;  // mean film that just fills it
  for (const Model model : {Model::droplets, Model::limit}) {
    const Film below = film_of(height, dose_of({0.9 * pit}, model));
    EXPECT_EQ(below.n_pools, 1);
    EXPECT_NEAR(below.wet_fraction, 1.0 / 25, 1e-12);
    EXPECT_NEAR(below.thickness(2, 2), 0.9 * kMicrometre, 0.003 * kMicrometre);
    const Film above = film_of(height, dose_of({1.5 * pit}, model));
    EXPECT_EQ(above.wet_fraction, 1);
    EXPECT_NEAR(above.thickness(0, 0), 0.5 * pit, 0.003 * kMicrometre / 25);
    EXPECT_TRUE(above.flooded);
  }
}

TEST(Deposition, SpillsOnePitIntoTheOtherThenMergesThem) {
  const Field height = two_pits();
  const double to_saddle = 0.8 + 0.6;  // um * pixels under 0.8 um
  const double to_plain = to_saddle + 4 * 0.2;
  for (const Model model : {Model::droplets, Model::limit}) {
    const auto at = [&](double pixels) {
      return film_of(height, dose_of({pixels / 24 * kMicrometre}, model));
    };
    const Film both_full = at(to_saddle - 0.01);
    EXPECT_EQ(both_full.n_pools, 2);
    EXPECT_NEAR(both_full.thickness.sum(), (to_saddle - 0.01) * kMicrometre, 0.003 * kMicrometre);
    const Film merged = at(to_saddle + 0.4);
    EXPECT_EQ(merged.n_pools, 1);
    EXPECT_NEAR(merged.thickness(1, 3), 0.1 * kMicrometre, 0.003 * kMicrometre);
    EXPECT_NEAR(merged.thickness(1, 2), 0.9 * kMicrometre, 0.003 * kMicrometre);
    EXPECT_EQ(at(to_plain - 0.01).wet_fraction, 4.0 / 24);
  }
}

TEST(Deposition, PutsTheBottomFillUnderOneLevel) {
  const Field height = rough(40, 40, 7);
  const Film film = film_of(height, dose_of({0.2 * kMicrometre}, Model::bottom_fill));
  const Field level = height + film.thickness;
  const double highest_wet = (film.thickness > 0).select(level, 0).maxCoeff();
  const double lowest_wet = (film.thickness > 0).select(level, 1).minCoeff();
  EXPECT_NEAR(highest_wet, lowest_wet, 2 * film.height_quantum);
  EXPECT_GE((film.thickness > 0).select(1, height).minCoeff(), lowest_wet - film.height_quantum);
}

TEST(Deposition, LiteralReadingNeverRaisesMoreThanADroplet) {
  const Field flat = Field::Constant(4, 4, 0);
  Dose dose = dose_of({0.1 * kMicrometre});
  dose.reading = Reading::literal;
  dose.droplet_height = 0.1 * kMicrometre;
  const Film film = film_of(flat, dose);
  EXPECT_EQ(film.n_droplets, 1);  // one droplet raises all 16 pixels by its height
  EXPECT_NEAR(film.thickness(3, 3), 0.1 * kMicrometre, film.height_quantum);
}

TEST(Deposition, IsDryWithoutADose) {
  const Film film = film_of(rough(8, 8, 9), dose_of({0}));
  EXPECT_EQ(film.n_droplets, 0);
  EXPECT_EQ(film.wet_fraction, 0);
  EXPECT_EQ(film.n_pools, 0);
}

TEST(Deposition, RejectsInputThatMakesNoSense) {
  Field height = rough(8, 8, 11);
  const auto attempt = [&](const Dose& dose) { film_of(height, dose); };
  EXPECT_THROW(attempt(dose_of({})), InputError);
  EXPECT_THROW(attempt(dose_of({-1e-6})), InputError);
  EXPECT_THROW(attempt(dose_of({std::nan("")})), InputError);
  EXPECT_THROW(attempt(dose_of({1e9})), InputError);
  for (const double droplet : {0.0, -1e-7, std::nan(""), 1e-20, 1.0}) {
    Dose dose = dose_of({1e-7});
    dose.droplet_height = droplet;
    EXPECT_THROW(attempt(dose), InputError) << droplet;
  }
  height(3, 3) = std::nan("");
  EXPECT_THROW(attempt(dose_of({1e-7})), InputError);
  EXPECT_THROW(deposit(height, Grid{7, 8, 1, 1}, dose_of({1e-7})), InputError);
  height(3, 3) = 0;
  EXPECT_NO_THROW(deposit(height, Grid{8, 8, 1, 1}, dose_of({1e-7})));
  EXPECT_THROW(deposit(height, Grid{8, 8, 0, 1}, dose_of({1e-7})), InputError);
  EXPECT_THROW(deposit(height, Grid{8, 8, 1, 0}, dose_of({1e-7})), InputError);
}

TEST(Deposition, StopsWhenTheObserverAsksTo) {
  const Field height = rough(32, 32, 12);
  EXPECT_THROW(
      deposit(height, grid_of(height), dose_of({1e-7}), [](const Progress&) { return false; }),
      Interrupted);
}

/// Regions of wet pixels, found by spreading from one pixel to the next.
Index regions_by_spreading(const Field& film, bool periodic) {
  Mask open = film > 0;
  Index n_regions = 0;
  std::vector<std::pair<Index, Index>> next;
  const auto take = [&](Index y, Index x) {
    if (periodic) {
      y = (y + film.rows()) % film.rows();
      x = (x + film.cols()) % film.cols();
    }
    if (y >= 0 && x >= 0 && y < film.rows() && x < film.cols() && open(y, x)) {
      open(y, x) = false;
      next.emplace_back(y, x);
    }
  };
  for (Index i = 0; i < film.size(); ++i) {
    n_regions += open(i / film.cols(), i % film.cols()) ? 1 : 0;
    take(i / film.cols(), i % film.cols());
    while (!next.empty()) {
      const auto [y, x] = next.back();
      next.pop_back();
      take(y - 1, x);
      take(y + 1, x);
      take(y, x - 1);
      take(y, x + 1);
    }
  }
  return n_regions;
}

TEST(WetRegions, AreThoseThatSpreadingFinds) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const CounterRandom random(seed);
    Field film(1 + static_cast<Index>(seed % 7), 1 + static_cast<Index>(seed % 11));
    for (Index i = 0; i < film.size(); ++i) {
      const double share = 0.3 + 0.1 * static_cast<double>(seed % 5);
      film.data()[i] = random.uniform(static_cast<std::uint64_t>(i)) < share ? 1e-7 : 0;
    }
    for (const bool periodic : {false, true}) {
      EXPECT_EQ(count_wet_regions(film, periodic), regions_by_spreading(film, periodic)) << seed;
    }
  }
}

TEST(Quantise, PutsTheLowestHeightAboveTheLevelOfDryGround) {
  EXPECT_GT(quantise(bowl(), Edge::closed).height[40], kDry);
}

TEST(Quantise, RoundsToTheFinestQuantumThatFitsTheRange) {
  Field height(1, 3);
  height << -8e-6, 0, 8e-6;
  const Terrain terrain = quantise(height, Edge::closed);
  EXPECT_DOUBLE_EQ(terrain.quantum, 1e-12 / 256);
  EXPECT_NEAR((static_cast<double>(terrain.height[2]) - terrain.height[0]) * terrain.quantum, 16e-6,
              terrain.quantum);
  EXPECT_DOUBLE_EQ(quantise(height * 2, Edge::closed).quantum, 1e-12 / 128);
}

TEST(MeanFilm, IsTheDensityOverTheOilDensity) {
  EXPECT_DOUBLE_EQ(mean_film(0.45e-3, 900), 0.5e-6);
  EXPECT_THROW(mean_film(-1, 900), InputError);
  EXPECT_THROW(mean_film(1, 0), InputError);
}

TEST(DepositionNames, RoundTripAndSuggestTheNearest) {
  EXPECT_EQ(parse_model(name(Model::bottom_fill)), Model::bottom_fill);
  EXPECT_EQ(parse_reading(name(Reading::literal)), Reading::literal);
  EXPECT_EQ(parse_edge(name(Edge::open)), Edge::open);
  try {
    parse_model("droplet");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("did you mean 'droplets'"));
  }
}

}  // namespace
}  // namespace tabor::deposition
