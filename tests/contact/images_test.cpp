// The contact of a map of 2 x 2 mirror images, solved on one of them, is that of the whole map.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <utility>

#include "contact/surfaces.hpp"
#include "tabor/contact/stiffness.hpp"
#include "tabor/contact/trapped/pockets.hpp"
#include "tabor/contact/trapped_liquid.hpp"
#include "tabor/core/mirror_images.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/core/random.hpp"

namespace tabor::test {
namespace {

/// Hides from the solver that maps may consist of images.
class Whole final : public elastic::ElasticOperator {
 public:
  explicit Whole(const Grid& grid) : periodic_(elastic::make_periodic(grid, 1.0)) {}

  const Grid& grid() const override { return periodic_->grid(); }
  double effective_modulus() const override { return periodic_->effective_modulus(); }
  elastic::Border border() const override { return periodic_->border(); }
  double fft_seconds() const override { return periodic_->fft_seconds(); }
  void apply(const Field& pressure, Field& displacement) override {
    periodic_->apply(pressure, displacement);
  }
  void apply(const FieldF& pressure, FieldF& displacement) override {
    periodic_->apply(pressure, displacement);
  }
  std::unique_ptr<ElasticOperator> on_grid(const Grid& grid) const override {
    return std::make_unique<Whole>(grid);
  }
  bool apply_inverse(const Field& displacement, Field& pressure) override {
    return periodic_->apply_inverse(displacement, pressure);
  }

