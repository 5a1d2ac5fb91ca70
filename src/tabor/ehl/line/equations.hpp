#pragma once

#include <Eigen/Core>
#include <vector>

#include "tabor/ehl/line/film.hpp"
#include "tabor/ehl/line/system.hpp"

// Gives residuals and derivatives of a line contact to Newton's method.
namespace tabor::ehl {

/// Balances and load of a state, in units of u_m times the unit of film, and their derivatives by
/// the unknowns. Balances of the cavity say what its nodes lack to stay full.
struct LineLinear {
  LineSystem system;
  Eigen::VectorXd residual;  ///< as the right side of the system

  double& load_residual() { return residual[residual.size() - 1]; }
};

/// The equations of a line contact as numerics::newton() asks for them. The active set: the cavity,
/// whose nodes have p = 0. What touching solids add stands in asperities.cpp.
class LineFilm::Equations {
 public:
  /// `state`, which the solution moves: with the film of its pressures, both ends in the cavity.
  Equations(const LineFilm& film, const LineConditions& conditions, const LineStorage& storage,
            LineState& state);

  LineState& state() { return state_; }
  Convergence& convergence() { return outcome_.convergence; }
  const Outcome& outcome() const { return outcome_; }

  Eigen::VectorXd step();
  double largest_share(const Eigen::VectorXd& step) const;
  bool move(const LineState& old, const Eigen::VectorXd& step, double share);
  bool settle();
  bool measure();

 private:
  LineLinear linearize() const;
  bool refill();
  double mass_error() const;

  bool touches() const { return state_.asperity_pressure.size() > 0; }
  void add_touch(LineLinear& linear) const;
  double share_before_touch(const Eigen::VectorXd& step) const;
  bool is_open(const LineState& old) const;
  bool is_balanced() const;
  Eigen::ArrayXd overlap_products() const;

  const LineFilm& film_;
  const LineConditions& conditions_;
  const LineStorage& storage_;
  LineState& state_;
  LineLinear linear_;
  std::vector<bool> cavity_before_;  // the last step
  Index reach_ = 1;                  // nodes by which a front of the cavity retreats at once
  Outcome outcome_;
};

}  // namespace tabor::ehl
