#include "tabor/deposition/film_measures.hpp"

#include <algorithm>

#include "tabor/core/watch.hpp"
#include "tabor/numerics/disjoint_sets.hpp"

namespace tabor::deposition {
namespace {

/// Wet pixels that follow one another in a row: [begin, end).
struct Run {
  Index begin = 0;
  Index end = 0;
  std::size_t label = 0;
};

/// Labels of runs, joined where runs touch.
using Labels = numerics::DisjointSets<std::size_t>;

std::vector<Run> runs_of(const Field& thickness, Index row, Labels& labels) {
  std::vector<Run> runs;
  for (Index column = 0; column < thickness.cols(); ++column) {
    if (!(thickness(row, column) > 0)) continue;
    if (runs.empty() || runs.back().end != column) runs.push_back({column, column, labels.add()});
    runs.back().end = column + 1;
  }
  return runs;
}

void join_touching(const std::vector<Run>& above, const std::vector<Run>& below, Labels& labels) {
  auto upper = above.begin();
  auto lower = below.begin();
  while (upper != above.end() && lower != below.end()) {
    if (upper->begin < lower->end && lower->begin < upper->end) {
      labels.join(upper->label, lower->label);
    }
    (upper->end < lower->end ? upper : lower)++;
  }
}

void join_ends(const std::vector<Run>& row, Index n_columns, Labels& labels) {
  if (!row.empty() && row.front().begin == 0 && row.back().end == n_columns) {
    labels.join(row.front().label, row.back().label);
  }
}

}  // namespace

Field thickness_in(Pools& pools, double flood) {
  const Terrain& terrain = pools.terrain();
  Field thickness(terrain.ny, terrain.nx);
  for (Pixel p = 0; p < terrain.size(); ++p) {
    go_on_or_throw(static_cast<std::size_t>(p));
    const Volume level = pools[pools.owner(pools.pool_at(p))].level;
    const auto depth = static_cast<double>(std::max<Volume>(0, level - pools.height(p)));
    thickness.data()[p] = (depth + flood) * terrain.quantum;
  }
  return thickness;
}

Index count_wet_regions(const Field& thickness, bool periodic) {
  Labels labels;
  std::vector<Run> first;
  std::vector<Run> previous;
  for (Index row = 0; row < thickness.rows(); ++row) {
    go_on_or_throw();
    std::vector<Run> current = runs_of(thickness, row, labels);
    join_touching(previous, current, labels);
    if (periodic) join_ends(current, thickness.cols(), labels);
    if (row == 0) first = current;
    previous = std::move(current);
  }
  if (periodic) join_touching(previous, first, labels);
  return static_cast<Index>(labels.n_sets());
}

void measure(Film& film, Edge edge) {
  film.n_pools = count_wet_regions(film.thickness, edge == Edge::periodic);
  film.wet_fraction = static_cast<double>((film.thickness > 0).count()) /
                      static_cast<double>(film.thickness.size());
  film.max_film = film.thickness.maxCoeff();
}

}  // namespace tabor::deposition
