#include "tabor/ehl/point/balance.hpp"

#include <cmath>

#include "tabor/core/loops.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/reynolds/line/reynolds.hpp"

namespace tabor::ehl {
namespace {

constexpr Index kNodesOfBlock = 4096;

/// Numbers of kPointNeighbours.
enum Neighbour : std::size_t { own, upstream, far_upstream, downstream, lower_side, upper_side };

/// A law at every node, with its derivatives at fixed film and at fixed pressure.
struct NodeViscosity {
  Field value, by_pressure, by_film;

  NodeViscosity(Index ny, Index nx) : value(ny, nx), by_pressure(ny, nx), by_film(ny, nx) {}
};

/// The liquid at the nodes: its density, and its viscosities for flow along and across sliding.
class NodeLiquid {
 public:
  explicit NodeLiquid(const PointFlow& flow)
      : flow_(flow),
        along_(flow.film.rows(), flow.film.cols()),
        across_(flow.film.rows(), flow.film.cols()) {
    material::evaluate(flow.lubricant,
                       {flow.pressure.data(), static_cast<std::size_t>(flow.pressure.size())},
                       laws_);
    for_each(
        flow.film.size(), [this](Index k) { set_viscosities(k); }, kNodesOfBlock);
  }

  double mass(Index k) const { return laws_.density[k] * flow_.film.data()[k]; }
  double density(Index k) const { return laws_.density[k]; }
  double mass_by_pressure(Index k) const {
    return laws_.density_by_pressure[k] * flow_.film.data()[k];
  }

  reynolds::FilmNode node(Index k, bool along, double distance) const {
    const NodeViscosity& viscosity = along ? along_ : across_;
    return {.pressure = flow_.pressure.data()[k],
            .film = flow_.film.data()[k],
            .liquid = {.density = laws_.density[k],
                       .density_slope = laws_.density_by_pressure[k],
                       .viscosity = viscosity.value.data()[k],
                       .viscosity_slope = viscosity.by_pressure.data()[k]},
            .distance = distance,
            .viscosity_by_film = viscosity.by_film.data()[k]};
  }

 private:
  void set_viscosities(Index k) {
    const double film = flow_.film.data()[k];
    const double rate = flow_.sliding_speed / film;
    const material::FlowViscosity viscosity = material::flow_viscosity(
        flow_.lubricant.shear, laws_.viscosity[k], rate, flow_.pressure.data()[k]);
    const auto store = [&](const material::FlowViscosity::Direction& from, NodeViscosity& to) {
      to.value.data()[k] = from.value;
      to.by_pressure.data()[k] =
          from.by_viscosity * laws_.viscosity_by_pressure[k] + from.by_pressure;
      to.by_film.data()[k] = -from.by_rate * rate / film;
    };
    store(viscosity.along, along_);
    store(viscosity.across, across_);
  }

  const PointFlow& flow_;
  material::NodeLaws laws_;
  NodeViscosity along_, across_;
};

/// rho h at a face from the two nodes upstream, and its derivatives by them.
struct CarriedMass {
  double value, by_near, by_far;

  /// 3/2 near - 1/2 far where the film is smooth. Where it drops to less than 2/3 from one node to
  /// the next, the curve 9/8 near^2 / far goes on, with the same slope, and stays positive.
  CarriedMass(double near, double far) {
    constexpr double kSteep = 1.5;
    if (far <= kSteep * near) {
      value = 1.5 * near - 0.5 * far;
      by_near = 1.5;
      by_far = -0.5;
      return;
    }
    const double ratio = near / far;
    value = 1.125 * near * ratio;
    by_near = 2.25 * ratio;
    by_far = -1.125 * ratio * ratio;
  }
};

class Assembly {
 public:
  Assembly(const PointFlow& flow, const PointUnits& units, PointBalance& balance)
      : units_(units),
        nx_(flow.film.cols()),
        dx_(flow.grid.dx()),
        dy_(flow.grid.dy()),
        unit_(1 / (flow.speed * units.film)),
        liquid_(flow),
        balance_(balance) {}

  void add_flow_along(Index j) {
    for (Index i = 0; i + 1 < nx_; ++i) {
      const Index k = j * nx_ + i;
      add_driven(k, k + 1,
                 reynolds::face_flow(liquid_.node(k, true, dx_ / 2),
                                     liquid_.node(k + 1, true, dx_ / 2), 0),
                 unit_, downstream, upstream);
      add_carried(i, k);
    }
  }

  /// Through the faces between rows j and j + 1.
  void add_flow_across(Index j) {
    for (Index i = 1; i + 1 < nx_; ++i) {
      const Index k = j * nx_ + i;
      add_driven(k, k + nx_,
                 reynolds::face_flow(liquid_.node(k, false, dy_ / 2),
                                     liquid_.node(k + nx_, false, dy_ / 2), 0),
                 unit_ * dx_ / dy_, upper_side, lower_side);
    }
  }

