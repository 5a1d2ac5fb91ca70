#include "tabor/scan/formats/format.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tabor/core/checks.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"

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

namespace {

void check_whole(const Contents& contents, double nx, double ny) {
  if (!(nx >= 1) || !(ny >= 1) || nx != std::floor(nx) || ny != std::floor(ny)) {
    reject(contents, fmt::format("a size of {} x {} pixels", nx, ny), "at least 1 x 1", kDamaged);
  }
}

void check_heights_fit(const Contents& contents, double nx, double ny) {
  check_memory(contents.file.string(), fmt::format("{} x {} pixels", nx, ny),
               nx * ny * sizeof(double), "");
}

}  // namespace

void check_size(const Contents& contents, double nx, double ny, std::size_t available) {
  check_whole(contents, nx, ny);
  if (nx * ny > static_cast<double>(available)) {
    reject(contents, fmt::format("{} samples", available),
           fmt::format("{} x {} as its header says", nx, ny), kDamaged);
  }
  check_heights_fit(contents, nx, ny);
}

void check_packed_size(const Contents& contents, double nx, double ny, std::size_t packed_bytes,
                       std::size_t ratio, std::size_t sample_bytes) {
  check_whole(contents, nx, ny);
  const std::size_t most = packed_bytes * ratio / sample_bytes;
  if (nx * ny > static_cast<double>(most)) {
    reject(contents, fmt::format("{} x {} pixels in its header", nx, ny),
           fmt::format("as many as its {} bytes can hold", packed_bytes), kDamaged);
  }
  check_heights_fit(contents, nx, ny);
}

bool is_pixel(double length) { return length >= 1e-15 && length <= 1e6; }

std::optional<double> stated_number(std::string_view text) {
  if (trim(text).empty()) return std::nullopt;
  return parse_number(text).value_or(kHole);
}

}  // namespace tabor::scan::format
