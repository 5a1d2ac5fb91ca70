#include "tabor/deposition/film_measures.hpp"

#include <algorithm>
#include <vector>

#include "tabor/core/loops.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/core/watch.hpp"
#include "tabor/numerics/disjoint_sets.hpp"
#include "tabor/numerics/runs.hpp"

namespace tabor::deposition {
Field thickness_in(Pools& pools, double flood) {
  const Terrain& terrain = pools.terrain();
  std::vector<Height> level(pools.count());
  for (std::size_t id = 0; id < level.size(); ++id) {
    level[id] = pools[pools.owner(static_cast<PoolId>(id))].level;
  }
  Field thickness(terrain.ny, terrain.nx);
  for_each_row(terrain.ny, [&](Index row) {
    for (auto p = static_cast<Pixel>(row * terrain.nx), end = p + terrain.nx; p < end; ++p) {
      const Volume over_pixel = level[static_cast<std::size_t>(pools.pool_at(p))];
      const auto depth = static_cast<double>(std::max<Volume>(0, over_pixel - pools.height(p)));
      thickness.data()[p] = (depth + flood) * terrain.quantum;
    }
  });
  return thickness;
}

Index count_wet_regions(const Field& thickness, bool periodic) {
  const double* film = thickness.data();
  const numerics::Runs runs(thickness.rows(), thickness.cols(),
                            [film](Index i) { return film[i] > 0; });
  numerics::DisjointSets<std::size_t> sets(runs.size());
  runs.join_neighbours(periodic, [&sets](std::size_t a, std::size_t b, int, int) {
    go_on_or_throw(a);
    sets.join(a, b);
  });
  return static_cast<Index>(sets.n_sets());
}

void measure(Film& film, Edge edge) {
  film.n_pools = count_wet_regions(film.thickness, edge == Edge::periodic);
  const double* const thickness = film.thickness.data();
  const Index n = film.thickness.size();
  film.wet_fraction =
      static_cast<double>(count_where(n, [thickness](Index i) { return thickness[i] > 0; })) /
      static_cast<double>(n);
  film.max_film = max_over(n, [thickness](Index i) { return thickness[i]; });
}

}  // namespace tabor::deposition
