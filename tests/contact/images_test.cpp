// The contact of a map of 2 x 2 mirror images, solved on one of them, is that of the whole map.
#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include "contact/surfaces.hpp"
#include "tabor/contact/stiffness.hpp"
#include "tabor/core/mirror_images.hpp"
#include "tabor/core/parallel.hpp"

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
