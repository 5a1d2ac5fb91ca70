#include "tabor/sliding/squeezed.hpp"

#include <algorithm>
#include <utility>

#include "tabor/core/loops.hpp"

namespace tabor::sliding {

Squeezed squeeze(const Field& film, const Field& gap, const Mask* sealed, const Grid& grid,
                 deposition::Edge edge, const Observer& observer) {
  const auto is_sealed = [&](Index i) { return sealed != nullptr && (*sealed)(i); };
  const auto space_at = [&](Index i) { return is_sealed(i) ? 0.0 : std::max(gap(i), 0.0); };
  const Index n = film.size();
  const double space = sum_over(n, space_at);
  const double stays = sum_over(n, [&](Index i) { return std::min(film(i), space_at(i)); });
  const double squeezed = sum_over(
      n, [&](Index i) { return is_sealed(i) ? 0.0 : film(i) - std::min(film(i), space_at(i)); });
  const double rained = std::min(squeezed, space - stays);
  const Index n_open = count_where(n, [&](Index i) { return space_at(i) > 0; });
  const double each = n_open > 0 ? rained / static_cast<double>(n_open) : 0;
  Field liquid(film.rows(), film.cols());
  Field ground(film.rows(), film.cols());
  for_each(n, [&](Index i) {
    ground(i) = -space_at(i);
    liquid(i) = space_at(i) > 0 ? std::min(film(i), space_at(i)) + each : 0.0;
  });
  deposition::Settled settled = deposition::settle(ground, grid, liquid, edge, observer);
  Squeezed result{.film = std::move(settled.thickness), .lost = settled.lost};
  // In a gap that is full rounding stands above it, on contact, too.
  const double above =
      sum_over(n, [&](Index i) { return std::max(result.film(i) - space_at(i), 0.0); });
  result.without_space = (squeezed - rained + above) / static_cast<double>(n);
  for_each(n, [&](Index i) {
    result.film(i) = is_sealed(i) ? film(i) : std::min(result.film(i), space_at(i));
  });
  return result;
}

}  // namespace tabor::sliding
