#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <tuple>
#include <vector>

#include "contact/surfaces.hpp"
#include "support/validation.hpp"

namespace tabor::test {
namespace {

/// The contact problem with an explicit matrix and sets of free and saturated pixels that are
/// changed until the contact conditions hold. Slow and obviously right.
Field solve_dense(const Field& height, double mean_pressure, double cap, bool periodic) {
  const Index n = height.size();
  const Grid grid{height.cols(), height.rows(), 1.0,
                  static_cast<double>(height.rows()) / static_cast<double>(height.cols())};
  const auto elasticity =
      periodic ? elastic::make_periodic(grid, 1.0) : elastic::make_free(grid, 1.0);
  Eigen::MatrixXd matrix(n, n);
  Field unit = Field::Zero(height.rows(), height.cols());
  Field column;
  for (Index i = 0; i < n; ++i) {
    unit(i) = 1;
    elasticity->apply(unit, column);
    matrix.col(i) = column.reshaped<Eigen::RowMajor>().matrix();
    unit(i) = 0;
  }
  enum Set { kOpen, kFree, kSaturated };
  std::vector<Set> sets(static_cast<std::size_t>(n), kFree);
  Eigen::VectorXd pressure(n);
  for (int round = 0; round < 200; ++round) {
    // Unknowns: the free pressures and the common displacement level.
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 1, n + 1);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n + 1);
    for (Index i = 0; i < n; ++i) {
      if (sets[static_cast<std::size_t>(i)] == kFree) {
        system.row(i).head(n) = matrix.row(i);
        system(i, n) = -1;
        right(i) = height(i);
      } else {
        system(i, i) = 1;
        right(i) = sets[static_cast<std::size_t>(i)] == kSaturated ? cap : 0;
      }
      system(n, i) = 1;
    }
    right(n) = mean_pressure * static_cast<double>(n);
    const Eigen::VectorXd solution = system.partialPivLu().solve(right);
    pressure = solution.head(n);
    const Eigen::VectorXd gap = matrix * pressure - height.reshaped<Eigen::RowMajor>().matrix() -
                                Eigen::VectorXd::Constant(n, solution(n));
    bool changed = false;
    for (Index i = 0; i < n; ++i) {
      Set& set = sets[static_cast<std::size_t>(i)];
      const Set before = set;
      if (set == kFree) {
        set = pressure(i) < 0 ? kOpen : (pressure(i) > cap ? kSaturated : kFree);
      } else if (set == kOpen ? gap(i) < -1e-15 : gap(i) > 1e-15) {
        set = kFree;
      }
      changed = changed || set != before;
    }
    if (!changed) break;
  }
  return pressure.array().reshaped<Eigen::RowMajor>(height.rows(), height.cols());
}

class DenseCases : public testing::TestWithParam<std::tuple<Index, double, double, bool>> {};

TEST_P(DenseCases, BothSolversFindTheDensePressure) {
  const auto [n, mean_pressure, cap, periodic] = GetParam();
  const Field height = 0.02 * Field::Random(n, n + 2);
  const Field expected = solve_dense(height, mean_pressure, cap, periodic);
  ASSERT_GE(expected.minCoeff(), 0) << "the reference itself did not finish";
  for (const auto solver : {contact::Solver::fast, contact::Solver::polonsky_keer}) {
    const Solved solved = solve_unit(height, mean_pressure, cap, 1e-12, solver, periodic);
    ASSERT_TRUE(solved.state.convergence.converged()) << solved.state.convergence.certificate;
    const double error = (solved.state.pressure - expected).abs().maxCoeff() / expected.maxCoeff();
    expect_within(
        "Contact",
        fmt::format("dense solve, {} x {}, {}{}", n + 2, n, periodic ? "periodic" : "free",
                    std::isfinite(cap) ? ", saturated" : ""),
        solver == contact::Solver::fast ? "pressure, fast" : "pressure, Polonsky-Keer",
        "LU of the whole matrix", error, 1e-8);
  }
}

INSTANTIATE_TEST_SUITE_P(Small, DenseCases,
                         testing::Values(std::tuple{Index{8}, 0.01, contact::kNoSaturation, true},
                                         std::tuple{Index{14}, 0.02, contact::kNoSaturation, true},
                                         std::tuple{Index{13}, 0.02, 0.1, true},
                                         std::tuple{Index{11}, 0.02, contact::kNoSaturation, false},
                                         std::tuple{Index{9}, 0.03, 0.12, false}));

}  // namespace
}  // namespace tabor::test
