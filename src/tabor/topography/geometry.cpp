#include "tabor/topography/geometry.hpp"

#include <fmt/format.h>

#include "tabor/core/error.hpp"
#include "tabor/core/mirror_images.hpp"
#include "tabor/numerics/field_statistics.hpp"
#include "tabor/topography/edges.hpp"
#include "tabor/topography/warnings.hpp"

namespace tabor::topography {
namespace {

void set_spacing(Grid& grid, Index nx, Index ny) {
  grid.lx = grid.dx() * static_cast<double>(nx);
  grid.ly = grid.dy() * static_cast<double>(ny);
  grid.nx = nx;
  grid.ny = ny;
}

bool inside(const PixelWindow& w, const Grid& grid) {
  return w.nx > 0 && w.ny > 0 && w.x0 >= 0 && w.y0 >= 0 && w.x0 < grid.nx && w.y0 < grid.ny &&
         w.nx <= grid.nx - w.x0 && w.ny <= grid.ny - w.y0;
}

/// True for the images that mirror() makes, whatever filters did to them since, and where a file
/// has them.
bool is_mirrored(const Topography& topography) {
  constexpr double rounding = 1e-6;  // of the rms height, as filters leave it
  return topography.tiles == 2 &&
         consists_of_images(topography.height, rounding * numerics::rms_height(topography.height));
}

/// Forgets the edges: those of a part are others, unless the body ends there.
void lose_edges(Topography& topography) {
  topography.periodic = false;
  topography.edges_match = false;
  topography.edges_joined = false;
  if (topography.edges != Edges::end) topography.edges.reset();
}

}  // namespace

Topography crop(Topography topography, const PixelWindow& window) {
  const Grid grid = topography.grid;
  if (!inside(window, grid)) {
    throw InputError(
        "crop", fmt::format("{},{},{},{} pixels", window.x0, window.y0, window.nx, window.ny),
        fmt::format("x0,y0,nx,ny inside the {} x {} pixels of the scan", grid.nx, grid.ny), "");
  }
  if (window.nx != grid.nx || window.ny != grid.ny) lose_edges(topography);
  topography.tiles = 1;
  const Field part = topography.height.block(window.y0, window.x0, window.ny, window.nx);
  topography.height = part;
  set_spacing(topography.grid, window.nx, window.ny);
  topography.history.push_back(fmt::format("crop={},{},{},{}: {} of {} pixels", window.x0,
                                           window.y0, window.nx, window.ny, topography.grid.size(),
                                           grid.size()));
  renew_spikes(topography);
  return topography;
}

Topography trim_margins(Topography topography, Index mx, Index my) {
  const Grid grid = topography.grid;
  if (mx < 0 || my < 0 || 2 * mx >= grid.nx || 2 * my >= grid.ny) {
    throw InputError("trim", fmt::format("{} columns and {} rows on each side", mx, my),
                     fmt::format("less than half of the {} x {} pixels", grid.nx, grid.ny), "");
  }
  topography = crop(std::move(topography), {mx, my, grid.nx - 2 * mx, grid.ny - 2 * my});
  topography.history.back() =
      fmt::format("trim: {} columns and {} rows off each side, {} x {} pixels left", mx, my,
                  topography.grid.nx, topography.grid.ny);
  return topography;
}

Topography mirror(Topography topography) {
  if (topography.edges && topography.edges != Edges::cut) {
    throw InputError("mirror", fmt::format("a surface with edges={}", kEdges.of(*topography.edges)),
                     "a cut-out of a larger one", "say once what lies beyond the edges");
  }
  if (topography.edges == Edges::cut || is_mirrored(topography)) return topography;
  topography.height = mirror_images(topography.height);
  set_spacing(topography.grid, 2 * topography.grid.nx, 2 * topography.grid.ny);
  topography.periodic = true;
  topography.edges = Edges::cut;
  topography.tiles = 2;
  topography.history.push_back(
      fmt::format("mirror: {} x {} pixels, periodic", topography.grid.nx, topography.grid.ny));
  return topography;
}

std::optional<Topography> scan_of_images(const Topography& topography) {
  if (!is_mirrored(topography)) return std::nullopt;
  Topography scan = topography;
  lose_edges(scan);
  scan.tiles = 1;
  scan.grid = grid_of_image(topography.grid);
  scan.height = first_image(topography.height);
  return scan;
}

Topography flip(Topography topography, Axis axis) {
  if (axis == Axis::x) {
    topography.height.rowwise().reverseInPlace();
  } else {
    topography.height.colwise().reverseInPlace();
  }
  topography.history.push_back(axis == Axis::x ? "flip=x" : "flip=y");
  return topography;
}

Topography transpose(Topography topography) {
  topography.height = Field(topography.height.transpose());
  std::swap(topography.grid.nx, topography.grid.ny);
  std::swap(topography.grid.lx, topography.grid.ly);
  topography.history.push_back("transpose");
  return topography;
}

}  // namespace tabor::topography
