#include "tabor/topography/formats/format.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tabor/core/error.hpp"

namespace tabor::topography::format {

void refuse(const Contents& contents, const std::string& got, const std::string& expected,
            const std::string& remedy) {
  throw InputError(contents.file.string(), got, expected, remedy);
}

void ask(const Contents& contents, const std::string& got, const std::string& expected,
         const std::string& remedy) {
  throw IncompleteError(contents.file.string(), got, expected, remedy);
}

void check_size(const Contents& contents, double nx, double ny, std::size_t available) {
  if (!(nx >= 1) || !(ny >= 1) || nx != std::floor(nx) || ny != std::floor(ny)) {
    refuse(contents, fmt::format("a size of {} x {} pixels", nx, ny), "at least 1 x 1", kDamaged);
  }
  if (nx * ny > static_cast<double>(available)) {
    refuse(contents, fmt::format("{} samples", available),
           fmt::format("{} x {} as its header says", nx, ny), kDamaged);
  }
}

double checked_pixel(const Contents& contents, double pixel) {
  if (!(pixel > 0) || !std::isfinite(pixel)) {
    refuse(contents, fmt::format("a pixel of {} m", pixel), "a positive length", kDamaged);
  }
  return pixel;
}

}  // namespace tabor::topography::format