 private:
  std::unique_ptr<elastic::ElasticOperator> periodic_;
};

/// A quarter without symmetries of its own, and borders that do not match.
Field rough_quarter(Index ny, Index nx) {
  return self_affine(128, 0.8, 2, 40, 5).block(3, 17, ny, nx);
}

Grid grid_of(const Field& map) {
  return {map.cols(), map.rows(), 1.0,
          static_cast<double>(map.rows()) / static_cast<double>(map.cols())};
}

struct Pair {
  contact::State whole;
  contact::State image;
};

Pair solve_both(const contact::Problem& problem, contact::Solver solver = contact::Solver::fast) {
  const Grid grid = grid_of(problem.height);
  Whole whole(grid);
  return {contact::solve(whole, problem, solver),
          contact::solve(*elastic::make_periodic(grid, 1.0), problem, solver)};
}

void expect_same(const Pair& pair) {
  const auto& [whole, image] = pair;
  ASSERT_TRUE(whole.convergence.converged());
  ASSERT_TRUE(image.convergence.converged());
  for (const Field* map : {&image.pressure, &image.displacement, &image.gap}) {
    EXPECT_TRUE(consists_of_images(*map, 0));
  }
  const double p = whole.mean_pressure;
  EXPECT_NEAR(image.mean_pressure / p, 1, 1e-6);
  EXPECT_LE((image.pressure - whole.pressure).abs().mean(), 1e-4 * p);
  const double range = whole.displacement.maxCoeff() - whole.displacement.minCoeff();
  EXPECT_LE((image.displacement - whole.displacement).abs().maxCoeff(), 1e-5 * range);
  EXPECT_LE((image.gap - whole.gap).abs().maxCoeff(), 1e-5 * range);
  EXPECT_NEAR(image.separation, whole.separation, 1e-5 * range);
}

TEST(ContactOfImages, IsThatOfTheWholeMap) {
  for (const auto& [ny, nx] : {std::pair<Index, Index>{64, 64}, {75, 48}, {41, 90}, {5, 7}}) {
    SCOPED_TRACE(testing::Message() << ny << " x " << nx);
    const Field height = mirror_images(rough_quarter(ny, nx));
    for (const double cap : {contact::kNoSaturation, 0.3}) {
      const contact::Problem problem{.height = height,
                                     .control = contact::MeanPressure{0.05},
                                     .bounds = {.upper = cap},
                                     .tolerance = 1e-9};
      expect_same(solve_both(problem));
    }
  }
}

TEST(ContactOfImages, IsThatOfTheWholeMapForTheTextbookSolver) {
  const contact::Problem problem{.height = mirror_images(rough_quarter(40, 32)),
                                 .control = contact::MeanPressure{0.05},
                                 .tolerance = 1e-9};
  expect_same(solve_both(problem, contact::Solver::polonsky_keer));
}

TEST(ContactOfImages, IsThatOfTheWholeMapAtASeparationOffZeroWithBoundsAndAStart) {
  contact::Problem problem{.height = 1000 + mirror_images(rough_quarter(64, 50)),
                           .control = contact::MeanPressure{0.05},
                           .tolerance = 1e-8};
  const contact::State first = solve_both(problem).whole;
  problem.control = contact::Separation{first.separation};
  expect_same(solve_both(problem));
  problem.start = first.pressure;
  problem.bounds.upper_of_each = mirror_images<Field>(0.3 + 0.05 * Field::Random(64, 50));
  problem.control = contact::MeanPressure{0.04};
  expect_same(solve_both(problem));
}

TEST(ContactOfImages, FlattensTheWholeMapUnderAHighPressure) {
  const contact::Problem problem{.height = mirror_images(rough_quarter(64, 64)),
                                 .control = contact::MeanPressure{50},
                                 .tolerance = 1e-9};
  const Pair pair = solve_both(problem);
  expect_same(pair);
  EXPECT_TRUE((pair.image.pressure > 0).all());
}

TEST(ContactOfImages, IsNotTakenWhereOneMapDiffers) {
  contact::Problem problem{.height = mirror_images(rough_quarter(32, 32)),
                           .control = contact::MeanPressure{0.05},
                           .tolerance = 1e-9};
  problem.height(40, 9) += 1e-3;
  const Pair pair = solve_both(problem);
  EXPECT_TRUE((pair.image.pressure == pair.whole.pressure).all());
  problem.height = mirror_images(rough_quarter(32, 32));
  problem.bounds.upper_of_each = Field::Constant(64, 64, 0.3);
  problem.bounds.upper_of_each(1, 1) = 0.2;
  const Pair bounded = solve_both(problem);
  EXPECT_TRUE((bounded.image.pressure == bounded.whole.pressure).all());
}

TEST(ContactOfImages, HasTheStiffnessOfTheWholeMap) {
  const contact::Problem problem{.height = mirror_images(rough_quarter(64, 48)),
                                 .control = contact::MeanPressure{0.05},
                                 .tolerance = 1e-9};
  const Grid grid = grid_of(problem.height);
  Whole whole(grid);
  const auto periodic = elastic::make_periodic(grid, 1.0);
  const contact::State state = contact::solve(*periodic, problem);
  const contact::Stiffness expected =
      contact::contact_stiffness(whole, state, contact::kNoSaturation);
  const contact::Stiffness found =
      contact::contact_stiffness(*periodic, state, contact::kNoSaturation);
  ASSERT_TRUE(found.convergence.converged());
  EXPECT_NEAR(found.value / expected.value, 1, 1e-5);
}

/// Oil up to the mean height of the pixels around, as rain leaves it in hollows.
Field oil_in_hollows(const Field& height) {
  const Index ny = height.rows();
  const Index nx = height.cols();
  Field film(ny, nx);
  for (Index y = 0; y < ny; ++y) {
    for (Index x = 0; x < nx; ++x) {
      const double around = height(y, (x + 1) % nx) + height(y, (x + nx - 1) % nx) +
                            height((y + 1) % ny, x) + height((y + ny - 1) % ny, x);
      film(y, x) = std::max(0.0, 0.5 * around / 4 - 0.5 * height(y, x));
    }
  }
  return film;
}

TEST(ContactOfImages, TrapsTheOilOfTheWholeMap) {
  for (const double pressure : {0.05, 0.2}) {
    for (const double cap : {contact::kNoSaturation, 0.5}) {
      SCOPED_TRACE(testing::Message() << pressure << ", cap " << cap);
      const contact::Problem problem{.height = mirror_images(rough_quarter(64, 50)),
                                     .control = contact::MeanPressure{pressure},
                                     .bounds = {.upper = cap},
                                     .tolerance = 1e-8};
      const Field film = mirror_images(first_image(oil_in_hollows(problem.height)));
      Whole whole(grid_of(problem.height));
      const auto periodic = elastic::make_periodic(grid_of(problem.height), 1.0);
      const contact::State dry = contact::solve(*periodic, problem);
      const contact::TrappedState expected =
          contact::solve_trapped(whole, problem, {.film = film, .bulk_modulus = 0.5}, dry);
      const contact::TrappedState found =
          contact::solve_trapped(*periodic, problem, {.film = film, .bulk_modulus = 0.5}, dry);
      expect_same({expected.contact, found.contact});
      EXPECT_GT(expected.liquid.n_squeezed, 8);
      EXPECT_EQ(found.liquid.n_pockets, expected.liquid.n_pockets);
      EXPECT_EQ(found.liquid.n_squeezed, expected.liquid.n_squeezed);
      EXPECT_EQ(found.liquid.n_at_seal, expected.liquid.n_at_seal);
      EXPECT_EQ(found.liquid.seal_rounds, expected.liquid.seal_rounds);
      EXPECT_NEAR(found.liquid.load_share / expected.liquid.load_share, 1, 1e-3);
      EXPECT_NEAR(found.liquid.pocket_volume / expected.liquid.pocket_volume, 1, 1e-12);
      EXPECT_NEAR(found.liquid.open_volume, expected.liquid.open_volume,
                  1e-12 * expected.liquid.pocket_volume);
      EXPECT_NEAR(found.liquid.leaked_fraction, expected.liquid.leaked_fraction, 1e-3);
      EXPECT_LE((found.liquid_pressure - expected.liquid_pressure).abs().mean(),
                1e-3 * expected.liquid_pressure.mean());
    }
  }
}

/// Regions that run through the cell of 2 x 2 images reach opposite borders of one.
TEST(ContactOfImages, HasThePocketsOfTheWholeMap) {
  const Grid grid{6, 5, 6.0, 5.0};
  const CounterRandom random(3);
  for (std::uint64_t map = 0; map < 300; ++map) {
    Mask contact(grid.ny, grid.nx);
    Field film(grid.ny, grid.nx);
    for (Index i = 0; i < contact.size(); ++i) {
      const auto place = 1000 * map + static_cast<std::uint64_t>(2 * i);
      contact(i) = random.uniform(place) < 0.45;
      film(i) = std::max(0.0, random.uniform(place + 1) - 0.6);
    }
    const contact::Pockets one =
        contact::find_pockets(contact, film, grid, elastic::Border::mirrors);
    const contact::Pockets all =
        contact::find_pockets(mirror_images(contact), mirror_images(film), {12, 10, 12.0, 10.0},
                              elastic::Border::repeats);
    EXPECT_EQ(std::accumulate(one.copies.begin(), one.copies.end(), std::size_t{0}), all.size());
    EXPECT_NEAR(4 * one.open_volume, all.open_volume, 1e-12);
    for (Index y = 0; y < grid.ny; ++y) {
      for (Index x = 0; x < grid.nx; ++x) {
        const auto i = static_cast<std::size_t>(y * grid.nx + x);
        const auto j = static_cast<std::size_t>(y * 2 * grid.nx + x);
        EXPECT_EQ(one.of[i] == contact::kNoPocket, all.of[j] == contact::kNoPocket);
        EXPECT_EQ(one.open[i], all.open[j]);
      }
    }
  }
}

TEST(ContactOfImages, HasTheSameBitsForAnyThreadCount) {
  const contact::Problem problem{.height = mirror_images(rough_quarter(100, 90)),
                                 .control = contact::MeanPressure{0.05}};
  const auto solve_with = [&](int threads) {
    set_thread_count(threads);
    return contact::solve(*elastic::make_periodic(grid_of(problem.height), 1.0), problem);
  };
  const contact::State one = solve_with(1);
  const contact::State three = solve_with(3);
  set_thread_count(0);
  EXPECT_TRUE((one.pressure == three.pressure).all());
  EXPECT_TRUE((one.gap == three.gap).all());
}

}  // namespace
}  // namespace tabor::test
