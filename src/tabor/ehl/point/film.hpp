#pragma once

#include <Eigen/Core>
#include <vector>

#include "tabor/ehl/point/balance.hpp"
#include "tabor/ehl/point/levels.hpp"
#include "tabor/ehl/point/point.hpp"

// Solves the film of a point contact for given conditions and a given start.
namespace tabor::ehl {

/// Which equation a node obeys, and so what is unknown there.
enum class PointNode : unsigned char {
  liquid,            ///< the flow is balanced; the pressure is unknown
  cavity,            ///< pressure 0, the film may lack liquid
  touching,          ///< the film is the boundary film; the pressure of the solids is unknown
  plastic,           ///< pressure P_plast; the flow is balanced by the unknown plastic depth
  plastic_touching,  ///< pressure P_plast; the plastic depth leaves the boundary film
};
using PointNodes = Eigen::Array<PointNode, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

bool touches(PointNode node);
bool is_plastic(PointNode node);
/// Liquid but where there is a cavity.
PointNodes nodes_of(const Mask& cavity);

/// The unknowns of a point contact and what follows from them. Arrays have shape (ny, nx).
struct PointState {
  Field pressure;         ///< [Pa], of the liquid or, where they touch, the solids; 0 on the border
  Field plastic_depth;    ///< h_plast [m]
  double separation = 0;  ///< h00 [m]
  Field film;             ///< h [m]
  PointNodes nodes;
};

/// What a film is found under: all that changes on the way to a solution, and in time.
struct PointConditions {
  Field shape;  ///< gap of the undeformed bodies [m]: x^2/(2 Rx) + y^2/(2 Ry) - s, shape (ny, nx)
  material::Lubricant lubricant;
  double speed = 0;          ///< u_m [m/s], > 0
  double sliding_speed = 0;  ///< u_s [m/s]
  double tolerance = 0;      ///< on the errors of mass and load
};

/// How a film is looked for.
struct PointFilmOptions {
  /// True where solids may touch and flow; else the boundary film and the cap on the pressure count
  /// for nothing.
  bool solids_touch = false;
  /// If not, Newton's equations are solved with sparse factors of their local part instead of a
  /// V-cycle.
  bool coarsens = true;
};

/// The equations of a point contact at the nodes of one grid, and their solution by a semismooth
/// Newton method (numerics/newton.hpp):
///
///   shape + h00 + h_plast + K p = h ,   sum p dx dy = load ,   0 <= p <= P_plast
///   p = 0        -> no cell gains liquid (Reynolds' condition where the film breaks)
///   p = P_plast  -> h_plast >= 0, else h_plast = 0
///   h >= h_b ;  where h > h_b the flow is balanced; where h = h_b no cell gains liquid
///
/// with K by zero-padded transforms (elastic::make_free). h_b: boundary film. Liquid that would
/// leave a node with less is held there by the surfaces, and the solids carry the load through it.
/// Each node has one unknown (PointNode), so films that touch cost what others do. Where solids do
/// not touch, h_b = 0 and P_plast is infinite.
class PointFilm {
 public:
  explicit PointFilm(const PointProblem& problem, PointFilmOptions options = {});

  const Grid& grid() const { return grid_; }
  const Eigen::ArrayXd& x() const { return x_; }
  const Eigen::ArrayXd& y() const { return y_; }
  const PointFilmOptions& options() const { return options_; }
  const PointConditions& conditions() const { return conditions_; }       ///< of the problem
  double film_scale() const { return film_scale_at(conditions_.speed); }  ///< [m]

  /// Hertz' pressure, spread wider where the bodies are so stiff that the film is wider than their
  /// contact, and h00 such that the film is `min_film` [m] where it is thinnest.
  PointState hertz_start(double min_film) const;
  /// A state of another grid of the same domain in half axes, between its nodes; nothing touches.
  PointState resampled(const PointState& state, const Grid& from) const;
  Field mass_of(const PointState& state) const;  ///< rho/rho0 h [m]
  /// The mass from which solve() begins: of bodies that are raised until they do not overlap.
  Field first_mass(PointState state, const PointConditions& conditions) const;
  /// True where node k = j nx + i lies off the border, where the pressure is given.
  bool in_domain(Index k) const;

  struct Outcome {
    Convergence convergence;      ///< certificate: the larger error
    int n_linear_iterations = 0;  ///< of GMRES
    double mass_error = 0;        ///< largest imbalance of a cell over the flow through the contact
    double load_error = 0;        ///< relative
  };
  /// Advances `state` to a solution; leaves it where Newton's method ended if there is none.
  Outcome solve(PointState& state, const PointConditions& conditions,
                const PointStorage& storage = {}, const Observer& observer = {}) const;

 private:
  class Equations;  // point/equations.hpp
  double film_scale_at(double speed) const;
  Field deflection(const Field& pressure) const;
  Field film_of(const PointState& state, const Field& shape) const;
  bool open(PointState& state) const;

  PointProblem problem_;
  PointFilmOptions options_;
  Grid grid_;
  Eigen::ArrayXd x_, y_;
  PointConditions conditions_;
  std::vector<PointLevel> levels_;
  PointUnits units_;
  double boundary_film_;                      // h_b [m]
  double plastic_pressure_;                   // P_plast [Pa]
  double pressed_width_x_, pressed_width_y_;  // [m], half axes of the pressed ellipse
};

}  // namespace tabor::ehl
