#pragma once

#include <Eigen/Core>
#include <Eigen/SparseLU>

#include <cstdint>
#include <vector>

// Preconditions sparse systems of flow by algebraic multigrid with aggregation.
namespace tabor::reynolds {

/// Matrix with a positive diagonal and off-diagonals <= 0, by rows: the balance of nodes between
/// which something flows (an M-matrix, not always symmetric).
struct CouplingMatrix {
  std::vector<std::int32_t> begin = {0};  ///< of each row's neighbours, size() + 1
  std::vector<std::int32_t> neighbour;    ///< a node may occur more than once
  std::vector<double> coupling;           ///< minus the off-diagonals, >= 0
  Eigen::VectorXd diagonal;

  Eigen::Index size() const { return diagonal.size(); }
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;
  /// Gauss-Seidel on A x = right, once through the nodes from the first, or from the last.
  void relax_forward(const Eigen::VectorXd& right, Eigen::VectorXd& x) const;
  void relax_backward(const Eigen::VectorXd& right, Eigen::VectorXd& x) const;
};

/// Preconditions by one cycle of algebraic multigrid. Nodes are joined in two rounds of pairs along
/// their strongest couplings, so that coarse nodes follow the conductances wherever they jump;
/// corrections are constant on each (Notay 2010, Electronic Transactions on Numerical Analysis 37,
/// 123; 2012, doi:10.1137/110835347). W cycles, one Gauss-Seidel sweep forward before and one
/// backward after; the last level is factored.
class AggregationMultigrid {
 public:
  explicit AggregationMultigrid(CouplingMatrix matrix);

  const CouplingMatrix& matrix() const { return levels_.front().matrix; }

  /// Sets z to an approximation of matrix^-1 r.
  void apply(const Eigen::VectorXd& r, Eigen::VectorXd& z);

 private:
  struct Level {
    CouplingMatrix matrix;
    std::vector<std::int32_t> middle;  // of each row: its neighbours from here on come after it
    std::vector<std::int32_t> coarse;  // node of the next level, empty on the last
    Eigen::VectorXd right, solution, second_solution, rest;
  };

  void add_level(CouplingMatrix matrix);
  void cycle(std::size_t level, const Eigen::VectorXd& r, Eigen::VectorXd& z);

  std::vector<Level> levels_;
  Eigen::SparseLU<Eigen::SparseMatrix<double>> coarsest_;
};

}  // namespace tabor::reynolds
