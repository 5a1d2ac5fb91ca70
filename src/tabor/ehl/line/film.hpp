#pragma once

#include <Eigen/Core>
#include <vector>

#include "tabor/ehl/line/line.hpp"
#include "tabor/ehl/line/system.hpp"
#include "tabor/elastic/line.hpp"
#include "tabor/material/lubricant.hpp"

// Solves the film of a line contact for given conditions and a given start.
namespace tabor::ehl {

inline constexpr double kLineTolerance = 1e-8;  ///< of residuals, over the flow in the contact

/// The unknowns of a line contact and what follows from them.
struct LineState {
  Eigen::ArrayXd pressure;   ///< p [Pa], n, zero at both ends
  double separation = 0;     ///< h0 [m]
  Eigen::ArrayXd film;       ///< h [m] of the liquid, n
  std::vector<bool> cavity;  ///< nodes where p = 0 is given and the film may lack liquid
  /// P [Pa], n, above zero as the film is above h_b; empty without asperities.
  Eigen::ArrayXd asperity_pressure = {};
  double touch_product = 0;  ///< P (h - h_b) aimed at, over the units of pressure and film
};

/// An implicit Euler step of the film; none for a steady one.
struct LineStorage {
  double time_step = 0;          ///< [s], 0: steady
  Eigen::ArrayXd old_mass = {};  ///< rho/rho0 h [m] a step ago, n
};

/// y at a place x, by straight lines between equal nodes; the outer ones go on.
double value_between_nodes(const Eigen::ArrayXd& x, const Eigen::ArrayXd& y, double at);

/// True where the inlet of this film [m] exists on the grid. Where it does not, a film a thousand
/// times too thin can balance as well, and Newton's method may come to it. Where solids touch, they
/// set its thickness.
bool sees_inlet(const LineProblem& problem, const Eigen::ArrayXd& x, const Eigen::ArrayXd& film);

/// What a film is found under: all that changes on the way to a solution, and in time.
struct LineConditions {
  Eigen::ArrayXd shape;  ///< gap of the undeformed bodies [m]: x^2/(2 R) - s, and wear
  material::Lubricant lubricant;
  double speed = 0;  ///< u_m [m/s], of either sign
};

/// A line contact at its nodes and its solution by Newton's method (numerics/newton.hpp).
class LineFilm {
 public:
  /// `full_matrix`: factorized in each iteration, instead of products with it.
  explicit LineFilm(const LineProblem& problem, bool full_matrix = false);

  Index n() const { return n_; }
  const Eigen::ArrayXd& x() const { return x_; }
  const LineConditions& conditions() const { return conditions_; }  ///< of the problem
  bool has_asperities() const { return problem_.asperities.boundary_film > 0; }

  /// Hertz' pressure, spread wider where the bodies are so stiff that the film is wider than their
  /// contact, and h0 such that the film is `min_film` [m] where it is thinnest.
  LineState hertz_start(double min_film, const LineConditions& conditions) const;
  Eigen::ArrayXd mass_of(const LineState& state) const;  ///< rho/rho0 h [m]
  /// P [Pa] without the traces that the method leaves where nothing touches.
  Eigen::ArrayXd touching_pressure(const LineState& state) const;

  struct Outcome {
    Convergence convergence;  ///< certificate: mass_error
    double mass_error = 0;
    double load_error = 0;
    double contact_error = 0;
  };
  /// Advances `state` to a solution; leaves it where Newton's method ended if there is none.
  Outcome solve(LineState& state, const LineConditions& conditions, const LineStorage& storage,
                int max_iterations, const Observer& observer = {}) const;
  /// The same with asperities that touch. `state` need not hold anything.
  Outcome solve_touching(LineState& state, const LineConditions& conditions,
                         const Observer& observer = {}) const;

 private:
  class Equations;  // line/equations.hpp
  LineState asperity_start(const LineConditions& conditions) const;
  Eigen::ArrayXd deflection(const Eigen::ArrayXd& pressure) const;
  Eigen::ArrayXd film_of(const LineState& state, const Eigen::ArrayXd& shape) const;

  LineProblem problem_;
  bool full_matrix_;
  Index n_;
  Eigen::ArrayXd x_;
  double spacing_;
  elastic::LineHalfSpace elastic_;
  LineConditions conditions_;
  LineUnits units_;
  double pressed_width_;  // [m], half of it
  double film_scale_;     // [m], of the film in the contact: residuals are compared with it
};

/// `now` with the work of what came before it.
LineFilm::Outcome operator+(const LineFilm::Outcome& before, LineFilm::Outcome now);

}  // namespace tabor::ehl
