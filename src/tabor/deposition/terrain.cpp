#include "tabor/deposition/terrain.hpp"

#include <cmath>

#include "tabor/core/error.hpp"
#include "tabor/core/loops.hpp"

namespace tabor::deposition {
namespace {

constexpr double kPicometre = 1e-12;                 // [m]
constexpr double kFinestQuantum = kPicometre / 256;  // far below any instrument's noise [m]
constexpr double kUsableQuanta = 4294967292.0;       // 2^32 without kDry, kNoRim and rounding

constexpr Index kMostPixels = Index{1} << 30;  // 32768 x 32768; what more would cost: PoolBuilder

double quantum_for(double range) {
  double quantum = kFinestQuantum;
  while (range > kUsableQuanta * quantum) quantum *= 2;
  return quantum;
}

}  // namespace

Terrain quantise(const Field& height, Edge edge) {
  if (height.size() == 0 || height.size() > kMostPixels) {
    throw InputError("surface to lubricate", std::to_string(height.size()) + " pixels",
                     "1 to " + std::to_string(kMostPixels), "");
  }
  if (!all_finite(height)) {
    throw InputError("surface to lubricate", "missing or infinite heights",
                     "a height at every pixel", "fill the holes first (<fill=harmonic>)");
  }
  const double lowest = height.minCoeff();
  Terrain terrain;
  terrain.nx = static_cast<Pixel>(height.cols());
  terrain.ny = static_cast<Pixel>(height.rows());
  terrain.edge = edge;
  terrain.quantum = quantum_for(height.maxCoeff() - lowest);
  terrain.height.resize(static_cast<std::size_t>(height.size()));
  for_each(terrain.size(), [&](Pixel p) {
    const double quanta = std::nearbyint((height.data()[p] - lowest) / terrain.quantum);
    terrain.height[static_cast<std::size_t>(p)] =
        static_cast<Height>(static_cast<std::int64_t>(quanta) + kDry + 1);
  });
  return terrain;
}

}  // namespace tabor::deposition
