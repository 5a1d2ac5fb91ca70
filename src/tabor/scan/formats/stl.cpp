// STL, binary: the surface as triangles between pixel centres, in millimetres, for programs of
// mechanical design and printers. It is open below and at the sides.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "tabor/core/units.hpp"
#include "tabor/io/files/atomic_file.hpp"
#include "tabor/scan/formats/bytes.hpp"
#include "tabor/scan/formats/readers.hpp"

namespace tabor::scan::format {
namespace {

using Point = Eigen::Vector3d;
constexpr double kMillimetres = 1e3;
constexpr std::size_t kTriangleSize = 50;

/// Squares between four valid heights; each becomes two triangles.
bool is_square(const Field& height, Index y, Index x) {
  return !height.block<2, 2>(y, x).isNaN().any();
}

std::size_t count_triangles(const Field& height) {
  std::size_t n = 0;
  for (Index y = 0; y + 1 < height.rows(); ++y) {
    for (Index x = 0; x + 1 < height.cols(); ++x) n += is_square(height, y, x) ? 2 : 0;
  }
  return n;
}

/// The y axis points up, the rows of a scan run down.
Point point(const topography::Topography& topography, Index y, Index x) {
  const Grid& grid = topography.grid;
  return kMillimetres * Point((static_cast<double>(x) + 0.5) * grid.dx(),
                              (static_cast<double>(grid.ny - y) - 0.5) * grid.dy(),
                              topography.height(y, x));
}

/// Appends a triangle whose corners run against the clock, seen from above.
void put_triangle(std::string& bytes, const Point& a, const Point& b, const Point& c) {
  const Point normal = (b - a).cross(c - a).normalized();
  for (const Point& vector : {normal, a, b, c}) {
    for (int i = 0; i < 3; ++i) put(bytes, static_cast<float>(vector[i]));
  }
  put(bytes, std::uint16_t{0});
}

std::string row_of_triangles(const topography::Topography& topography, Index y) {
  std::string bytes;
  for (Index x = 0; x + 1 < topography.grid.nx; ++x) {
    if (!is_square(topography.height, y, x)) continue;
    const Point top_left = point(topography, y, x), top_right = point(topography, y, x + 1);
    const Point left = point(topography, y + 1, x), right = point(topography, y + 1, x + 1);
    put_triangle(bytes, left, right, top_right);
    put_triangle(bytes, left, top_right, top_left);
  }
  return bytes;
}

}  // namespace

void write_stl(const topography::Topography& topography, const std::filesystem::path& file) {
  const std::size_t n = count_triangles(topography.height);
  if (n == 0 || n > 0xFFFFFFFF) {
    const bool is_thin = std::min(topography.grid.nx, topography.grid.ny) < 2;
    throw InputError(file.string(), fmt::format("{} triangles", n), "1 to 4294967295",
                     n > 0     ? "use <resample>"
                     : is_thin ? "write a map of at least 2 x 2 pixels"
                               : "no four neighbours have a height; use <fill=harmonic>");
  }
  io::write_file(file, [&](const io::Append& append) {
    std::string head;
    put_text(head, "tabor heights, millimetres", 80);  // must not begin with "solid"
    put(head, static_cast<std::uint32_t>(n));
    append(head);
    for (Index y = 0; y + 1 < topography.grid.ny; ++y) append(row_of_triangles(topography, y));
  });
}

bool is_stl(std::string_view bytes) {
  constexpr std::size_t header = 80;
  std::uint32_t n = 0;
  if (bytes.size() < header + sizeof(n)) return false;
  std::memcpy(&n, bytes.data() + header, sizeof(n));
  return n > 0 && bytes.size() == header + sizeof(n) + kTriangleSize * std::size_t{n};
}

std::string note_stl(const topography::Topography& topography) {
  const std::size_t n = count_triangles(topography.height);
  const double megabytes = static_cast<double>(n * kTriangleSize) / 1e6;
  constexpr double kLarge = 100;  // programs of mechanical design become slow
  return fmt::format("{} triangles in mm, {:.3g} MB{}", n, megabytes,
                     megabytes > kLarge ? "; <resample> makes the file smaller" : "");
}

}  // namespace tabor::scan::format
