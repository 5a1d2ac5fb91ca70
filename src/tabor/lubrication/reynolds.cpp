#include "tabor/lubrication/reynolds.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "tabor/core/error.hpp"

namespace tabor::lubrication {

namespace {

void check_cells(Index n) {
  if (n < 2) throw InputError("cells of a film", fmt::format("{}", n), "2 or more", "");
}

/// Half a gap between a node and a face.
struct Half {
  double conductance = 0;  ///< k = rho h^3 / (12 eta) [kg/(m Pa s) m]
  double by_pressure = 0;  ///< of k
  double by_film = 0;      ///< of k
};

Half half_of(const FilmNode& node) {
  const LiquidState& liquid = node.liquid;
  Half half;
  half.conductance = liquid.density * node.film * node.film * node.film / (12 * liquid.viscosity);
  half.by_pressure = half.conductance * (liquid.density_slope / liquid.density -
                                         liquid.viscosity_slope / liquid.viscosity);
  half.by_film = 3 * half.conductance / node.film;
  return half;
}

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

LiquidLaw constant_liquid(double viscosity, double density) {
  return [=](double) { return LiquidState{.density = density, .viscosity = viscosity}; };
}

// With the pressure pf of the face eliminated, m = (u g - (pR - pL)) / r where r = sum d/k is the
// resistance and g = sum rho h d/k: the Couette flow is the mean of both nodes, weighted by d/k.
FaceFlow face_flow(const FilmNode& left, const FilmNode& right, double speed) {
  const FilmNode* const nodes[2] = {&left, &right};
  const Half halves[2] = {half_of(left), half_of(right)};
  double resistance = 0;
  double carried = 0;
  for (int i = 0; i < 2; ++i) {
    const double part = nodes[i]->distance / halves[i].conductance;
    resistance += part;
    carried += part * nodes[i]->liquid.density * nodes[i]->film;
  }
  const double fill = speed >= 0 ? left.fill : right.fill;
  const double mean = carried / resistance;  // rho h of the face
  const double drop = left.pressure - right.pressure;
  FaceFlow face;
  face.couette = speed * mean;
  face.flow = fill * face.couette + drop / resistance;
  for (int i = 0; i < 2; ++i) {
    const FilmNode& node = *nodes[i];
    const double part = node.distance / halves[i].conductance;
    const double mass = node.liquid.density * node.film;
    // d(part)/dk = -part/k; what a change of `part` does to the flow:
    const double by_part = (fill * speed * (mass - mean) - drop / resistance) / resistance;
    const double by_conductance = -by_part * part / halves[i].conductance;
    const double by_mass = fill * speed * part / resistance;
    face.by_pressure[i] = (i == 0 ? 1 : -1) / resistance + by_conductance * halves[i].by_pressure +
                          by_mass * node.liquid.density_slope * node.film;
    face.by_film[i] = by_conductance * halves[i].by_film + by_mass * node.liquid.density;
  }
  return face;
}

}  // namespace tabor::lubrication
