#pragma once

#include <vector>

#include "tabor/reynolds/patch/full_cells.hpp"
#include "tabor/reynolds/patch/patch_oil.hpp"

namespace tabor::reynolds {

/// Balances the flows of one implicit step of `time` [s], for given kinds of the cells and
/// pressures of the full ones. Per area of a cell, with flows as in PatchCells:
///
///   (theta h - oil)/time + outflow - inflow = 0
class PatchBalance {
 public:
  PatchBalance(const PatchCells& cells, const PatchOil& oil, double time);

  const std::vector<CellKind>& kinds() const { return kinds_; }
  const Field& pressures() const { return pressure_; }
  const Field& fills() const { return fill_; }
  CellKind kind(Index cell) const { return kinds_[static_cast<std::size_t>(cell)]; }
  double gap(Index cell) const { return cells_.gap.data()[cell]; }
  double oil(Index cell) const { return oil_.volume.data()[cell]; }
  double& pressure(Index cell) { return pressure_.data()[cell]; }
  double pressure(Index cell) const { return pressure_.data()[cell]; }
  double fill(Index cell) const { return fill_.data()[cell]; }
  bool is_reservoir(Index cell) const {
    return cells_.reservoir.size() > 0 && cells_.reservoir.data()[cell];
  }

  /// Sets the kind of a cell; its pressure is 0 until it is given.
  void set_kind(Index cell, CellKind new_kind);
  void pin(Index cell, double given_pressure);

  /// Computes the fills of all starved cells, row by row from upstream.
  void sweep();

  /// Returns the excess inflow of a cell whose fill is 1 [m/s].
  double surplus(Index cell) const;

  /// Returns the throughput of a full cell in the step [m/s]: the scale of its surplus.
  double throughput(Index cell) const { return gap(cell) / time_ + cells_.carried.data()[cell]; }

  /// Returns the outflow of a cell over its faces less its inflow [m/s].
  double outflow(Index cell) const;

  /// Returns the dissipation of the flow that pressure drives [W/m^2], over the whole patch.
  double dissipation() const;

 private:
  double driven_into(Index cell) const;
  double carried_into(Index cell) const;
  void sweep_row(Index row);
  double fill_from_upstream(Index cell) const;
  void close_the_loop(Index begin);
  double flow_right(Index cell) const;
  double flow_down(Index cell) const;

  const PatchCells& cells_;
  const PatchOil& oil_;
  double time_;
  std::vector<CellKind> kinds_;
  Field pressure_;
  Field fill_;
};

}  // namespace tabor::reynolds
