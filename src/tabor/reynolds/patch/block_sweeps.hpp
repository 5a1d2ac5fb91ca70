#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

#include "tabor/reynolds/patch/coupling_matrix.hpp"

// Relaxes a sparse system of flow by Gauss-Seidel sweeps, block beside block.
namespace tabor::reynolds {

/// Gauss-Seidel sweeps on A x = right over blocks of consecutive nodes, side by side on all
/// threads. A sweep takes the values of other blocks as they were before it. Blocks are the same
/// for any number of threads, and so are the bits of the results.
///
/// Rows are stored divided by their diagonals, and the neighbour that a sweep has just changed
/// comes last in its row, so that each node waits as briefly as possible for the one before it.
class BlockSweeps {
 public:
  explicit BlockSweeps(CouplingMatrix matrix);

  Eigen::Index size() const { return diagonal_.size(); }
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;

  /// Sets x to one sweep from the first node to the last that begins with x = 0, and rest to
  /// right - A x. Together they read the matrix once.
  void smooth_from_zero(const Eigen::VectorXd& right, Eigen::VectorXd& x,
                        Eigen::VectorXd& rest) const;

  /// Improves x by one sweep from the last node to the first.
  void relax_backward(const Eigen::VectorXd& right, Eigen::VectorXd& x) const;

 private:
  /// Neighbours of a row: [begin, later) come before it in its block, [later, outer) after it, and
  /// those up to the beginning of the next row are in other blocks.
  struct Row {
    std::int32_t begin = 0;
    std::int32_t later = 0;
    std::int32_t outer = 0;
  };

  void sort_row(Eigen::Index node, CouplingMatrix& matrix);

  std::vector<Row> rows_;  ///< one more than there are nodes
  std::vector<std::int32_t> neighbour_;
  std::vector<double> coupling_;  ///< over the diagonal
  Eigen::VectorXd diagonal_;
  Eigen::VectorXd inverse_;               ///< of the diagonal
  std::vector<std::int32_t> outer_rows_;  ///< nodes with neighbours in other blocks
};

}  // namespace tabor::reynolds
