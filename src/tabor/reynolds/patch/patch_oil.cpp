#include "tabor/reynolds/patch/patch_oil.hpp"

#include <algorithm>

namespace tabor::reynolds {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// For each wall, the open cell that a breadth-first walk over neighbours reaches it from first;
/// open cells are their own. -1 everywhere if there is no open cell.
std::vector<std::int32_t> nearest_open(const PatchCells& cells) {
  std::vector<std::int32_t> nearest(at(cells.size()), -1);
  std::vector<std::int32_t> front;
  for (Index cell = 0; cell < cells.size(); ++cell) {
    if (!cells.is_open(cell)) continue;
    nearest[at(cell)] = static_cast<std::int32_t>(cell);
    front.push_back(static_cast<std::int32_t>(cell));
  }
  std::vector<std::int32_t> next_front;
  while (!front.empty()) {
    next_front.clear();
    for (const std::int32_t cell : front) {
      const Neighbours next = cells.around(cell);
      for (const Index other : {next.left, next.right, next.up, next.down}) {
        if (nearest[at(other)] >= 0) continue;
        nearest[at(other)] = nearest[at(cell)];
        next_front.push_back(static_cast<std::int32_t>(other));
      }
    }
    front.swap(next_front);
  }
  return nearest;
}

struct Component {
  double oil = 0;    ///< [m], summed over its cells
  double holds = 0;  ///< [m], sum of the gap
  double free = 0;   ///< [m], sum over the cells that are not full
};

std::vector<Component> measure(const PatchCells& cells, const Components& components,
                               const Field& oil) {
  std::vector<Component> result(at(components.count()));
  for (Index cell = 0; cell < cells.size(); ++cell) {
    if (!cells.is_open(cell)) continue;
    Component& component = result[at(components.of[at(cell)])];
    component.oil += oil.data()[cell];
    component.holds += cells.gap.data()[cell];
    component.free += std::max(cells.gap.data()[cell] - oil.data()[cell], 0.0);
  }
  return result;
}

/// Fills connected components that have more oil than they hold, and returns the excess.
double drain_excess(const PatchCells& cells, const Components& components,
                    const std::vector<Component>& measured, Field& oil) {
  double excess = 0;
  for (const Component& component : measured) {
    excess += std::max(component.oil - component.holds, 0.0);
  }
  if (excess == 0) return 0;
  for (Index cell = 0; cell < cells.size(); ++cell) {
    if (!cells.is_open(cell)) continue;
    const Component& component = measured[at(components.of[at(cell)])];
    if (component.oil > component.holds) oil.data()[cell] = cells.gap.data()[cell];
  }
  return excess;
}

/// Fills `share` of the free volume of each connected component that has any.
void fill_up(const PatchCells& cells, const Components& components,
             const std::vector<Component>& measured, double share, Field& oil) {
  for (Index cell = 0; cell < cells.size(); ++cell) {
    if (!cells.is_open(cell)) continue;
    const Component& component = measured[at(components.of[at(cell)])];
    if (component.oil >= component.holds || !(component.free > 0)) continue;
    const double lacks = std::max(cells.gap.data()[cell] - oil.data()[cell], 0.0);
    oil.data()[cell] += share * lacks * (component.holds - component.oil) / component.free;
  }
}

}  // namespace

PatchOil settle(const PatchCells& cells, const Components& components, const Field& oil,
                double outside) {
  PatchOil result{oil, outside};
  const std::vector<std::int32_t> nearest = nearest_open(cells);
  for (Index cell = 0; cell < cells.size(); ++cell) {
    if (cells.is_open(cell) || result.volume.data()[cell] == 0) continue;
    double& home = nearest[at(cell)] < 0 ? result.outside : result.volume.data()[nearest[at(cell)]];
    home += result.volume.data()[cell];
    result.volume.data()[cell] = 0;
  }
  result.outside +=
      drain_excess(cells, components, measure(cells, components, result.volume), result.volume);
  if (!(result.outside > 0)) return result;
  const std::vector<Component> measured = measure(cells, components, result.volume);
  double room_left = 0;
  for (const Component& component : measured) {
    room_left += std::max(component.holds - component.oil, 0.0);
  }
  if (result.outside >= room_left) {
    result.outside -= room_left;
    result.volume = cells.gap;
    return result;
  }
  fill_up(cells, components, measured, result.outside / room_left, result.volume);
  result.outside = 0;
  return result;
}

}  // namespace tabor::reynolds
