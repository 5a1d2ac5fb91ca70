#include "tabor/deposition/images.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tabor/core/mirror_images.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/deposition/film_measures.hpp"

namespace tabor::deposition {
namespace {

constexpr double kRounding = 1e-6;  // of the range of heights, as filters leave it

bool consists_of_images(const Field& height) {
  const Index ny = height.rows();
  const Index nx = height.cols();
  if (ny % 2 != 0 || nx % 2 != 0) return false;
  const double most = kRounding * (height.maxCoeff() - height.minCoeff());
  const auto n_differing = sum_over_rows<1>(ny, [&](Index y) {
    double n = 0;
    const Index y_of_image = std::min(y, ny - 1 - y);
    for (Index x = 0; x < nx; ++x) {
      const double of_image = height(y_of_image, std::min(x, nx - 1 - x));
      n += std::abs(height(y, x) - of_image) <= most ? 0 : 1;
    }
    return Eigen::Array<double, 1, 1>(n);
  });
  return n_differing[0] == 0;
}

}  // namespace

bool rains_on_one_image(const Field& height, const Dose& dose) {
  const bool runs_down = dose.model == Model::droplets || dose.model == Model::limit;
  return dose.mirrored && runs_down && dose.edge != Edge::open && consists_of_images(height);
}

Field first_image(const Field& map) { return map.topLeftCorner(map.rows() / 2, map.cols() / 2); }

Grid grid_of_image(const Grid& grid) {
  return {.nx = grid.nx / 2, .ny = grid.ny / 2, .lx = grid.lx / 2, .ly = grid.ly / 2};
}

Dose dose_of_image(Dose dose) {
  dose.mirrored = false;
  dose.edge = Edge::closed;
  return dose;
}

Film with_images(Film film, Edge edge) {
  constexpr int n_images = 4;
  film.thickness = mirror_images(film.thickness);
  film.dosed_volume *= n_images;
  film.deposited_volume *= n_images;
  film.n_droplets *= n_images;
  film.n_images = n_images;
  measure(film, edge);
  return film;
}

}  // namespace tabor::deposition
