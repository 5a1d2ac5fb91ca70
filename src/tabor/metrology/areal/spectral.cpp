// Spectral moments m0, m2, m4 and what random-surface theory makes of them (Longuet-Higgins 1957,
// Nayak 1971).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tabor/metrology/areal/sets.hpp"
#include "tabor/metrology/areal/spectral_moments.hpp"
#include "tabor/numerics/field_statistics.hpp"

namespace tabor::metrology {
namespace {

using std::numbers::pi;

/// Mean of the squares of of_pixel(y, x), NaN left out; NaN without any.
template <typename OfPixel>
double mean_square(Index n_rows, Index n_columns, const OfPixel& of_pixel) {
  return numerics::mean_over(n_rows, n_columns, [&](Index y, Index x) {
    const double value = of_pixel(y, x);
    return value * value;
  });
}

void add_slopes(const topography::Topography& topography, SpectralMoments& moments) {
  const numerics::SquareSlopes slopes =
      numerics::mean_square_slopes(topography.height, topography.grid);
  moments.m2_x = slopes.along_x;
  moments.m2_y = slopes.along_y;
  moments.m2 = (moments.m2_x + moments.m2_y) / 2;
}

void add_curvatures(const topography::Topography& topography, SpectralMoments& moments) {
  const Field& z = topography.height;
  const Grid& grid = topography.grid;
  const double dx2 = grid.dx() * grid.dx(), dy2 = grid.dy() * grid.dy();
  const auto along_x = [&](Index y, Index x) {
    return (z(y, x + 2) - 2 * z(y, x + 1) + z(y, x)) / dx2;
  };
  const auto along_y = [&](Index y, Index x) {
    return (z(y + 2, x) - 2 * z(y + 1, x) + z(y, x)) / dy2;
  };
  moments.m4_x = mean_square(grid.ny, grid.nx - 2, [&](Index y, Index x) { return along_x(y, x); });
  moments.m4_y = mean_square(grid.ny - 2, grid.nx, [&](Index y, Index x) { return along_y(y, x); });
  moments.m4 = 3.0 / 8 * mean_square(grid.ny - 2, grid.nx - 2, [&](Index y, Index x) {
                 return along_x(y + 1, x) + along_y(y, x + 1);
               });
}

/// Curvatures of a plane are rounding of its heights: zero.
void drop_rounding(const topography::Topography& topography, SpectralMoments& moments) {
  const double rounding = numerics::rounding_of(numerics::largest_magnitude(topography.height));
  const double dx = topography.grid.dx(), dy = topography.grid.dy();
  const double along_x = rounding / (dx * dx), along_y = rounding / (dy * dy);
  const auto drop = [](double& moment, double least) {
    if (moment <= least * least) moment = 0;
  };
  drop(moments.m4_x, along_x);
  drop(moments.m4_y, along_y);
  drop(moments.m4, std::max(along_x, along_y));
}

struct Wording {
  std::string suffix;  ///< of the symbols
  std::string how;     ///< behind the definitions
};

/// The nine moments with their symbols.
void append_moments(const SpectralMoments& m, const Wording& by, const std::string& note,
                    std::vector<Parameter>& found) {
  const auto add = [&](const char* symbol, double value, const char* unit, const char* formula) {
    found.push_back({symbol + by.suffix, value, unit, formula + by.how,
                     std::isnan(value) ? note : std::string()});
  };
  add("m0", m.m0, "m^2", "<z^2>");
  add("m2_x", m.m2_x, "1", "<(dz/dx)^2>");
  add("m2_y", m.m2_y, "1", "<(dz/dy)^2>");
  add("m2", m.m2, "1", "isotropic <|grad z|^2>/2");
  add("m4_x", m.m4_x, "1/m^2", "<(d2z/dx2)^2>");
  add("m4_y", m.m4_y, "1/m^2", "<(d2z/dy2)^2>");
  add("m4", m.m4, "1/m^2", "isotropic (3/8) <(d2z/dx2 + d2z/dy2)^2>");
}

/// Nayak's parameter and the statistics of summits, from the isotropic moments.
void append_summits(const SpectralMoments& m, const Wording& by, const std::string& why_not,
                    std::vector<Parameter>& found) {
  const bool exists = m.m2 > 0 && m.m4 > 0;
  const std::string note = exists ? "" : why_not;
  const auto add = [&](const char* symbol, double value, const char* unit, const char* formula) {
    found.push_back({symbol + by.suffix, exists ? value : kNoValue, unit, formula + by.how, note});
  };
  const double alpha = m.m0 * m.m4 / (m.m2 * m.m2);
  const double variance = (1 - 0.8968 / alpha) * m.m0;
  add("alpha", alpha, "1", "Nayak's bandwidth parameter m0 m4/m2^2, isotropic moments");
  add("D_sum", m.m4 / m.m2 / (6 * pi * std::numbers::sqrt3), "1/m^2",
      "summit density m4/(6 pi sqrt(3) m2) of a Gaussian surface (Nayak 1971)");
  add("R_sum", 3.0 / 8 * std::sqrt(pi / m.m4), "m",
      "mean summit radius (3/8) sqrt(pi/m4) for Bush-Gibson-Thomas and Greenwood-Williamson "
      "contact");
  add("sigma_sum", variance >= 0 ? std::sqrt(variance) : kNoValue, "m",
      "rms summit height sqrt((1 - 0.8968/alpha) m0) for Greenwood-Williamson contact");
  if (exists && variance < 0) found.back().note = "alpha < 0.8968, which no Gaussian surface has";
}

SpectralMoments no_moments() {
  return {kNoValue, kNoValue, kNoValue, kNoValue, kNoValue, kNoValue, kNoValue};
}

}  // namespace

SpectralMoments difference_moments(const topography::Topography& topography) {
  SpectralMoments moments;
  moments.m0 = numerics::field_moments(topography.height).second;
  add_slopes(topography, moments);
  add_curvatures(topography, moments);
  drop_rounding(topography, moments);
  return moments;
}

std::vector<Parameter> spectral_parameters(const topography::Topography& topography) {
  std::vector<Parameter> found;
  const Wording by_differences{
      "", "; neighbouring pixels' differences, those touching a hole left out"};
  const SpectralMoments differences = difference_moments(topography);
  append_moments(differences, by_differences, "needs three valid points in a row", found);
  append_summits(differences, by_differences, "needs a rough surface of three by three points",
                 found);
  const bool complete = topography::count_holes(topography) == 0;
  const Wording by_spectrum{
      "_psd", std::string("; sum over the power spectrum, ") +
                  (topography.periodic ? "no window" : "Hann window along both axes")};
  const std::string note = complete ? "" : "needs a surface without holes";
  const SpectralMoments spectrum = complete ? spectrum_moments(topography) : no_moments();
  append_moments(spectrum, by_spectrum, note, found);
  append_summits(spectrum, by_spectrum, complete ? "needs a rough surface" : note, found);
  return found;
}

}  // namespace tabor::metrology
