#include "tabor/numerics/grid_transfer.hpp"

#include <algorithm>

#include "tabor/core/rows.hpp"

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
  for_each_row(fine_.ny, [&](Index j) {
    const auto [b, t] = y_[static_cast<std::size_t>(j)];
    for (Index i = 0; i < fine_.nx; ++i) {
      const auto [a, s] = x_[static_cast<std::size_t>(i)];
      fine(j, i) = (1 - t) * ((1 - s) * coarse(b, a) + s * coarse(b, a + 1)) +
                   t * ((1 - s) * coarse(b + 1, a) + s * coarse(b + 1, a + 1));
    }
  });
  return fine;
}

Field NodeTransfer::transposed(const Field& fine) const {
  Field coarse = Field::Zero(coarse_.ny, coarse_.nx);
  for_each_row(coarse_.ny, [&](Index row) {
    // The fine rows between this coarse row and those beside it.
    const auto begin = std::partition_point(y_.begin(), y_.end(),
                                            [row](const Place& at) { return at.lower < row - 1; });
    const auto end =
        std::partition_point(begin, y_.end(), [row](const Place& at) { return at.lower <= row; });
    for (auto at = begin; at != end; ++at) {
      const double weight = at->lower == row ? 1 - at->share : at->share;
      const Index j = at - y_.begin();
      for (Index i = 0; i < fine_.nx; ++i) {
        const auto [a, s] = x_[static_cast<std::size_t>(i)];
        coarse(row, a) += weight * (1 - s) * fine(j, i);
        coarse(row, a + 1) += weight * s * fine(j, i);
      }
    }
  });
  return coarse;
}

}  // namespace tabor::numerics
