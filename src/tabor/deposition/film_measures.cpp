#include "tabor/deposition/film_measures.hpp"

#include <algorithm>

#include "tabor/core/watch.hpp"
#include "tabor/numerics/disjoint_sets.hpp"
#include "tabor/numerics/runs.hpp"

namespace tabor::deposition {
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
  film.wet_fraction = static_cast<double>((film.thickness > 0).count()) /
                      static_cast<double>(film.thickness.size());
  film.max_film = film.thickness.maxCoeff();
}

}  // namespace tabor::deposition
