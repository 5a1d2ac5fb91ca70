#include "tabor/reynolds/line/reynolds.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "tabor/core/error.hpp"

namespace tabor::reynolds {

namespace {

void check_cells(Index n) {
  if (n < 2) throw InputError("cells of a film", fmt::format("{}", n), "2 or more", "");
}

/// rho / eta of a liquid, and its derivative by pressure.
struct Fluidity {
  double value = 0;
  double by_pressure = 0;
};

Fluidity fluidity_of(const LiquidState& liquid) {
  const double value = liquid.density / liquid.viscosity;
  return {value, value * (liquid.density_slope / liquid.density -
                          liquid.viscosity_slope / liquid.viscosity)};
}

/// Mean of a fluidity that is an exponential of the pressure between the nodes, (a - b)/ln(a/b),
/// and its derivatives by a and b.
struct LogarithmicMean {
  double value, by_left, by_right;

  LogarithmicMean(double a, double b) {
    const double x = std::log(a / b);
    if (std::abs(x) < 1e-3) {
      value = (a + b) / 2 * (1 - x * x / 12);
      by_left = 0.5 - x / 6 + x * x / 24;
      by_right = 0.5 + x / 6 + x * x / 24;
      return;
    }
    value = (a - b) / x;
    by_left = (1 - value / a) / x;
    by_right = (value / b - 1) / x;
  }
};

}  // namespace

FilmGrid line_grid(double begin, double end, Index n) {
  check_cells(n);
  if (!(begin < end)) {
    throw InputError("film", fmt::format("{} to {} m", begin, end), "a beginning before the end",
                     "");
  }
  const double dx = (end - begin) / static_cast<double>(n);
  FilmGrid grid;
  grid.face = Eigen::ArrayXd::LinSpaced(n + 1, begin, end);
  grid.node.resize(n + 2);
  grid.node << begin, grid.face.head(n) + dx / 2, end;
  grid.width = Eigen::ArrayXd::Ones(n + 1);
  grid.volume = Eigen::ArrayXd::Constant(n, dx);
  return grid;
}

FilmGrid disc_grid(double radius, Index n) {
  check_cells(n);
  if (!(radius > 0)) {
    throw InputError("radius of a film", fmt::format("{} m", radius), "more than zero", "");
  }
  const double dr = radius / static_cast<double>(n);
  FilmGrid grid;
  grid.shape = FilmShape::disc;
  grid.node.resize(n + 2);
  grid.node << 0, Eigen::ArrayXd::LinSpaced(n + 1, 0, radius);
  grid.face.resize(n + 1);
  grid.face << 0, grid.node.segment(1, n) + dr / 2;
  grid.width = 2 * std::numbers::pi * grid.face;
  grid.volume = std::numbers::pi * (grid.face.tail(n).square() - grid.face.head(n).square());
  return grid;
}

LiquidState liquid_at(const material::Lubricant& lubricant, double pressure, double density) {
  const auto viscosity = material::viscosity_at(lubricant.viscosity, pressure);
  const auto relative_density = lubricant.density.at(pressure);
  return {.density = density * relative_density.value,
          .density_slope = density * relative_density.by_pressure,
          .viscosity = viscosity.value,
          .viscosity_slope = viscosity.by_pressure};
}

LiquidState liquid_at(const material::NodeLaws& laws, Index i) {
  return {.density = laws.density[i],
          .density_slope = laws.density_by_pressure[i],
          .viscosity = laws.viscosity[i],
          .viscosity_slope = laws.viscosity_by_pressure[i]};
}

material::Lubricant constant_liquid(double viscosity) {
  return {.viscosity = material::constant_viscosity(viscosity), .density = {}, .shear = {}};
}

// Both halves of the gap are resistances 12 d/h^3 in series, under the same fluidity: at a step of
// the film the pressure, and with it the viscosity, is the same on both sides. Without the pressure
// at the face, m = theta u g + (pL - pR) f / r, where r = sum 12 d/h^3 and g, the mean of rho h, is
// weighted by the parts of r.
FaceFlow face_flow(const FilmNode& left, const FilmNode& right, double speed) {
  const FilmNode* const nodes[2] = {&left, &right};
  double part[2];
  for (int i = 0; i < 2; ++i) {
    const double film = nodes[i]->film;
    part[i] = 12 * nodes[i]->distance / (film * film * film);
  }
  const Fluidity fluidity[2] = {fluidity_of(left.liquid), fluidity_of(right.liquid)};
  const LogarithmicMean mean(fluidity[0].value, fluidity[1].value);
  const double resistance = part[0] + part[1];
  const double mass[2] = {left.liquid.density * left.film, right.liquid.density * right.film};
  const double carried = (part[0] * mass[0] + part[1] * mass[1]) / resistance;
  const double slope = (left.pressure - right.pressure) / resistance;
  const double wall = (speed >= 0 ? left.fill : right.fill) * speed;

  FaceFlow face;
  face.couette = speed * carried;
  face.flow = wall * carried + slope * mean.value;
  for (int i = 0; i < 2; ++i) {
    const double share = part[i] / resistance;
    const double by_fluidity = slope * (i == 0 ? mean.by_left : mean.by_right);
    face.by_pressure[i] = (i == 0 ? 1 : -1) * mean.value / resistance +
                          by_fluidity * fluidity[i].by_pressure +
                          wall * share * nodes[i]->liquid.density_slope * nodes[i]->film;
    // A thinner film makes its part of the resistance larger: d(part)/dh = -3 part/h.
    const double by_part = (wall * (mass[i] - carried) - slope * mean.value) / resistance;
    const double thinning = -fluidity[i].value * nodes[i]->viscosity_by_film /
                            nodes[i]->liquid.viscosity;  // d(rho / eta)/dh
    face.by_film[i] = -3 * by_part * part[i] / nodes[i]->film +
                      wall * share * nodes[i]->liquid.density + by_fluidity * thinning;
  }
  return face;
}

}  // namespace tabor::reynolds
