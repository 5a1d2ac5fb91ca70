// Gauss-Seidel sweeps over blocks, against rows summed one by one.
#include "tabor/reynolds/patch/block_sweeps.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tabor/core/parallel.hpp"

namespace tabor::reynolds {
namespace {

using Eigen::VectorXd;

/// Flow between neighbours on a torus `side` nodes wide, and from some nodes to others far away.
CouplingMatrix torus(Index side, Index rows) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> conductance(0.1, 10);
  const Index n = side * rows;
  CouplingMatrix matrix;
  matrix.diagonal = VectorXd::Constant(n, 0.5);
  for (Index node = 0; node < n; ++node) {
    const auto add = [&](Index other) {
      const double coupling = conductance(random);
      matrix.neighbour.push_back(static_cast<std::int32_t>((other + n) % n));
      matrix.coupling.push_back(coupling);
      matrix.diagonal[node] += coupling;
    };
    for (const Index other : {node + side, node - 1, node + 1, node - side}) add(other);
    if (node % 7 == 0) add(static_cast<Index>(random()) % n);
    matrix.begin.push_back(static_cast<std::int32_t>(matrix.neighbour.size()));
  }
  return matrix;
}

VectorXd random_values(Index n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-1, 1);
  return VectorXd::NullaryExpr(n, [&](Index) { return value(random); });
}

VectorXd product(const CouplingMatrix& matrix, const VectorXd& x) {
  VectorXd y(matrix.size());
  for (Index node = 0; node < matrix.size(); ++node) {
    y[node] = matrix.diagonal[node] * x[node];
    matrix.for_neighbours(
        node, [&](std::int32_t other, double coupling) { y[node] -= coupling * x[other]; });
  }
  return y;
}

/// What one node must be for its row to balance.
double balanced(const CouplingMatrix& matrix, Index node, const VectorXd& right,
                const VectorXd& x) {
  double total = right[node];
  matrix.for_neighbours(node,
                        [&](std::int32_t other, double coupling) { total += coupling * x[other]; });
  return total / matrix.diagonal[node];
}

double difference(const VectorXd& a, const VectorXd& b) {
  return (a - b).lpNorm<Eigen::Infinity>() / b.lpNorm<Eigen::Infinity>();
}

constexpr Index kManyRows = 400;  // several blocks

TEST(BlockSweeps, MultiplyAsTheMatrixDoes) {
  const CouplingMatrix matrix = torus(64, kManyRows);
  const VectorXd x = random_values(matrix.size(), 1);
  VectorXd y;
  BlockSweeps(matrix).multiply(x, y);
  EXPECT_LT(difference(y, product(matrix, x)), 1e-14);
}

TEST(BlockSweeps, LeaveWhatTheyReportAfterASweepFromZero) {
  const CouplingMatrix matrix = torus(64, kManyRows);
  const VectorXd right = random_values(matrix.size(), 2);
  VectorXd x;
  VectorXd rest;
  BlockSweeps(matrix).smooth_from_zero(right, x, rest);
  EXPECT_LT(difference(rest, right - product(matrix, x)), 1e-13);
  EXPECT_LT(rest.norm(), 0.8 * right.norm());
}

TEST(BlockSweeps, AreGaussSeidelWithinABlock) {
  const CouplingMatrix matrix = torus(8, 8);
  const VectorXd right = random_values(matrix.size(), 3);
  VectorXd x;
  VectorXd rest;
  const BlockSweeps sweeps(matrix);
  sweeps.smooth_from_zero(right, x, rest);
  VectorXd expected = VectorXd::Zero(matrix.size());
  for (Index node = 0; node < matrix.size(); ++node) {
    expected[node] = balanced(matrix, node, right, expected);
  }
  EXPECT_LT(difference(x, expected), 1e-14);
  sweeps.relax_backward(right, x);
  for (Index node = matrix.size(); node-- > 0;) {
    expected[node] = balanced(matrix, node, right, expected);
  }
  EXPECT_LT(difference(x, expected), 1e-14);
}

TEST(BlockSweeps, TakeOtherBlocksAsTheyWereBefore) {
  const CouplingMatrix matrix = torus(64, kManyRows);
  const VectorXd right = random_values(matrix.size(), 4);
  VectorXd x = random_values(matrix.size(), 5);
  const double before = (right - product(matrix, x)).norm();
  const VectorXd start = x;
  const BlockSweeps sweeps(matrix);
  sweeps.relax_backward(right, x);
  EXPECT_LT((right - product(matrix, x)).norm(), 0.8 * before);
  // The last node of all is the first of its block to change: it sees the values of before alone.
  const Index last = matrix.size() - 1;
  EXPECT_NEAR(x[last], balanced(matrix, last, right, start), 1e-14);
}

TEST(BlockSweeps, HaveTheSameBitsOnAnyNumberOfThreads) {
  const CouplingMatrix matrix = torus(64, kManyRows);
  const VectorXd right = random_values(matrix.size(), 6);
  const BlockSweeps sweeps(matrix);
  VectorXd values[2];
  for (const int n_threads : {1, 4}) {
    set_thread_count(n_threads);
    VectorXd& x = values[n_threads == 1 ? 0 : 1];
    VectorXd rest;
    sweeps.smooth_from_zero(right, x, rest);
    sweeps.relax_backward(right, x);
    VectorXd y;
    sweeps.multiply(x, y);
    x += rest + y;
  }
  set_thread_count(0);
  EXPECT_TRUE((values[0].array() == values[1].array()).all());
}

}  // namespace
}  // namespace tabor::reynolds
