#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "contact/surfaces.hpp"
#include "support/rejection.hpp"
#include "support/stopping.hpp"
#include "tabor/core/error.hpp"

namespace tabor::test {
namespace {

using testing::HasSubstr;

TEST(SolveContact, RejectsALoadThatTheCapCannotCarry) {
  const Field height = wave(16, 0.01, true);
  EXPECT_THAT(rejection([&] { solve_unit(height, 0.2, 0.1); }),
              HasSubstr("no pressure field below the cap"));
  EXPECT_THAT(rejection([&] { solve_unit(height, 0.2, 0.2); }),
              HasSubstr("no pressure field below the cap"));
}

TEST(SolveContact, RejectsHolesAndInfiniteHeights) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    Field height = wave(16, 0.01, true);
    height(3, 4) = bad;
    EXPECT_THAT(rejection([&] { solve_unit(height, 0.01); }), HasSubstr("<fill=harmonic>"));
  }
}

TEST(SolveContact, RejectsPressuresAndTolerancesThatMakeNoSense) {
  const Field height = wave(16, 0.01, true);
  for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_THAT(rejection([&] { solve_unit(height, bad); }), HasSubstr("mean pressure")) << bad;
  }
  EXPECT_THAT(rejection([&] { solve_unit(height, 0.01, std::nan("")); }), HasSubstr("saturation"));
  EXPECT_THAT(rejection([&] { solve_unit(height, 0.01, contact::kNoSaturation, 0); }),
              HasSubstr("tolerance"));
}

TEST(SolveContact, RejectsAHeightOfAnotherShapeThanTheOperator) {
  const auto elasticity = elastic::make_periodic(square(16), 1.0);
  contact::Problem problem;
  problem.height = Field::Zero(16, 17);
  problem.control = contact::MeanPressure{1};
  EXPECT_THAT(rejection([&] { contact::solve(*elasticity, problem); }), HasSubstr("17 x 16"));
}

TEST(SolveContact, ReturnsANonConvergedStateWhenStopped) {
  const auto elasticity = elastic::make_periodic(square(64), 1.0);
  contact::Problem problem;
  problem.height = self_affine(64, 0.8, 1, 16, 1);
  problem.control = contact::MeanPressure{0.02};
  int calls = 0;
  const auto state = contact::solve(*elasticity, problem, contact::Solver::fast,
                                    [&](const Progress&) { return ++calls < 3; });
  EXPECT_FALSE(state.convergence.converged());
  EXPECT_GT(state.convergence.certificate, 1e-6);
  EXPECT_NEAR(state.pressure.mean() / 0.02, 1, 1e-10);
}

// A large solve spends half its time on coarser grids: whoever watches is asked there too.
TEST(SolveContact, AsksItsObserverFromTheFirstMoment) {
  const auto elasticity = elastic::make_periodic(square(256), 1.0);
  contact::Problem problem;
  problem.height = self_affine(256, 0.8, 1, 64, 1);
  problem.control = contact::MeanPressure{0.02};
  int before_fine_grid = 0;
  bool is_fine_grid = false;
  double transform_seconds_at_first = -1;
  const auto whole =
      contact::solve(*elasticity, problem, contact::Solver::fast, [&](const Progress& progress) {
        if (before_fine_grid == 0) transform_seconds_at_first = elasticity->fft_seconds();
        is_fine_grid = is_fine_grid || progress.convergence != nullptr;
        before_fine_grid += is_fine_grid ? 0 : 1;
        return true;
      });
  EXPECT_TRUE(whole.convergence.converged());
  EXPECT_EQ(transform_seconds_at_first, 0);
  EXPECT_GE(before_fine_grid, 5) << "two coarser grids and the first question";
  // Said once, "stop" holds, wherever it was said.
  for (int at = 1; at <= 5; ++at) {
    int calls = 0;
    const auto state = contact::solve(*elasticity, problem, contact::Solver::fast,
                                      [&](const Progress&) { return ++calls != at; });
    EXPECT_EQ(calls, at);
    EXPECT_FALSE(state.convergence.converged());
    EXPECT_NEAR(state.pressure.mean() / 0.02, 1, 1e-10);
  }
}

contact::Problem rough_problem() {
  contact::Problem problem;
  problem.height = self_affine(128, 0.8, 1, 32, 1);
  problem.control = contact::MeanPressure{0.02};
  return problem;
}

// On two grids, without a cap, with one that is tried without first, and with one that is reached.
TEST(SolveContact, StopsAtAnyQuestion) {
  const auto elasticity = elastic::make_periodic(square(128), 1.0);
  for (const double cap : {contact::kNoSaturation, 100.0, 1.0, 0.1}) {
    contact::Problem problem = rough_problem();
    problem.bounds.upper = cap;
    for (const auto solver : {contact::Solver::fast, contact::Solver::polonsky_keer}) {
      expect_to_stop_at_once([&](const Observer& observer) {
        const auto state = contact::solve(*elasticity, problem, solver, observer);
        EXPECT_NEAR(state.pressure.mean() / 0.02, 1, 1e-10);
        EXPECT_LE(state.pressure.maxCoeff(), cap);
        return state.convergence;
      });
    }
  }
}

TEST(SolveContact, SaysSoWhenItRunsOutOfIterations) {
  const auto elasticity = elastic::make_periodic(square(128), 1.0);
  contact::Problem problem = rough_problem();
  problem.max_iterations = 2;
  for (const auto solver : {contact::Solver::fast, contact::Solver::polonsky_keer}) {
    const Convergence ended = contact::solve(*elasticity, problem, solver).convergence;
    EXPECT_EQ(ended.status, Status::iteration_limit);
    EXPECT_EQ(ended.iterations, 2);
  }
}

TEST(SolveContact, SaysSoWhenItComesNoNearer) {
  const auto elasticity = elastic::make_periodic(square(32), 1.0);
  contact::Problem problem;
  problem.height = wave(32, 0.01, true);
  problem.control = contact::MeanPressure{0.005};
  problem.tolerance = 1e-30;  // below rounding
  const Convergence ended = contact::solve(*elasticity, problem).convergence;
  EXPECT_EQ(ended.status, Status::stalled);
  EXPECT_LT(ended.iterations, problem.max_iterations);
}

}  // namespace
}  // namespace tabor::test
