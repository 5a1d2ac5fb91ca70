#include "tabor/ehl/point/transient.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ehl/point/moes.hpp"
#include "support/stopping.hpp"
#include "tabor/core/error.hpp"

namespace tabor::ehl {
namespace {

constexpr Index kNodes = 33;

/// A transverse ridge of a share of the film, its middle `place` half axes from the centre.
Field ridge(const PointProblem& problem, double share, double place) {
  const double half_axis = hertz_of(problem).half_axis_x;
  const double height = share * film_groups_of(problem).nijenbanning_central();
  const Eigen::ArrayXd distance = point_x(problem) / half_axis - place;
  return (height * (-4 * distance.square()).exp()).transpose().replicate(problem.nodes_y, 1);
}

TransientPointProblem transient(const Field& still, int steps) {
  TransientPointProblem problem;
  problem.contact = test::compressible(test::moes_case(50, 6, kNodes));
  problem.roughness = [still](double) { return still; };
  problem.time_step = point_grid(problem.contact).dx() / problem.contact.entrainment_speed;
  problem.steps = steps;
  return problem;
}

TEST(SolvePointTransient, ASteadyFilmStays) {
  const TransientPointResult result =
      solve_point_transient(transient(Field::Zero(kNodes, kNodes), 3));
  ASSERT_TRUE(result.convergence.converged());
  ASSERT_EQ(result.history.size(), 4U);
  EXPECT_NEAR(result.history.back().central_film / result.history.front().central_film, 1, 1e-5);
}

TEST(SolvePointTransient, StopsAtAnyQuestion) {
  const TransientPointProblem problem = transient(Field::Zero(kNodes, kNodes), 3);
  test::expect_to_stop_at_once([&](const Observer& observer) {
    return solve_point_transient(problem, observer).convergence;
  });
}

TEST(SolvePointTransient, EndsAtTheSteadyFilmOfARidgeThatStopped) {  // slow
  TransientPointProblem problem = transient({}, 60);
  const double stop = 8 * problem.time_step;
  problem.roughness = [contact = problem.contact, stop](double time) {
    return ridge(contact, 0.2, -1.5 + 1.5 * std::min(1.0, time / stop));
  };
  const TransientPointResult moved = solve_point_transient(problem);
  ASSERT_TRUE(moved.convergence.converged());
  const TransientPointResult still =
      solve_point_transient(transient(ridge(problem.contact, 0.2, 0), 1));
  ASSERT_TRUE(still.convergence.converged());
  EXPECT_NEAR(moved.history.back().central_film / still.history.back().central_film, 1, 1e-3);
  EXPECT_GT(std::abs(moved.history[10].central_film / still.history.back().central_film - 1), 1e-2);
}

TEST(SolvePointTransient, AFilmThatWouldCloseEndsTheHistory) {
  TransientPointProblem problem = transient({}, 20);
  problem.roughness = [contact = problem.contact, step = problem.time_step](double time) {
    return Field(ridge(contact, 1.0 * time / step * time / step, 0));
  };
  const TransientPointResult result = solve_point_transient(problem);
  EXPECT_FALSE(result.convergence.converged());
  EXPECT_LT(result.history.size(), 21U);
  EXPECT_GT(result.history.back().min_film, 0);
}

TEST(SolvePointTransient, RejectsWhatMakesNoSense) {
  TransientPointProblem problem = transient(Field::Zero(kNodes, kNodes), 3);
  problem.time_step = 0;
  EXPECT_THROW(solve_point_transient(problem), InputError);
  problem = transient(Field::Zero(2, 2), 3);
  EXPECT_THROW(solve_point_transient(problem), InputError);
  problem.roughness = nullptr;
  EXPECT_THROW(solve_point_transient(problem), InputError);
  problem = transient(Field::Zero(kNodes, kNodes), 3);
  problem.contact.roughness = Field::Zero(kNodes, kNodes);
  EXPECT_THROW(solve_point_transient(problem), InputError);
}

}  // namespace
}  // namespace tabor::ehl
