// A saturation pressure of each pixel: projection, certificate, and contacts under such caps.
#include "tabor/contact/caps.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "contact/surfaces.hpp"
#include "support/rejection.hpp"
#include "tabor/contact/certificate.hpp"
#include "tabor/contact/projection.hpp"
#include "tabor/core/random.hpp"

namespace tabor::contact {
namespace {

using testing::HasSubstr;

std::vector<double> random_caps(std::size_t n, std::uint64_t seed) {
  const CounterRandom random(seed);
  std::vector<double> caps(n);
  for (std::size_t k = 0; k < n; ++k) caps[k] = 0.5 + random.uniform(k);
  return caps;
}

TEST(Caps, BoundProjectedPressuresEach) {
  constexpr std::size_t n = 5000;
  const std::vector<double> caps = random_caps(n, 1);
  const double most = std::accumulate(caps.begin(), caps.end(), 0.0);
  const CounterRandom random(2);
  std::vector<double> wanted(n);
  for (std::size_t k = 0; k < n; ++k) wanted[k] = random.normal(k);
  for (const double share : {1e-6, 0.1, 0.5, 0.999}) {
    std::vector<double> x = wanted;
    const double shift = shift_for_load(wanted, share * most, Caps(caps.data()));
    project_on_load(x, share * most, Caps(caps.data()));
    EXPECT_NEAR(std::accumulate(x.begin(), x.end(), 0.0) / (share * most), 1, 1e-13);
    for (std::size_t k = 0; k < n; ++k) {
      EXPECT_NEAR(x[k], std::clamp(wanted[k] - shift, 0.0, caps[k]), 1e-12);
    }
  }
}

TEST(Caps, AreFilledFromTheSmallestResidual) {
  // Pixel 2 takes its cap of 1, pixel 1 its 2, pixel 0 the rest: 1 * 0.5 + 2 * 1 + 0.5 * 2.
  const std::vector<double> caps{4, 2, 1};
  const std::vector<double> v{2.0, 1.0, 0.5};
  EXPECT_DOUBLE_EQ(duality_gap({{3.5, 0, 0}, v}, 3.5, Caps(caps.data())), 7 - 3.5);
  EXPECT_DOUBLE_EQ(duality_gap({{0.5, 2, 1}, v}, 3.5, Caps(caps.data())), 0);
  EXPECT_EQ(knapsack_threshold(v, 3.5, Caps(caps.data())), 2.0);
  EXPECT_EQ(knapsack_threshold(v, 2.5, Caps(caps.data())), 1.0);
}

struct UnderCaps {
  explicit UnderCaps(Index n) : grid{n, n, 1, 1}, elasticity(elastic::make_periodic(grid, 1.0)) {
    problem.height = test::self_affine(n, 0.8, 2, static_cast<double>(n) / 4, 3);
    problem.tolerance = 1e-9;
  }
  State solve(Solver solver = Solver::fast) const {
    return contact::solve(*elasticity, problem, solver);
  }

  Grid grid;
  std::unique_ptr<elastic::ElasticOperator> elasticity;
  Problem problem;
};

TEST(Caps, ThatAreAllAlikeGiveTheContactOfOne) {
  UnderCaps one(128);
  one.problem.control = MeanPressure{0.005};
  one.problem.bounds.upper = 0.03;
  const State expected = one.solve();
  one.problem.bounds.upper_of_each = Field::Constant(128, 128, 0.03);
  for (const Solver solver : {Solver::fast, Solver::polonsky_keer}) {
    const State found = one.solve(solver);
    EXPECT_TRUE(found.convergence.converged());
    EXPECT_TRUE((saturated_mask(found, 0.03) == saturated_mask(expected, 0.03)).all());
    EXPECT_NEAR(found.separation / expected.separation, 1, 1e-5);
    const Summary summary = summarise(found, one.problem, one.grid, true);
    const Summary of_one = summarise(expected, one.problem, one.grid, true);
    EXPECT_EQ(summary.saturated_area_fraction, of_one.saturated_area_fraction);
    EXPECT_GT(of_one.saturated_area_fraction, 0.01);
  }
}

TEST(Caps, OfEachPixelHoldOnlyThatPixel) {
  UnderCaps each(128);
  const std::vector<double> factors = random_caps(128 * 128, 5);
  each.problem.bounds.upper_of_each = 0.03 * Eigen::Map<const Field>(factors.data(), 128, 128);
  for (const double pressure : {1e-4, 0.005, 0.02}) {
    each.problem.control = MeanPressure{pressure};
    const State found = each.solve();
    const State other = each.solve(Solver::polonsky_keer);
    const Field& caps = each.problem.bounds.upper_of_each;
    ASSERT_TRUE(found.convergence.converged() && other.convergence.converged()) << pressure;
    EXPECT_NEAR(found.pressure.mean() / pressure, 1, 1e-12);
    EXPECT_TRUE((found.pressure <= caps).all());
    const Mask saturated = saturated_mask(found, Caps(caps.data()));
    const Mask inside = contact_mask(found) && !saturated;
    EXPECT_GT(saturated.count(), 0);
    // The contact conditions, from what the operator says of the pressure.
    Field gap;
    each.elasticity->apply(found.pressure, gap);
    gap += found.separation - each.problem.height;
    EXPECT_LE(inside.select(gap.abs(), 0).maxCoeff(), found.gap_limit);
    EXPECT_LE(saturated.select(gap, 0).maxCoeff(), found.gap_limit);
    EXPECT_GE(contact_mask(found).select(Field::Zero(128, 128), gap).minCoeff(), -found.gap_limit);
    EXPECT_NEAR((found.pressure - other.pressure).abs().mean() / pressure, 0, 1e-3);
  }
}

TEST(Caps, BelowTheMeanLeaveTheRestToOthers) {
  UnderCaps flat(64);
  flat.problem.height.setZero();
  flat.problem.control = MeanPressure{1.0};
  flat.problem.bounds.upper_of_each = Field::Constant(64, 64, 3.0);
  flat.problem.bounds.upper_of_each.leftCols(32).setConstant(0.4);
  const State found = flat.solve();
  EXPECT_TRUE(found.convergence.converged());
  EXPECT_NEAR(found.pressure.leftCols(32).maxCoeff(), 0.4, 1e-12);
  EXPECT_NEAR(found.pressure.leftCols(32).minCoeff(), 0.4, 1e-12);
  EXPECT_NEAR(found.pressure.rightCols(32).mean(), 1.6, 1e-10);
}

TEST(Caps, OfAnotherShapeOrTooLowAreRejected) {
  UnderCaps wrong(64);
  wrong.problem.control = MeanPressure{0.01};
  const auto message = [&](Field caps) {
    wrong.problem.bounds.upper_of_each = std::move(caps);
    return test::rejection([&] { wrong.solve(); });
  };
  EXPECT_THAT(message(Field::Constant(64, 32, 1)), HasSubstr("saturation pressures"));
  EXPECT_THAT(message(Field::Constant(64, 64, -1)), HasSubstr("saturation pressures"));
  EXPECT_THAT(message(Field::Constant(64, 64, 0.009)), HasSubstr("cap"));
}

}  // namespace
}  // namespace tabor::contact
