#include "tabor/synthesis/random_field.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "tabor/core/random.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/spectral/fft.hpp"

namespace tabor::synthesis {
namespace {

using std::numbers::pi;
using Complex = std::complex<double>;
using HalfSpectrum = Eigen::Array<Complex, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Index signed_frequency(Index k, Index n) { return 2 * k > n ? k - n : k; }

/// A number of unit mean square that belongs to the wavevector (kx, ky).
class ModeSource {
 public:
  explicit ModeSource(const RandomFieldRecipe& recipe)
      : random_(recipe.seed, recipe.stream), random_amplitudes_(recipe.random_amplitudes) {}

  Complex operator()(Index kx, Index ky) const {
    if (kx == 0 && ky < 0) {
      return std::conj((*this)(0, -ky));  // a real field's spectrum is Hermitian
    }
    const auto key = (static_cast<std::uint64_t>(kx) << 32) | static_cast<std::uint32_t>(ky);
    if (random_amplitudes_) {
      return Complex(random_.normal(2 * key), random_.normal(2 * key + 1)) / std::numbers::sqrt2;
    }
    return std::polar(1.0, 2 * pi * random_.uniform(key));
  }

 private:
  CounterRandom random_;
  bool random_amplitudes_;
};

bool is_free(Index kx, Index ky, const Grid& grid) {
  return (kx != 0 || ky != 0) && 2 * kx != grid.nx && 2 * ky != grid.ny;
}

}  // namespace

double elliptic_wavevector(double qx, double qy, double stretch) {
  const double root = std::sqrt(stretch);
  return std::hypot(qx * root, qy / root);
}

RandomField random_field(const RandomFieldRecipe& recipe) {
  const Grid& grid = recipe.grid;
  const ModeSource source(recipe);
  HalfSpectrum modes(grid.ny, grid.nx / 2 + 1);
  const auto sums = sum_over_rows<2>(grid.ny, [&](Index row) {
    Eigen::Array2d total = Eigen::Array2d::Zero();
    const Index ky = signed_frequency(row, grid.ny);
    const double qy = 2 * pi * static_cast<double>(ky) / grid.ly;
    for (Index kx = 0; kx < modes.cols(); ++kx) {
      const double qx = 2 * pi * static_cast<double>(kx) / grid.lx;
      const double power =
          is_free(kx, ky, grid) ? recipe.power(elliptic_wavevector(qx, qy, recipe.stretch)) : 0;
      const Complex mode = power > 0 ? std::sqrt(power) * source(kx, ky) : 0;
      modes(row, kx) = mode * static_cast<double>(grid.size());  // the inverse divides by it
      const double share = (kx == 0 ? 1 : 2) * std::norm(mode);
      total += Eigen::Array2d(share, share * (qx * qx + qy * qy));
    }
    return total;
  });
  RandomField field{Field(grid.ny, grid.nx), sums[0], sums[1]};
  spectral::RealFft2d<double>(grid.ny, grid.nx).inverse(modes.data(), field.height.data());
  return field;
}

}  // namespace tabor::synthesis
