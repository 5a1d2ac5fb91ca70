#include "tabor/metrology/spectra/lag_sums.hpp"

#include "tabor/core/error.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/numerics/field_statistics.hpp"
#include "tabor/spectral/fft.hpp"

namespace tabor::metrology {

Moments moments_of(const Field& height) {
  const auto first = sum_over_rows<2>(height.rows(), [&](Index y) {
    const auto row = height.row(y);
    return Eigen::Array2d(static_cast<double>((!row.isNaN()).count()),
                          row.isNaN().select(0, row).sum());
  });
  if (first[0] == 0) {
    throw InputError("correlation of heights", "no valid height", "a surface with heights", "");
  }
  const double mean = first[1] / first[0];
  if (numerics::is_flat(height)) return {first[0], mean, 0};
  const double square = sum_over_rows<1>(height.rows(), [&](Index y) {
    const auto row = height.row(y);
    return Eigen::Array<double, 1, 1>(row.isNaN().select(0, (row - mean).square()).sum());
  })[0];
  return {first[0], mean, square / first[0]};
}

Index padded_for_lags(Index n) { return spectral::good_fft_size(2 * n - 1); }

}  // namespace tabor::metrology
