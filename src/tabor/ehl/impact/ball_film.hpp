#pragma once

#include <Eigen/Core>

#include <optional>

#include "tabor/material/lubricant.hpp"
#include "tabor/numerics/lagged_factorisation.hpp"
#include "tabor/reynolds/line/reynolds.hpp"

// Advances ball and film of an impact by one time step.
namespace tabor::ehl {

inline constexpr double kBallTolerance = 1e-9;  ///< of residuals in units of the layer

/// An elastic ball over an elastic flat with a film between, both bodies of revolution: what does
/// not change during an impact.
struct BallFilm {
  reynolds::FilmGrid grid;     ///< a disc of n cells, nodes 1 .. n + 1 from the centre to the edge
  Eigen::ArrayXd shape;        ///< gap of the undeformed ball [m] at the n + 1 nodes: r^2/(2 R)
  Eigen::MatrixXd compliance;  ///< [m/Pa], (n + 1, n): pressure on a ring to deflection at a node
  material::Lubricant lubricant;
  double mass = 0;          ///< [kg]
  double gravity = 0;       ///< [m/s^2], towards the flat
  double length_scale = 0;  ///< [m]: residuals are lengths in this unit; the thickness of the layer
  double pressure_scale = 0;  ///< [Pa] of the unknowns
};

/// One instant of an impact. Pressure and film are those of the cells' nodes, from the centre.
struct BallState {
  double time = 0;           ///< [s]
  double separation = 0;     ///< h0 [m], of the undeformed bodies; negative when they overlap
  double speed = 0;          ///< dh0/dt [m/s], negative while approaching
  double force = 0;          ///< w [N], of the film on the ball
  Eigen::ArrayXd pressure;   ///< p [Pa], n
  Eigen::ArrayXd film;       ///< h [m], n + 1
  Eigen::ArrayXd film_mass;  ///< rho/rho0 h [m], n
};

/// h [m] at the n + 1 nodes: h0 + r^2/(2 R) + deflection.
Eigen::ArrayXd film_of(const BallFilm& ball, double separation, const Eigen::ArrayXd& pressure);

/// A state with force, film and mass computed from the rest.
BallState completed(const BallFilm& ball, BallState state);

/// What one time step cost.
struct StepCount {
  int newton_iterations = 0;
  int n_factorizations = 0;
  int n_products = 0;
};

/// Advances p >= 0 and h0 together by Newton's method: the squeeze term by second-order backward
/// differences (first order without a state before), the motion by the trapezoidal rule, cavitation
/// as a set of cells with p = 0 that take part in no balance as long as they would not stay full.
class BallStepper {
 public:
  explicit BallStepper(const BallFilm& ball, bool refactor_always = false);

  /// The state a time step [s] after `now`; `before` is the accepted state before it, or null.
  /// nullopt if Newton's method does not converge or the film would close: take a shorter step.
  std::optional<BallState> step(const BallState& now, const BallState* before, double time_step);

  /// How far the last step's pressure was from its extrapolation, over the largest pressure.
  double prediction_error() const { return prediction_error_; }
  /// Largest residual that the last step left, in units of the layer.
  double error() const { return error_; }
  StepCount count() const;

 private:
  struct Trial;
  struct Equations;
  const BallFilm& ball_;
  numerics::LaggedFactorisation solver_;
  int newton_iterations_ = 0;
  double prediction_error_ = 0;
  double error_ = 0;
};

}  // namespace tabor::ehl
