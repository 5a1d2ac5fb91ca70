#include "tabor/reynolds/patch/patch_balance.hpp"

#include "tabor/core/parallel.hpp"

namespace tabor::reynolds {

PatchBalance::PatchBalance(const PatchCells& cells, const PatchOil& oil, double time)
    : cells_(cells),
      oil_(oil),
      time_(time),
      kinds_(static_cast<std::size_t>(cells.size()), CellKind::wall),
      pressure_(Field::Zero(cells.ny, cells.nx)),
      fill_(pressure_) {}

void PatchBalance::set_kind(Index cell, CellKind new_kind) {
  kinds_[static_cast<std::size_t>(cell)] = new_kind;
  pressure(cell) = 0;
  fill_.data()[cell] = new_kind == CellKind::starved ? 0.0 : 1.0;
}

void PatchBalance::pin(Index cell, double given_pressure) {
  set_kind(cell, CellKind::pinned);
  pressure(cell) = given_pressure;
}

/// What pressure drives into a cell, less what its own pressure drives out [m/s].
double PatchBalance::driven_into(Index cell) const {
  const auto [left, right, up, down] = cells_.around(cell);
  const double p = pressure(cell);
  return cells_.conduct_x.data()[left] * (pressure(left) - p) +
         cells_.conduct_x.data()[cell] * (pressure(right) - p) +
         cells_.conduct_y.data()[up] * (pressure(up) - p) +
         cells_.conduct_y.data()[cell] * (pressure(down) - p);
}

double PatchBalance::carried_into(Index cell) const {
  const Index left = cells_.around(cell).left;
  return cells_.carried.data()[left] * fill(left);
}

/// Fills of the starved cells of a row, from upstream.
void PatchBalance::sweep_row(Index row) {
  const Index begin = row * cells_.nx;
  Index start = -1;  // a cell whose fill does not depend on its neighbour
  for (Index cell = begin; cell < begin + cells_.nx && start < 0; ++cell) {
    if (kind(cell) != CellKind::starved) start = cell;
  }
  if (start < 0) {
    close_the_loop(begin);
    return;
  }
  for (Index i = 1; i < cells_.nx; ++i) {
    const Index cell = begin + (start - begin + i) % cells_.nx;
    if (kind(cell) == CellKind::starved) fill_.data()[cell] = fill_from_upstream(cell);
  }
}

double PatchBalance::fill_from_upstream(Index cell) const {
  return (oil(cell) / time_ + carried_into(cell) + driven_into(cell)) /
         (gap(cell) / time_ + cells_.carried.data()[cell]);
}

/// A row that is starved all around: the fill of its last cell is what it is carried around with.
void PatchBalance::close_the_loop(Index begin) {
  const Index last = begin + cells_.nx - 1;
  double result[2] = {0, 0};
  for (const double start : {0.0, 1.0}) {
    fill_.data()[last] = start;
    for (Index cell = begin; cell <= last; ++cell) fill_.data()[cell] = fill_from_upstream(cell);
    result[start > 0] = fill(last);
  }
  fill_.data()[last] = result[0] / (1 - (result[1] - result[0]));
  for (Index cell = begin; cell < last; ++cell) fill_.data()[cell] = fill_from_upstream(cell);
}

void PatchBalance::sweep() {
  parallel_for(cells_.ny, 16, [&](Index begin, Index end) {
    for (Index row = begin; row < end; ++row) sweep_row(row);
  });
}

double PatchBalance::surplus(Index cell) const {
  return (oil(cell) - gap(cell)) / time_ + carried_into(cell) - cells_.carried.data()[cell] +
         driven_into(cell);
}

double PatchBalance::outflow(Index cell) const {
  const auto [left, right, up, down] = cells_.around(cell);
  return flow_right(cell) - flow_right(left) + flow_down(cell) - flow_down(up);
}

double PatchBalance::flow_right(Index cell) const {
  const Index right = cells_.around(cell).right;
  return cells_.carried.data()[cell] * fill(cell) +
         cells_.conduct_x.data()[cell] * (pressure(cell) - pressure(right));
}

double PatchBalance::flow_down(Index cell) const {
  return cells_.conduct_y.data()[cell] * (pressure(cell) - pressure(cells_.around(cell).down));
}

double PatchBalance::dissipation() const {
  const double total = deterministic_sum(cells_.size(), [&](Index begin, Index end) {
    double partial = 0;
    for (Index cell = begin; cell < end; ++cell) {
      const Neighbours next = cells_.around(cell);
      const double x = pressure(cell) - pressure(next.right);
      const double y = pressure(cell) - pressure(next.down);
      partial += cells_.conduct_x.data()[cell] * x * x + cells_.conduct_y.data()[cell] * y * y;
    }
    return partial;
  });
  return total / static_cast<double>(cells_.size());
}

}  // namespace tabor::reynolds
