#include "tabor/ehl/point/elastic.hpp"

namespace tabor::ehl {
namespace {

/// The next number whose double has only prime factors that transforms are fast for.
Index fast_size(Index n) {
  for (;; ++n) {
    Index rest = n;
    for (const Index prime : {2, 3, 5, 7, 13}) {
      while (rest % prime == 0) rest /= prime;
    }
    if (rest == 1) return n;
  }
}

Grid fast_grid(const Grid& film) {
  const Index nx = fast_size(film.nx);
  const Index ny = fast_size(film.ny);
  return {.nx = nx,
          .ny = ny,
          .lx = film.dx() * static_cast<double>(nx),
          .ly = film.dy() * static_cast<double>(ny)};
}

}  // namespace

PointElastic::PointElastic(const Grid& film, double effective_modulus, double unit)
    : film_(film),
      effective_modulus_(effective_modulus),
      unit_(unit),
      space_(elastic::make_free(fast_grid(film), effective_modulus)) {}

Field PointElastic::operator()(const Field& pressure) const {
  Field padded = Field::Zero(space_->grid().ny, space_->grid().nx);
  padded.topLeftCorner(film_.ny, film_.nx) = pressure;
  space_->apply(padded, padded);
  return unit_ * padded.topLeftCorner(film_.ny, film_.nx);
}

double PointElastic::influence(Index dy, Index dx) const {
  return unit_ * elastic::love_coefficient(static_cast<double>(dx) * film_.dx(),
                                           static_cast<double>(dy) * film_.dy(), film_.dx(),
                                           film_.dy(), effective_modulus_);
}

double PointElastic::dipole_influence(Index dy, Index dx) const {
  return influence(dy, dx) - 0.25 * (influence(dy, dx - 1) + influence(dy, dx + 1) +
                                     influence(dy - 1, dx) + influence(dy + 1, dx));
}

}  // namespace tabor::ehl
