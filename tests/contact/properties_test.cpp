#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/surfaces.hpp"
#include "support/validation.hpp"
#include "tabor/contact/distributions.hpp"
#include "tabor/contact/stiffness.hpp"
#include "tabor/core/parallel.hpp"

namespace tabor::test {
namespace {

constexpr double kNoCap = contact::kNoSaturation;

TEST(SolveContact, KeepsBoundsLoadAndComplementarity) {
  const Field height = self_affine(128, 0.8, 1, 32, 3);
  for (const double cap : {kNoCap, 0.4, 0.05}) {
    for (const double mean_pressure : {0.001, 0.02, 0.045}) {
      const Solved solved = solve_unit(height, mean_pressure, cap);
      const auto& [state, summary] = solved;
      ASSERT_TRUE(state.convergence.converged());
      EXPECT_GE(state.pressure.minCoeff(), 0);
      EXPECT_LE(state.pressure.maxCoeff(), cap);
      EXPECT_NEAR(state.pressure.mean() / mean_pressure, 1, 1e-10);
      for (Index i = 0; i < height.size(); ++i) {
        const double p = state.pressure(i);
        const double gap = state.gap(i);
        ASSERT_TRUE(p <= 0 ? gap >= 0 : (p < cap ? gap == 0 : gap <= 0)) << p << " " << gap;
      }
      EXPECT_GE(summary.contact_area_fraction_pixels, mean_pressure / cap);
      EXPECT_GE(summary.contact_area_fraction, mean_pressure / cap);
    }
  }
}

TEST(SolveContact, GapDiffersFromItsDefinitionByTheCertificateOnly) {
  const Field height = self_affine(128, 0.8, 1, 32, 5);
  const Solved solved = solve_unit(height, 0.02, kNoCap, 1e-8);
  const Field raw = solved.state.separation + solved.state.displacement - height;
  const double rms = std::sqrt((height - height.mean()).square().mean());
  EXPECT_LE((raw - solved.state.gap).abs().maxCoeff(), 1e-6 * rms);
}

TEST(SolveContact, AreaGrowsWithTheLoad) {
  const Field height = self_affine(128, 0.8, 1, 32, 7);
  for (const double cap : {kNoCap, 0.3}) {
    double area = 0;
    for (const double mean_pressure : {0.001, 0.003, 0.01, 0.03, 0.1, 0.2}) {
      const double next =
          solve_unit(height, mean_pressure, cap).summary.contact_area_fraction_pixels;
      EXPECT_GE(next, area);
      area = next;
    }
  }
}

TEST(SolveContact, DoesNotDependOnTheUnitOfLength) {
  const Field height = self_affine(96, 0.8, 1, 24, 2);
  const Solved metres =
      solve_unit(height * 1e-5, 0.02, 0.5, 1e-9, contact::Solver::fast, true, 1e-5);
  const Solved nanometres =
      solve_unit(height * 1e4, 0.02, 0.5, 1e-9, contact::Solver::fast, true, 1e4);
  EXPECT_EQ(metres.summary.contact_area_fraction_pixels,
            nanometres.summary.contact_area_fraction_pixels);
  EXPECT_LE((metres.state.pressure - nanometres.state.pressure).abs().maxCoeff(), 1e-6 * 0.5);
  EXPECT_NEAR(metres.state.separation * 1e9 / nanometres.state.separation, 1, 1e-7);
}

TEST(SolveContact, TransposedSurfacesGiveTransposedPressures) {
  const Field height = self_affine(96, 0.8, 1, 24, 2);
  const Solved direct = solve_unit(height, 0.02, kNoCap, 1e-9);
  const Solved other = solve_unit(height.transpose(), 0.02, kNoCap, 1e-9);
  EXPECT_EQ(direct.summary.contact_area_fraction_pixels,
            other.summary.contact_area_fraction_pixels);
  EXPECT_LE((direct.state.pressure - other.state.pressure.transpose()).abs().maxCoeff(),
            1e-6 * direct.summary.max_pressure);
}

TEST(SolveContact, ShiftedSurfacesGiveShiftedPressures) {
  const Field height = self_affine(96, 0.8, 1, 24, 2);
  Field shifted(96, 96);
  for (Index y = 0; y < 96; ++y) {
    for (Index x = 0; x < 96; ++x) shifted((y + 31) % 96, (x + 50) % 96) = height(y, x);
  }
  const Solved direct = solve_unit(height, 0.02, kNoCap, 1e-9);
  const Solved other = solve_unit(shifted, 0.02, kNoCap, 1e-9);
  EXPECT_EQ(direct.summary.contact_area_fraction_pixels,
            other.summary.contact_area_fraction_pixels);
  EXPECT_EQ(direct.summary.n_patches, other.summary.n_patches);
  EXPECT_NEAR(direct.state.separation, other.state.separation, 1e-8);
}

TEST(SolveContact, HasTheSameBitsForAnyThreadCount) {
  const Field height = self_affine(192, 0.8, 1, 48, 4);
  for (const double cap : {kNoCap, 0.2}) {
    set_thread_count(1);
    const Solved one = solve_unit(height, 0.02, cap);
    for (const int threads : {2, 3}) {
      set_thread_count(threads);
      const Solved more = solve_unit(height, 0.02, cap);
      EXPECT_TRUE((one.state.pressure == more.state.pressure).all());
      EXPECT_TRUE((one.state.gap == more.state.gap).all());
      EXPECT_EQ(one.state.convergence.certificate, more.state.convergence.certificate);
    }
  }
  set_thread_count(0);
}

TEST(SolveContact, ReachesTheToleranceAskedFor) {
  const Field height = self_affine(128, 0.8, 1, 32, 6);
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
    for (const double cap : {kNoCap, 0.2}) {
      const auto& convergence = solve_unit(height, 0.02, cap, tolerance).state.convergence;
      EXPECT_TRUE(convergence.converged()) << tolerance << " " << convergence.certificate;
      EXPECT_LE(convergence.certificate, tolerance);
    }
  }
}

TEST(SolveContact, SolvesContactsOfSinglePixels) {
  Field height = Field::Zero(64, 64);
  height(20, 30) = 1e3;  // a spike nothing can flatten
  const Solved one = solve_unit(height, 1e-3);
  ASSERT_TRUE(one.state.convergence.converged());
  EXPECT_EQ(one.summary.contact_area_fraction_pixels, 1.0 / 4096);
  height(50, 7) = 1e3;
  const Solved two = solve_unit(height, 1e-3);
  ASSERT_TRUE(two.state.convergence.converged());
  EXPECT_EQ(two.summary.n_patches, 2);
  EXPECT_NEAR(two.state.pressure(20, 30), two.state.pressure(50, 7), 1e-6);
}

class Shapes : public testing::TestWithParam<std::pair<Index, Index>> {};

TEST_P(Shapes, ConvergeWhateverTheGrid) {
  const auto [ny, nx] = GetParam();
  Field height(ny, nx);
  for (Index i = 0; i < height.size(); ++i) {
    height(i) = 0.01 * CounterRandom(1).normal(static_cast<std::uint64_t>(i));
  }
  for (const bool periodic : {true, false}) {
    for (const double cap : {kNoCap, 0.1}) {
      const Solved solved = solve_unit(height, 0.03, cap, 1e-6, contact::Solver::fast, periodic);
      EXPECT_TRUE(solved.state.convergence.converged())
          << periodic << " " << cap << " " << solved.state.convergence.certificate;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    OddPrimeThinAndRectangular, Shapes,
    testing::Values(std::pair<Index, Index>{1, 64}, std::pair<Index, Index>{64, 1},
                    std::pair<Index, Index>{3, 5}, std::pair<Index, Index>{97, 89},
                    std::pair<Index, Index>{131, 257}, std::pair<Index, Index>{40, 200}));

TEST(SolveContact, AgreesOnNonSquarePixels) {
  const Field fine = wave(128, 0.01, true);
  Field coarse(128, 64);  // every second column: pixels twice as wide as high
  for (Index x = 0; x < 64; ++x) coarse.col(x) = 0.5 * (fine.col(2 * x) + fine.col(2 * x + 1));
  const Grid grid{64, 128, 1.0, 1.0};
  const auto elasticity = elastic::make_periodic(grid, 1.0);
  contact::Problem problem;
  problem.height = coarse;
  problem.control = contact::MeanPressure{0.01};
  const auto state = contact::solve(*elasticity, problem);
  ASSERT_TRUE(state.convergence.converged());
  const double area = contact::contact_mask(state).cast<double>().mean();
  EXPECT_NEAR(area, solve_unit(fine, 0.01).summary.contact_area_fraction_pixels, 0.01);
}

TEST(ContactStiffness, IsTheSlopeOfLoadAgainstSeparation) {
  const Field height = self_affine(128, 0.8, 1, 16, 8);
  const Grid grid = square(128);
  const auto elasticity = elastic::make_periodic(grid, 1.0);
  const Solved before = solve_unit(height, 0.0499, kNoCap, 1e-10);
  const Solved middle = solve_unit(height, 0.05, kNoCap, 1e-10);
  const Solved after = solve_unit(height, 0.0501, kNoCap, 1e-10);
  const auto stiffness = contact::contact_stiffness(*elasticity, middle.state, kNoCap);
  ASSERT_TRUE(stiffness.convergence.converged());
  const double slope = 0.0002 / (before.state.separation - after.state.separation);
  expect_within("Contact", "self-affine, P/(E* rms slope) = 0.05", "stiffness, relative",
                "central difference of the load", std::abs(stiffness.value / slope - 1), 1e-3);
}

TEST(ContactStiffness, IsThatOfAFlatPunchOnAFreePatch) {
  const Index n = 101;
  Field height = Field::Constant(n, n, -1.0);
  const double radius = 40.0 / static_cast<double>(n);
  for (Index i = 0; i < height.size(); ++i) {
    const double r =
        std::hypot(static_cast<double>(i % n - n / 2), static_cast<double>(i / n - n / 2));
    height(i) = r <= 40 ? 0.0 : -1.0;
  }
  const Grid grid = square(n);
  const auto elasticity = elastic::make_free(grid, 1.0);
  const Solved solved = solve_unit(height, 1e-3, kNoCap, 1e-9, contact::Solver::fast, false);
  const auto stiffness = contact::contact_stiffness(*elasticity, solved.state, kNoCap);
  expect_within("Contact", "flat punch, free, a/h = 40", "stiffness, relative", "2 a E*",
                std::abs(stiffness.value / (2 * radius) - 1), 1e-2);
}

TEST(ContactStiffness, IsInfiniteInFullContact) {
  const auto elasticity = elastic::make_periodic(square(32), 1.0);
  const Solved solved = solve_unit(wave(32, 0.01, true), 1.0);
  EXPECT_TRUE(std::isinf(contact::contact_stiffness(*elasticity, solved.state, kNoCap).value));
}

TEST(Distributions, CountEveryPixelAndPatchOnce) {
  const Field height = self_affine(128, 0.8, 1, 32, 3);
  const Solved solved = solve_unit(height, 0.02);
  const auto total = [](const contact::Histogram& histogram) {
    EXPECT_EQ(histogram.edges.size(), histogram.counts.size() + 1);
    Index sum = 0;
    for (const Index count : histogram.counts) sum += count;
    return sum;
  };
  const Index n_contact = contact::contact_mask(solved.state).count();
  EXPECT_EQ(total(contact::pressure_histogram(solved.state)), n_contact);
  EXPECT_EQ(total(contact::gap_histogram(solved.state)), height.size() - n_contact);
  EXPECT_EQ(total(contact::patch_area_histogram(solved.state, square(128), true)),
            solved.summary.n_patches);
}

TEST(LoadPath, ReloadingBelowTheOldMaximumIsElastic) {
  const Field height = self_affine(128, 0.8, 1, 32, 3);
  const double cap = 0.2;
  const Solved first = solve_unit(height, 0.02, cap, 1e-10);
  ASSERT_GT(first.summary.saturated_area_fraction, 0);
  const Field unloaded = contact::unloaded_height(height, first.state);
  EXPECT_TRUE((unloaded <= height).all());
  EXPECT_TRUE((unloaded < height).any());
  // The same load gives the same pressure without any further flow ...
  const Solved again = solve_unit(unloaded, 0.02, cap, 1e-10);
  EXPECT_LE((again.state.pressure - first.state.pressure).abs().maxCoeff(), 1e-4 * cap);
  EXPECT_LE((unloaded - contact::unloaded_height(unloaded, again.state)).maxCoeff(),
            1e-4 * (height - unloaded).maxCoeff());
  // ... and less load stays below the cap, with more contact than the virgin surface had.
  const Solved less = solve_unit(unloaded, 0.01, cap, 1e-10);
  const Solved elastic = solve_unit(unloaded, 0.01, kNoCap, 1e-10);
  EXPECT_LE((less.state.pressure - elastic.state.pressure).abs().maxCoeff(), 1e-4 * cap);
  EXPECT_GT(less.summary.contact_area_fraction_pixels,
            solve_unit(height, 0.01, cap).summary.contact_area_fraction_pixels);
}

TEST(Summary, StoredEnergyIsTheWorkOfTheLoad) {
  const Field height = self_affine(64, 0.8, 1, 8, 8);
  const auto solved_at = [&](double mean_pressure) {
    return solve_unit(height, mean_pressure, kNoCap, 1e-8);
  };
  const double step = 0.002;
  Solved before = solved_at(0.05);
  const double first_energy = before.summary.elastic_energy;
  double work = 0;
  for (int k = 1; k <= 10; ++k) {  // trapezoidal rule over the approach
    const Solved after = solved_at(0.05 + k * step);
    work += (0.05 + (k - 0.5) * step) * (before.state.separation - after.state.separation);
    before = after;
  }
  const double stored = before.summary.elastic_energy - first_energy;
  expect_within("Contact", "self-affine, P/(E* rms slope) = 0.05 to 0.07",
                "stored energy against work, relative", "energy conservation",
                std::abs(stored / work - 1), 1e-3);
}

}  // namespace
}  // namespace tabor::test
