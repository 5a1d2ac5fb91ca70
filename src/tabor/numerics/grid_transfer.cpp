#include "tabor/numerics/grid_transfer.hpp"

#include <algorithm>

namespace tabor::numerics {

NodeTransfer::NodeTransfer(const Grid& fine, const Grid& coarse)
    : fine_(fine), coarse_(coarse), x_(places(fine.nx, coarse.nx)), y_(places(fine.ny, coarse.ny)) {
  weight_ = transposed(Field::Ones(fine.ny, fine.nx));
}

std::vector<NodeTransfer::Place> NodeTransfer::places(Index fine, Index coarse) {
  const double step = static_cast<double>(coarse - 1) / static_cast<double>(fine - 1);
  std::vector<Place> result(static_cast<std::size_t>(fine));
  double place = 0;
  for (Index i = 0; i < fine; ++i) {
    place = static_cast<double>(i) * step;
    Place& at = result[static_cast<std::size_t>(i)];
    at.lower = std::clamp(static_cast<Index>(place), Index{0}, coarse - 2);
    at.share = place - static_cast<double>(at.lower);
  }
  return result;
}

Field NodeTransfer::to_fine(const Field& coarse) const {
  Field fine(fine_.ny, fine_.nx);
  for (Index j = 0; j < fine_.ny; ++j) {
    const auto [b, t] = y_[static_cast<std::size_t>(j)];
    for (Index i = 0; i < fine_.nx; ++i) {
      const auto [a, s] = x_[static_cast<std::size_t>(i)];
      fine(j, i) = (1 - t) * ((1 - s) * coarse(b, a) + s * coarse(b, a + 1)) +
                   t * ((1 - s) * coarse(b + 1, a) + s * coarse(b + 1, a + 1));
    }
  }
  return fine;
}

Field NodeTransfer::transposed(const Field& fine) const {
  Field coarse = Field::Zero(coarse_.ny, coarse_.nx);
  for (Index j = 0; j < fine_.ny; ++j) {
    const auto [b, t] = y_[static_cast<std::size_t>(j)];
    for (Index i = 0; i < fine_.nx; ++i) {
      const auto [a, s] = x_[static_cast<std::size_t>(i)];
      const double value = fine(j, i);
      coarse(b, a) += (1 - t) * (1 - s) * value;
      coarse(b, a + 1) += (1 - t) * s * value;
      coarse(b + 1, a) += t * (1 - s) * value;
      coarse(b + 1, a + 1) += t * s * value;
    }
  }
  return coarse;
}

}  // namespace tabor::numerics
