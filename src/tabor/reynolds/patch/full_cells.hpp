#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <vector>

#include "tabor/reynolds/patch/aggregation_multigrid.hpp"
#include "tabor/reynolds/patch/patch_cells.hpp"

// Solves the linear equations for the pressure in the full cells of a patch.
namespace tabor::reynolds {

/// Kind of a cell of a patch: which of pressure and fill is given, which is unknown. A wall is a
/// solid cell.
enum class CellKind : std::uint8_t {
  wall,
  starved,  ///< p = 0, the fill is sought
  full,     ///< the fill is 1, p is sought
  pinned    ///< both are given
};

/// Solves the linear equations for the pressures of the full cells, the starved cells between them
/// eliminated: oil that pressure drives into a starved cell is carried on along its row and enters
/// the next full cell, less what the cells between them retain. Each flow path over a starved cell
/// becomes one more coupling of two full cells, in one direction.
///
/// Such a coupling makes pressures differ by orders of magnitude where oil leaves a wide gap for a
/// narrow one. The preconditioner corrects groups of cells alike, so the unknowns are measured in
/// units that make them alike: the pressures that an even inflow of oil would raise, roughly.
class FullCells {
 public:
  /// Assembles the equations; `time` [s] of the implicit step. `unit` of the pressure of each cell:
  /// those of earlier equations, which are made better here; 1 where there were none.
  FullCells(const PatchCells& cells, const std::vector<CellKind>& kinds, double time, Field& unit);

  Index count() const { return static_cast<Index>(cell_.size()); }
  Index cell(Index unknown) const { return cell_[static_cast<std::size_t>(unknown)]; }

  /// Sets x such that |right - A x| <= tolerance (2-norm), in at most max_products products:
  /// stabilised biconjugate gradients (van der Vorst 1992, doi:10.1137/0913035) after multigrid. A
  /// x [m/s] is the flow that pressures x [Pa] drive out of the full cells and that does not return
  /// to them. False if the tolerance was not reached. `tick` is called once an iteration.
  bool solve(const Eigen::VectorXd& right, double tolerance, int max_products, Eigen::VectorXd& x,
             const std::function<void()>& tick);

  int n_products() const { return n_products_; }

 private:
  CouplingMatrix matrix_of(const PatchCells& cells, const std::vector<CellKind>& kinds, double time,
                           Field& unit);
  bool iterate(Eigen::VectorXd r, double tolerance, int max_products, Eigen::VectorXd& x,
               const std::function<void()>& tick);
  void apply(const Eigen::VectorXd& x, Eigen::VectorXd& y);

  std::vector<std::int32_t> cell_;  // of an unknown
  Eigen::VectorXd unit_;            // of an unknown [Pa]
  AggregationMultigrid multigrid_;
  int n_products_ = 0;
};

}  // namespace tabor::reynolds
