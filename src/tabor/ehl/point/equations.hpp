#pragma once

#include <Eigen/Core>
#include <optional>

#include "tabor/ehl/point/bordered.hpp"
#include "tabor/ehl/point/film.hpp"
#include "tabor/ehl/point/multigrid.hpp"

namespace tabor::ehl {

/// The equations of a point contact as numerics::newton() asks for them: what is linear in
/// equations.cpp, the active set, which equation each node obeys, in active_set.cpp.
class PointFilm::Equations {
 public:
  /// `state`, which the solution moves: with the film of its pressures.
  Equations(const PointFilm& film, const PointConditions& conditions, const PointStorage& storage,
            PointState& state);

  PointState& state() { return state_; }
  Convergence& convergence() { return outcome_.convergence; }
  const Outcome& outcome() const { return outcome_; }

  Eigen::VectorXd step();
  double largest_share(const Eigen::VectorXd&) const { return 1; }
  bool move(const PointState& old, const Eigen::VectorXd& step, double share);
  bool settle();
  bool measure();

 private:
  static constexpr double kTooThin = 0.3;  // of the boundary film: touches whatever the flow says

  /// Rows of flow or, where solids touch, of contact.
  struct Linear : PointLinear {
    Field gain;  // of liquid at every node: minus the imbalance of the flow
  };
  Mask touching() const { return state_.nodes.unaryExpr(&touches); }
  Field flowing_film() const;
  PointFlow flow_through(const Field& film) const;
  Linear linearize() const;
  Mask held() const;
  void set_contact_row(Index k, Linear& linear) const;
  double merit() const;
  std::optional<Eigen::VectorXd> step_by_multigrid(const PointExceptions& exceptions);
  std::optional<Eigen::VectorXd> step_by_factors();

  void move_node(Index k, double change);
  bool settle_node(Index k, double old_film);
  bool settle_gap(const PointState& old);
  bool change_nodes();

  const PointFilm& film_;
  const PointConditions& conditions_;
  const PointStorage& storage_;
  PointState& state_;
  double film_scale_;  // [m] what errors of mass compare with
  Linear linear_;
  PointNodes nodes_before_;  // the last step
  double merit_before_ = 0;
  Outcome outcome_;
};

}  // namespace tabor::ehl
