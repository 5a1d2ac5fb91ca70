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
