#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

// Stores the coefficients of a sparse system of flow.
namespace tabor::reynolds {

/// Matrix with a positive diagonal and off-diagonals <= 0, by rows: the balance of nodes between
/// which something flows (an M-matrix, not always symmetric).
struct CouplingMatrix {
  std::vector<std::int32_t> begin = {0};  ///< of each row's neighbours, size() + 1
  std::vector<std::int32_t> neighbour;    ///< a node may occur more than once
  std::vector<double> coupling;           ///< minus the off-diagonals, >= 0
  Eigen::VectorXd diagonal;

  Eigen::Index size() const { return diagonal.size(); }

  /// Calls visit(other, coupling) for the neighbours of a node.
  template <typename Visit>
  void for_neighbours(Eigen::Index node, const Visit& visit) const {
    const auto place = static_cast<std::size_t>(node);
    const auto end = static_cast<std::size_t>(begin[place + 1]);
    for (auto k = static_cast<std::size_t>(begin[place]); k < end; ++k) {
      visit(neighbour[k], coupling[k]);
    }
  }
};

}  // namespace tabor::reynolds