  void add_storage(Index k, const PointStorage& storage) {
    const double rate = unit_ * dx_ / storage.time_step;
    balance_.residual.data()[k] += rate * (liquid_.mass(k) - storage.old_mass.data()[k]);
    by_pressure(own, k) += rate * liquid_.mass_by_pressure(k) * units_.pressure;
    by_film(own, k) += rate * liquid_.density(k) * units_.film;
  }

 private:
  double& by_pressure(std::size_t neighbour, Index k) {
    return balance_.by_pressure.coefficient[neighbour].data()[k];
  }
  double& by_film(std::size_t neighbour, Index k) {
    return balance_.by_film.coefficient[neighbour].data()[k];
  }

  /// Flow driven by pressure from node `first` to node `second`.
  void add_driven(Index first, Index second, const reynolds::FaceFlow& face, double unit,
                  Neighbour after, Neighbour before) {
    const Index nodes[2] = {first, second};
    const std::size_t other[2] = {after, before};
    for (std::size_t side = 0; side < 2; ++side) {
      const Index k = nodes[side];
      const double sign = side == 0 ? unit : -unit;  // the first loses what the second gains
      balance_.residual.data()[k] += sign * face.flow;
      by_pressure(own, k) += sign * face.by_pressure[side] * units_.pressure;
      by_film(own, k) += sign * face.by_film[side] * units_.film;
      by_pressure(other[side], k) += sign * face.by_pressure[1 - side] * units_.pressure;
      by_film(other[side], k) += sign * face.by_film[1 - side] * units_.film;
    }
  }

  /// Flow carried by the walls from node k to node k + 1.
  void add_carried(Index i, Index k) {
    if (i == 0) {  // the mean of both nodes
      add_carried_part(k, 0, 0.5, 0.5 * liquid_.mass(k));
      add_carried_part(k, 1, 0.5, 0.5 * liquid_.mass(k + 1));
      return;
    }
    const CarriedMass mass(liquid_.mass(k), liquid_.mass(k - 1));
    add_carried_part(k, 0, mass.by_near, mass.value);
    add_carried_part(k, -1, mass.by_far, 0);
  }

  /// A part `value` of what goes from node k to k + 1, whose derivative by the mass at the node
  /// `place` from k is `slope`.
  void add_carried_part(Index k, Index place, double slope, double value) {
    constexpr std::array<std::size_t, 4> kAlong{far_upstream, upstream, own, downstream};
    const Index source = k + place;
    const double pressure_slope = slope * liquid_.mass_by_pressure(source) * units_.pressure;
    const double film_slope = slope * liquid_.density(source) * units_.film;
    for (Index side = 0; side < 2; ++side) {
      const double sign = (side == 0 ? 1 : -1) / units_.film;
      const std::size_t neighbour = kAlong[static_cast<std::size_t>(2 + place - side)];
      balance_.residual.data()[k + side] += sign * value;
      by_pressure(neighbour, k + side) += sign * pressure_slope;
      by_film(neighbour, k + side) += sign * film_slope;
    }
  }

  const PointUnits& units_;
  Index nx_;
  double dx_, dy_, unit_;
  NodeLiquid liquid_;
  PointBalance& balance_;
};

void clear_border(Field& map) {
  map.row(0).setZero();
  map.row(map.rows() - 1).setZero();
  map.col(0).setZero();
  map.col(map.cols() - 1).setZero();
}

}  // namespace

void PointStencil::add_product(const Field& x, Field& y) const {
  const Index ny = x.rows();
  const Index nx = x.cols();
  for_each_row(ny - 2, [&](Index row) {
    const Index j = row + 1;
    for (std::size_t n = 0; n < kPointNeighbours.size(); ++n) {
      const PointOffset at = kPointNeighbours[n];
      const Index first = at.x < -1 ? 2 : 1;
      const Index count = nx - 1 - first;
      y.row(j).segment(first, count) += coefficient[n].row(j).segment(first, count) *
                                        x.row(j + at.y).segment(first + at.x, count);
    }
  });
}

PointBalance point_balance(const PointFlow& flow, const PointStorage& storage,
                           const PointUnits& units) {
  const Index ny = flow.film.rows();
  const Index nx = flow.film.cols();
  PointBalance balance{.residual = Field::Zero(ny, nx),
                       .by_pressure = PointStencil(ny, nx),
                       .by_film = PointStencil(ny, nx)};
  Assembly assembly(flow, units, balance);
  for_each_row(ny - 2, [&](Index row) { assembly.add_flow_along(row + 1); });
  // Faces between two rows concern both: those after even rows first, then those after odd ones.
  for (const Index parity : {0, 1}) {
    for_each_row((ny - parity) / 2,
                 [&](Index pair) { assembly.add_flow_across(2 * pair + parity); });
  }
  if (storage.time_step > 0) {
    for (Index k = 0; k < flow.film.size(); ++k) assembly.add_storage(k, storage);
  }
  clear_border(balance.residual);
  for (PointStencil* stencil : {&balance.by_pressure, &balance.by_film}) {
    for (Field& coefficient : stencil->coefficient) clear_border(coefficient);
  }
  return balance;
}

}  // namespace tabor::ehl
