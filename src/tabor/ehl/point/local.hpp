#pragma once

#include <array>
#include <cassert>
#include <vector>

#include "tabor/ehl/point/balance.hpp"
#include "tabor/ehl/point/elastic.hpp"

namespace tabor::ehl {

/// The equations of one Newton step of a point contact, dF/dp + dF/dh K, cut off a few nodes away.
///
/// New unknowns q make that possible. Where elasticity rules, q is the strength of a pressure
/// 1 at a node and -1/4 at each of its neighbours, whose deflection is felt nearby only: the
/// distributive relaxation of Venner & Lubrecht (Multilevel Methods in Lubrication, 2000, section
/// 7.3). Where the flow driven by pressure rules, q is the pressure itself. An approximation, for
/// preconditioning.
class PointLocal {
 public:
  /// Balances reach this far: upstream and downstream, and to either side.
  static constexpr Index kUpstream = 3, kDownstream = 2, kSide = 2;
  /// Unknowns of one line that a balance depends on.
  struct Reach {
    Index dy;           ///< of the line
    Index first, last;  ///< dx of its unknowns
    Index place;        ///< of the first among the coefficients
    constexpr Index size() const { return last - first + 1; }
  };
  static constexpr std::array<Reach, 2 * kSide + 1> kReaches{{{-2, 0, 0, 0},
                                                              {-1, -2, 1, 1},
                                                              {0, -kUpstream, kDownstream, 5},
                                                              {1, -2, 1, 11},
                                                              {2, 0, 0, 15}}};
  static constexpr Index kCoefficients = 16;

  /// Held nodes keep their pressure. `depth`: nodes whose unknown is what is added to their film,
  /// their pressure being given; empty: none.
  PointLocal(const PointBalance& balance, Mask held, const PointElastic& elastic,
             const Mask& depth = {});

  const Mask& held() const { return held_; }
  Index nx() const { return held_.cols(); }
  Index ny() const { return held_.rows(); }
  /// The kCoefficients of the balance of node (j, i), in the order of kReaches. Zero for held nodes
  /// and beyond the border.
  const double* coefficients(Index j, Index i) const {
    return &matrix_[static_cast<std::size_t>((j * nx() + i) * kCoefficients)];
  }
  /// Pressures, or depths, that the unknowns q stand for.
  Field pressure(const Field& q) const;

 private:
  double& at(Index j, Index i, Index dy, Index dx) {
    const Reach& reach = kReaches[static_cast<std::size_t>(dy + kSide)];
    assert(dx >= reach.first && dx <= reach.last);
    return matrix_[static_cast<std::size_t>((j * nx() + i) * kCoefficients + reach.place + dx -
                                            reach.first)];
  }
  bool presses(Index j, Index i) const { return !held_(j, i) && !depth_(j, i); }
  void choose_dipoles(const PointBalance& balance, double self_influence);
  void add_deflection(const PointBalance& balance, const PointElastic& elastic);
  void add_pressure(const PointBalance& balance);
  void add_depth(const PointBalance& balance);

  Mask held_, depth_, dipole_;
  std::vector<double> matrix_;
};

}  // namespace tabor::ehl
