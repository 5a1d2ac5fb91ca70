// Hybrid parameters: slope and developed area.
#include <cmath>

#include "tabor/metrology/areal/sets.hpp"
#include "tabor/numerics/field_statistics.hpp"

namespace tabor::metrology {
namespace {

/// sqrt(1 + s) - 1 without losing small s.
double excess_length(double s) { return s / (1 + std::sqrt(1 + s)); }

/// Developed over projected area, minus one, of one cell: both triangulations, averaged.
/// Each triangle spans one x edge and one y edge, hence has the slopes of these two edges.
double excess_of_two(double z00, double z10, double z01, double z11, double dx, double dy) {
  const double top = (z10 - z00) / dx, bottom = (z11 - z01) / dx;
  const double left = (z01 - z00) / dy, right = (z11 - z10) / dy;
  return (excess_length(top * top + left * left) + excess_length(bottom * bottom + right * right) +
          excess_length(top * top + right * right) + excess_length(bottom * bottom + left * left)) /
         4;
}

/// The same with four triangles that meet at the mean of the corners: each has the slope of its
/// edge and, across it, the rise from the edge's middle to the centre over half a pixel.
double excess_of_four(double z00, double z10, double z01, double z11, double dx, double dy) {
  const double centre = (z00 + z10 + z01 + z11) / 4;
  const auto triangle = [&](double a, double b, double along, double across) {
    const double edge = (b - a) / along, rise = (centre - (a + b) / 2) / (across / 2);
    return excess_length(edge * edge + rise * rise);
  };
  return (triangle(z00, z10, dx, dy) + triangle(z01, z11, dx, dy) + triangle(z00, z01, dy, dx) +
          triangle(z10, z11, dy, dx)) /
         4;
}

std::string stencil_text(SlopeStencil stencil) {
  return stencil == SlopeStencil::forward
             ? "forward differences on the common (nx-1)(ny-1) grid"
             : "seven-point differences (z3 - 9 z2 + 45 z1 - 45 z-1 + 9 z-2 - z-3)/60 on the "
               "(nx-6)(ny-6) inner pixels";
}

std::string triangles_text(AreaTriangles triangles) {
  return triangles == AreaTriangles::two ? "mean of both splits of each cell into two triangles"
                                         : "four triangles of each cell to the mean of its corners";
}

}  // namespace

double rms_slope(const topography::Topography& topography, SlopeStencil stencil) {
  return stencil == SlopeStencil::forward
             ? numerics::rms_slope(topography.height, topography.grid)
             : numerics::seven_point_rms_slope(topography.height, topography.grid);
}

double developed_area_ratio(const topography::Topography& topography, AreaTriangles triangles) {
  const Field& z = topography.height;
  const double dx = topography.grid.dx(), dy = topography.grid.dy();
  const auto excess = triangles == AreaTriangles::two ? excess_of_two : excess_of_four;
  return 100 * numerics::mean_over(z.rows() - 1, z.cols() - 1, [&](Index y, Index x) {
           return excess(z(y, x), z(y, x + 1), z(y + 1, x), z(y + 1, x + 1), dx, dy);
         });
}

std::vector<Parameter> hybrid_parameters(const topography::Topography& topography,
                                         const ParameterOptions& options) {
  const double slope = rms_slope(topography, options.stencil);
  const double area = developed_area_ratio(topography, options.triangles);
  const auto note = [](double value) {
    return std::isnan(value) ? "no pixel has all the neighbours it needs" : "";
  };
  return {
      {"Sdq", slope, "1",
       "root mean square gradient sqrt(<(dz/dx)^2 + (dz/dy)^2>), " + stencil_text(options.stencil) +
           ", gradients touching a hole left out",
       note(slope)},
      {"Sdr", area, "%",
       "developed interfacial area ratio 100 (developed/projected - 1), " +
           triangles_text(options.triangles) + ", cells touching a hole left out",
       note(area)},
  };
}

}  // namespace tabor::metrology
