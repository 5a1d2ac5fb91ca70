#include "tabor/deposition/images.hpp"

#include <utility>

#include "tabor/core/mirror_images.hpp"
#include "tabor/deposition/film_measures.hpp"

namespace tabor::deposition {
namespace {

constexpr double kRounding = 1e-6;  // of the range of heights, as filters leave it

}  // namespace

bool rains_on_one_image(const Field& height, const Dose& dose) {
  const bool runs_down = dose.model == Model::droplets || dose.model == Model::limit;
  if (!dose.mirrored || !runs_down || dose.edge == Edge::open) return false;
  return consists_of_images(height, kRounding * (height.maxCoeff() - height.minCoeff()));
}

Dose dose_of_image(Dose dose) {
  dose.mirrored = false;
  dose.edge = Edge::closed;
  return dose;
}

Wetting of_image(const Wetting& wetting) {
  const Mask& where = wetting.where;
  if (where.size() == 0) return wetting;
  const Mask on_any_image =
      where || where.rowwise().reverse() || where.colwise().reverse() || where.reverse();
  return {wetting.mean_films, on_any_image.topLeftCorner(where.rows() / 2, where.cols() / 2)};
}

std::vector<std::uint16_t> with_images(const std::vector<std::uint16_t>& of_image, const Grid& grid,
                                       const Wetting& wetting) {
  using Doses = Eigen::Array<std::uint16_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  std::vector<std::uint16_t> first(static_cast<std::size_t>(grid.size()));
  Eigen::Map<Doses> all(first.data(), grid.ny, grid.nx);
  all = mirror_images<Doses>(Eigen::Map<const Doses>(of_image.data(), grid.ny / 2, grid.nx / 2));
  if (wetting.where.size() == 0) return first;
  const auto none = static_cast<std::uint16_t>(wetting.mean_films.size());
  all = wetting.where.select(all, none);
  return first;
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
