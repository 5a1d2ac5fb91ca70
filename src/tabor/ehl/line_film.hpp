#pragma once

#include <Eigen/Core>
#include <vector>

#include "tabor/ehl/line.hpp"
#include "tabor/ehl/line_inverse.hpp"
#include "tabor/elastic/line.hpp"
#include "tabor/material/lubricant.hpp"

namespace tabor::ehl {

/// The unknowns of a line contact and what follows from them.
struct LineState {
  Eigen::ArrayXd pressure;   ///< p [Pa], n, zero at both ends
  double separation = 0;     ///< h0 [m]
  Eigen::ArrayXd film;       ///< h [m], n
  std::vector<bool> cavity;  ///< nodes where p = 0 is given and the film may lack liquid
};

/// An implicit Euler step of the film; none for a steady one.
struct LineStorage {
  double time_step = 0;          ///< [s], 0: steady
  Eigen::ArrayXd old_mass = {};  ///< rho/rho0 h [m] a step ago, n
};

/// y at a place x, by straight lines between equal nodes; the outer ones go on.
double value_between_nodes(const Eigen::ArrayXd& x, const Eigen::ArrayXd& y, double at);

/// The equations of a line contact at its nodes and their solution by Newton's method.
class LineFilm {
 public:
  explicit LineFilm(const LineProblem& problem);

  Index n() const { return n_; }
  const Eigen::ArrayXd& x() const { return x_; }
  const LineUnits& units() const { return units_; }
  /// Gap of the undeformed bodies [m]: x^2/(2 R) - s, and wear.
  Eigen::ArrayXd shape;
  material::Lubricant lubricant;
  double load = 0;   ///< [N/m]
  double speed = 0;  ///< u_m [m/s], of either sign

  /// Hertz' pressure, spread wider where the bodies are so stiff that the film is wider than their
  /// contact, and h0 such that the film is `min_film` [m] where it is thinnest.
  LineState hertz_start(double min_film) const;
  /// h [m] of a state: shape + h0 + K p.
  Eigen::ArrayXd film_of(const LineState& state) const;
  Eigen::ArrayXd mass_of(const LineState& state) const;  ///< rho/rho0 h [m]

  struct Outcome {
    int iterations = 0;
    int n_products = 0;
    double mass_error = 0;
    double load_error = 0;
    bool converged = false;
  };
  /// Advances `state` to a solution; leaves it where Newton's method stopped if there is none.
  Outcome solve(LineState& state, const LineStorage& storage, int max_iterations,
                const Observer& observer = {}) const;

 private:
  struct Linear;
  Linear linearize(const LineState& state, const LineStorage& storage) const;
  Eigen::ArrayXd deflection(const Eigen::ArrayXd& pressure) const;
  double mass_error(const Linear& linear, const LineState& state) const;
  Eigen::MatrixXd dense_jacobian(const LineBands& by_pressure, const LineBands& by_film) const;
  Eigen::VectorXd product(const LineBands& by_pressure, const LineBands& by_film,
                          const Eigen::VectorXd& step) const;
  Eigen::VectorXd newton_step(const Linear& linear, const LineState& state, int& n_products) const;
  bool correct(const Eigen::VectorXd& step, LineState& state) const;
  bool refill(const Linear& linear, LineState& state, Index reach) const;

  LineProblem problem_;
  Index n_;
  Eigen::ArrayXd x_;
  double spacing_;
  elastic::LineHalfSpace elastic_;
  LineUnits units_;
  double pressed_width_;  // [m], half of it
  double film_scale_;     // [m], of the film in the contact: residuals are compared with it
};

}  // namespace tabor::ehl
