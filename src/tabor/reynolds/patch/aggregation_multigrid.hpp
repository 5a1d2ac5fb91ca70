#pragma once

#include <Eigen/Core>
#include <Eigen/SparseLU>

#include <cstdint>
#include <vector>

#include "tabor/reynolds/patch/block_sweeps.hpp"
#include "tabor/reynolds/patch/coupling_matrix.hpp"

// Preconditions sparse systems of flow by algebraic multigrid with aggregation.
namespace tabor::reynolds {

/// Preconditions by one cycle of algebraic multigrid. Nodes are joined in two rounds of pairs along
/// their strongest couplings, so that coarse nodes follow the conductances wherever they jump;
/// corrections are constant on each (Notay 2010, Electronic Transactions on Numerical Analysis 37,
/// 123; 2012, doi:10.1137/110835347). W cycles, one Gauss-Seidel sweep forward before and one
/// backward after; the last level is factored.
class AggregationMultigrid {
 public:
  explicit AggregationMultigrid(CouplingMatrix matrix);

  /// The system that is preconditioned.
  const BlockSweeps& system() const { return levels_.front().system; }

  /// Sets z to an approximation of matrix^-1 r.
  void apply(const Eigen::VectorXd& r, Eigen::VectorXd& z);

 private:
  struct Level {
    BlockSweeps system;
    std::vector<std::int32_t> coarse;  // node of the next level, empty on the last
    Eigen::VectorXd right, solution, second_solution, rest;
  };

  void add_level(CouplingMatrix matrix, std::vector<std::int32_t> coarse);
  void cycle(std::size_t level, const Eigen::VectorXd& r, Eigen::VectorXd& z);

  std::vector<Level> levels_;
  Eigen::SparseLU<Eigen::SparseMatrix<double>> coarsest_;
};

}  // namespace tabor::reynolds
