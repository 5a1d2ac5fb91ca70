#pragma once

#include <Eigen/Core>
#include <vector>

#include "tabor/ehl/point/balance.hpp"
#include "tabor/ehl/point/bordered.hpp"
#include "tabor/ehl/point/levels.hpp"
#include "tabor/ehl/point/point.hpp"

namespace tabor::ehl {

/// The unknowns of a point contact and what follows from them. Arrays have shape (ny, nx).
struct PointState {
  Field pressure;         ///< p [Pa], zero on the border
  double separation = 0;  ///< h00 [m]
  Field film;             ///< h [m]
  Mask cavity;            ///< nodes where p = 0 is given and the film may lack liquid
};

/// The equations of a point contact at the nodes of one grid and their solution by Newton's method:
///
///   shape + h00 + K p = h ,  balances of cells(p, h) = 0 ,  sum p dx dy = load ,  p >= 0
///
/// with K by zero-padded transforms (elastic::make_free) and Reynolds' condition where the film
/// breaks: p = 0, and no cell of the cavity gains liquid.
class PointFilm {
 public:
  /// Without `coarsens`, Newton's equations are solved with sparse factors of their local part
  /// instead of a V-cycle.
  explicit PointFilm(const PointProblem& problem, bool coarsens = true);

  const Grid& grid() const { return grid_; }
  const Eigen::ArrayXd& x() const { return x_; }
  const Eigen::ArrayXd& y() const { return y_; }
  const PointUnits& units() const { return units_; }
  double film_scale() const { return film_scale_; }  ///< [m] what errors of mass compare with
  bool coarsens() const { return coarsens_; }
  const std::vector<PointLevel>& levels() const { return levels_; }  ///< the finest is its own grid

  Field shape;  ///< gap of the undeformed bodies [m]: x^2/(2 Rx) + y^2/(2 Ry) - s
  material::Lubricant lubricant;
  double load = 0;       ///< [N]
  double speed = 0;      ///< u_m [m/s], > 0
  double tolerance = 0;  ///< on the errors of mass and load

  /// Hertz' pressure, spread wider where the bodies are so stiff that the film is wider than their
  /// contact, and h00 such that the film is `min_film` [m] where it is thinnest.
  PointState hertz_start(double min_film) const;
  /// A state of another grid of the same domain in half axes, between its nodes.
  PointState resampled(const PointState& state, const Grid& from) const;
  /// u [m] under a pressure [Pa] on all nodes.
  Field deflection(const Field& pressure) const;
  /// h [m] of a state: shape + h00 + K p.
  Field film_of(const PointState& state) const;
  Field mass_of(const PointState& state) const;  ///< rho/rho0 h [m]

  struct Outcome {
    Convergence convergence;      ///< certificate: the larger error
    int n_linear_iterations = 0;  ///< of GMRES
    double mass_error = 0;        ///< largest imbalance of a cell over the flow through the contact
    double load_error = 0;        ///< relative
  };
  /// Advances `state` to a solution; leaves it where Newton's method ended if there is none.
  Outcome solve(PointState& state, const PointStorage& storage, const Observer& observer = {});

 private:
  PointFlow flow_of(const PointState& state) const;
  PointLinear linearize(const PointState& state, const PointStorage& storage) const;
  Mask held(const PointState& state) const;
  void measure(const PointLinear& linear, Outcome& outcome) const;
  double merit(const PointLinear& linear, const PointState& state) const;
  bool refill(PointLinear& linear, PointState& state) const;
  bool step_to(const PointState& old, const Eigen::VectorXd& step, double share,
               PointState& state) const;
  bool correct(const Eigen::VectorXd& step, const PointStorage& storage, PointState& state,
               PointLinear& linear, Outcome& outcome) const;
  Eigen::VectorXd newton_step(const PointLinear& linear, const PointState& state,
                              const PointStorage& storage, Outcome& outcome) const;

  PointProblem problem_;
  bool coarsens_;
  Grid grid_;
  Eigen::ArrayXd x_, y_;
  std::vector<PointLevel> levels_;
  PointUnits units_;
  double pressed_width_x_, pressed_width_y_;  // [m], half axes of the pressed ellipse
  double film_scale_;                         // [m]
};

}  // namespace tabor::ehl
