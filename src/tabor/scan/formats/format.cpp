#include "tabor/scan/formats/format.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tabor/core/error.hpp"
#include "tabor/core/resources.hpp"

namespace tabor::scan::format {

void Contents::finished(std::string_view decoded, double share) const {
  if (source != nullptr) source->release(decoded);
  if (observer != nullptr) report_progress(*observer, "read", share);
}

void reject(const Contents& contents, const std::string& got, const std::string& expected,
            const std::string& remedy) {
  throw InputError(contents.file.string(), got, expected, remedy);
}

void ask(const Contents& contents, const std::string& got, const std::string& expected,
         const std::string& remedy) {
  throw IncompleteError(contents.file.string(), got, expected, remedy);
}

void check_size(const Contents& contents, double nx, double ny, std::size_t available) {
  if (!(nx >= 1) || !(ny >= 1) || nx != std::floor(nx) || ny != std::floor(ny)) {
    reject(contents, fmt::format("a size of {} x {} pixels", nx, ny), "at least 1 x 1", kDamaged);
  }
  if (nx * ny > static_cast<double>(available)) {
    reject(contents, fmt::format("{} samples", available),
           fmt::format("{} x {} as its header says", nx, ny), kDamaged);
  }
  const std::size_t memory = available_memory_bytes();
  if (memory > 0 && nx * ny * sizeof(double) > static_cast<double>(memory)) {
    reject(contents, fmt::format("{} x {} pixels", nx, ny), "a map that fits into memory",
           fmt::format("{:.2g} GB are free", static_cast<double>(memory) * 1e-9));
  }
}

bool is_pixel(double length) { return length >= 1e-15 && length <= 1e6; }

double checked_pixel(const Contents& contents, double pixel) {
  if (!is_pixel(pixel)) {
    reject(contents, fmt::format("a pixel of {} m", pixel),
           "a positive length, from 1e-15 to 1e6 m", kDamaged);
  }
  return pixel;
}

}  // namespace tabor::scan::format
