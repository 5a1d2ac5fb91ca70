#pragma once

#include <Eigen/Core>
#include <vector>

#include "tabor/ehl/line/line.hpp"
#include "tabor/ehl/line/system.hpp"
#include "tabor/elastic/line.hpp"
#include "tabor/material/lubricant.hpp"

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

/// Balances and load of a state, in units of u_m times the unit of film, and their derivatives by
/// the unknowns. Balances of the cavity say what its nodes lack to stay full.
struct LineLinear {
  LineSystem system;
  Eigen::VectorXd residual;  ///< as the right side of the system

  double& load_residual() { return residual[residual.size() - 1]; }
};

/// Whether the inlet of this film [m] exists on the grid. Where it does not, a film a thousand
/// times too thin can balance as well, and Newton's method may come to it. Where solids touch, they
/// set its thickness.
bool sees_inlet(const LineProblem& problem, const Eigen::ArrayXd& x, const Eigen::ArrayXd& film);

/// The equations of a line contact at its nodes and their solution by Newton's method.
class LineFilm {
 public:
  /// `full_matrix`: factorized in each iteration, instead of products with it.
  explicit LineFilm(const LineProblem& problem, bool full_matrix = false);

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
  bool has_asperities() const { return problem_.asperities.boundary_film > 0; }
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
  Outcome solve(LineState& state, const LineStorage& storage, int max_iterations,
                const Observer& observer = {}) const;
  /// The same with asperities that touch. `state` need not hold anything.
  Outcome solve_touching(LineState& state, const Observer& observer = {}) const;

 private:
  LineState asperity_start() const;
  LineLinear linearize(const LineState& state, const LineStorage& storage) const;
  void add_touch(const LineState& state, LineLinear& linear) const;
  void update_film(LineState& state) const;
  Eigen::ArrayXd deflection(const Eigen::ArrayXd& pressure) const;
  double mass_error(const LineLinear& linear, const LineState& state) const;
  bool is_balanced(const LineState& state, const Outcome& outcome) const;
  Eigen::ArrayXd overlap_products(const LineState& state) const;
  Eigen::VectorXd newton_step(LineLinear linear, const LineState& state, int& n_products) const;
  bool correct(const Eigen::VectorXd& step, LineState& state) const;
  void move(const LineState& old, const Eigen::VectorXd& step, double share,
            LineState& state) const;
  double share_before_touch(const LineState& old, const Eigen::VectorXd& step) const;
  bool is_open(const LineState& state, double floor) const;
  bool refill(const LineLinear& linear, LineState& state, Index reach) const;

  LineProblem problem_;
  bool full_matrix_;
  Index n_;
  Eigen::ArrayXd x_;
  double spacing_;
  elastic::LineHalfSpace elastic_;
  LineUnits units_;
  double pressed_width_;  // [m], half of it
  double film_scale_;     // [m], of the film in the contact: residuals are compared with it
};

/// `now` with the work of what came before it.
LineFilm::Outcome operator+(const LineFilm::Outcome& before, LineFilm::Outcome now);

}  // namespace tabor::ehl
