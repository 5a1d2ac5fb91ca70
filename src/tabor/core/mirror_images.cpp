#include "tabor/core/mirror_images.hpp"

#include <algorithm>
#include <cmath>

namespace tabor {

bool consists_of_images(const Field& map, double rounding) {
  const Index ny = map.rows();
  const Index nx = map.cols();
  if (ny % 2 != 0 || nx % 2 != 0) return false;
  const auto n_differing = [&](Index y) {
    double n = 0;
    const Index y_of_image = std::min(y, ny - 1 - y);
    for (Index x = 0; x < nx; ++x) {
      const double of_image = map(y_of_image, std::min(x, nx - 1 - x));
      const bool are_holes = std::isnan(map(y, x)) && std::isnan(of_image);
      n += are_holes || std::abs(map(y, x) - of_image) <= rounding ? 0 : 1;
    }
    return Eigen::Array<double, 1, 1>(n);
  };
  // The first row tells nearly always.
  return ny == 0 || (n_differing(0)[0] == 0 && sum_over_rows<1>(ny, n_differing)[0] == 0);
}

Field first_image(const Field& map) { return map.topLeftCorner(map.rows() / 2, map.cols() / 2); }

Grid grid_of_image(const Grid& grid) {
  return {.nx = grid.nx / 2, .ny = grid.ny / 2, .lx = grid.lx / 2, .ly = grid.ly / 2};
}

}  // namespace tabor
