#include "tabor/ehl/point/local.hpp"

#include <cmath>
#include <utility>

#include "tabor/core/rows.hpp"

namespace tabor::ehl {
namespace {

constexpr Index kReach = 1;  // of the deflection by one unknown, in nodes
/// Dipoles where the balance depends on its own pressure through flow less than this many times
/// what it does through deflection. Both extremes would serve badly: dipoles make a flow driven by
/// pressure an equation of fourth order, single pressures are felt far away. Where the oil thins
/// under shear both matter over much of the contact: a quarter of this leaves fine grids unsolved.
constexpr double kFlowOverElasticity = 32;

constexpr std::array<PointOffset, 4> kCross{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};

/// Deflections around one unknown, as far as the balances of nodes within kReach see them.
struct InfluenceTable {
  static constexpr Index kHalf = kReach + 4;
  Field value{2 * kHalf + 1, 2 * kHalf + 1};

  template <typename Influence>
  explicit InfluenceTable(const Influence& influence) {
    for (Index dy = -kHalf; dy <= kHalf; ++dy) {
      for (Index dx = -kHalf; dx <= kHalf; ++dx) value(dy + kHalf, dx + kHalf) = influence(dy, dx);
    }
  }
  double operator()(Index dy, Index dx) const { return value(dy + kHalf, dx + kHalf); }
};

/// Calls body(j, i) for every inner node that is not held, on all threads.
template <typename Body>
void for_each_free_node(const Mask& held, const Body& body) {
  for_each_row(held.rows() - 2, [&](Index row) {
    for (Index i = 1; i + 1 < held.cols(); ++i) {
      if (!held(row + 1, i)) body(row + 1, i);
    }
  });
}

}  // namespace

PointLocal::PointLocal(const PointBalance& balance, Mask held, const PointElastic& elastic,
                       const Mask& depth)
    : held_(std::move(held)),
      depth_(depth.size() > 0 ? depth : Mask::Constant(ny(), nx(), false)),
      dipole_(Mask::Constant(ny(), nx(), false)),
      matrix_(static_cast<std::size_t>(held_.size() * kCoefficients), 0.0) {
  choose_dipoles(balance, elastic.influence(0, 0));
  add_deflection(balance, elastic);
  add_pressure(balance);
  if (depth.size() > 0) add_depth(balance);
}

void PointLocal::choose_dipoles(const PointBalance& balance, double self_influence) {
  const Field& by_pressure = balance.by_pressure.coefficient[0];
  const Field& by_film = balance.by_film.coefficient[0];
  dipole_ =
      !held_ && !depth_ && by_pressure.abs() < kFlowOverElasticity * self_influence * by_film.abs();
}

void PointLocal::add_deflection(const PointBalance& balance, const PointElastic& elastic) {
  const InfluenceTable single([&](Index dy, Index dx) { return elastic.influence(dy, dx); });
  const InfluenceTable dipole([&](Index dy, Index dx) { return elastic.dipole_influence(dy, dx); });
  for_each_free_node(held_, [&](Index j, Index i) {
    for (Index dy = -kReach; dy <= kReach; ++dy) {
      // One more upstream, where the liquid comes from.
      for (Index dx = std::max(-kReach - 1, -i); dx <= kReach; ++dx) {
        if (!presses(j + dy, i + dx)) continue;
        const InfluenceTable& influence = dipole_(j + dy, i + dx) ? dipole : single;
        double sum = 0;
        for (std::size_t n = 0; n < kPointNeighbours.size(); ++n) {
          const PointOffset node = kPointNeighbours[n];
          sum += balance.by_film.coefficient[n](j, i) * influence(node.y - dy, node.x - dx);
        }
        at(j, i, dy, dx) += sum;
      }
    }
  });
}

void PointLocal::add_pressure(const PointBalance& balance) {
  for_each_free_node(held_, [&](Index j, Index i) {
    for (std::size_t n = 0; n < kPointNeighbours.size(); ++n) {
      const PointOffset node = kPointNeighbours[n];
      const double slope = balance.by_pressure.coefficient[n](j, i);
      if (slope == 0 || !presses(j + node.y, i + node.x)) continue;
      at(j, i, node.y, node.x) += slope;
      for (const PointOffset beside : kCross) {
        const Index dy = node.y + beside.y;
        const Index dx = node.x + beside.x;
        if (dipole_(j + dy, i + dx)) at(j, i, dy, dx) -= slope / 4;
      }
    }
  });
}

void PointLocal::add_depth(const PointBalance& balance) {
  for_each_free_node(held_, [&](Index j, Index i) {
    for (std::size_t n = 0; n < kPointNeighbours.size(); ++n) {
      const PointOffset node = kPointNeighbours[n];
      const double slope = balance.by_film.coefficient[n](j, i);
      if (slope != 0 && depth_(j + node.y, i + node.x)) at(j, i, node.y, node.x) += slope;
    }
  });
}

Field PointLocal::pressure(const Field& q) const {
  Field result = q;
  for_each_free_node(held_, [&](Index j, Index i) {
    if (depth_(j, i)) return;
    double of_dipoles = 0;
    for (const PointOffset beside : kCross) {
      if (dipole_(j + beside.y, i + beside.x)) of_dipoles += q(j + beside.y, i + beside.x);
    }
    result(j, i) -= of_dipoles / 4;
  });
  return result;
}

}  // namespace tabor::ehl
