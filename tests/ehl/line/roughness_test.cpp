// Films that are lost while the roughness grows.
#include <gtest/gtest.h>

#include "ehl/line/akchurin.hpp"
#include "tabor/ehl/line/line.hpp"

namespace tabor::ehl {
namespace {

TEST(SolveLine, SaysUnderWhichPartOfTheRoughnessItWasLost) {
  LineProblem problem = test::table_6();
  problem.nodes = 300;
  problem.roughness = line_waves(problem, 500e-9, 50e-6);
  const LineResult lost = solve_line(problem);
  EXPECT_FALSE(lost.convergence.converged());
  EXPECT_GT(lost.roughness_share, 0);
  EXPECT_LT(lost.roughness_share, 1);
  problem.roughness *= lost.roughness_share;
  const LineResult found = solve_line(problem);
  EXPECT_TRUE(found.convergence.converged());
  EXPECT_EQ(found.roughness_share, 1);
  EXPECT_NEAR(lost.min_film / found.min_film, 1, 1e-6);
}

}  // namespace
}  // namespace tabor::ehl
