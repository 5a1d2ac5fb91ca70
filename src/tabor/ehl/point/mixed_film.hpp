#pragma once

#include <Eigen/Core>

#include "tabor/ehl/point/film.hpp"

namespace tabor::ehl {

/// Which equation a node of a mixed film obeys, and so what is unknown there.
enum class MixedNode : unsigned char {
  liquid,            ///< the flow is balanced; the pressure is unknown
  cavity,            ///< pressure 0, the film may lack liquid
  touching,          ///< the film is the boundary film; the pressure of the solids is unknown
  plastic,           ///< pressure P_plast; the flow is balanced by the unknown plastic depth
  plastic_touching,  ///< pressure P_plast; the plastic depth leaves the boundary film
};
using MixedNodes = Eigen::Array<MixedNode, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

bool touches(MixedNode node);
bool is_plastic(MixedNode node);

/// The unknowns of a mixed film and what follows from them. Arrays have shape (ny, nx).
struct MixedState {
  Field pressure;         ///< [Pa], of the liquid or, where they touch, the solids
  Field plastic_depth;    ///< h_plast [m]
  double separation = 0;  ///< h00 [m]
  Field film;             ///< h [m]
  MixedNodes nodes;
};

/// The equations of a point contact whose solids may touch and flow plastically, and their solution
/// by a semismooth Newton method:
///
///   shape + h00 + h_plast + K p = h ,   sum p dx dy = load ,   0 <= p <= P_plast
///   p = 0        -> no cell gains liquid
///   p = P_plast  -> h_plast >= 0, else h_plast = 0
///   h >= h_b ;  where h > h_b the flow is balanced; where h = h_b no cell gains liquid
///
/// h_b: boundary film. Liquid that would leave a node with less is held there by the surfaces, and
/// the solids carry the load through it. Each node has one unknown (MixedNode), so this costs what
/// PointFilm does.
class MixedFilm {
 public:
  explicit MixedFilm(const PointProblem& problem);

  const PointFilm& bodies() const { return film_; }

  double share_of_roughness = 1;  ///< 0: smooth bodies
  double tolerance = 0;           ///< on the errors of mass and load
  /// u_m [m/s]; sliding goes in proportion.
  void set_speed(double speed);
  double speed() const { return film_.speed; }

  /// A film of the same grid without touching or plastic nodes; pressures over the cap are cut.
  MixedState state_from(const PointState& film) const;
  /// The state of a result, which may be of another grid.
  MixedState state_from(const PointResult& result) const;
  PointResult result_of(const MixedState& state, const PointFilm::Outcome& outcome) const;

  /// Advances `state` to a solution; leaves it where Newton's method ended if there is none.
  PointFilm::Outcome solve(MixedState& state, const Observer& observer = {}) const;

 private:
  struct Linear;
  bool in_domain(Index k) const;
  Field gap_of(const MixedState& state) const;
  void lift(MixedState& state) const;
  PointFlow flow_of(const MixedState& state, const Field& film) const;
  Linear linearize(const MixedState& state) const;
  void set_contact_row(const MixedState& state, Index k, Linear& linear) const;
  Eigen::VectorXd newton_step(const Linear& linear, const MixedState& state,
                              PointFilm::Outcome& outcome) const;
  double merit(const Linear& linear, const MixedState& state) const;
  void move_node(Index k, double change, MixedState& state) const;
  bool settle_node(Index k, double old_film, MixedState& state) const;
  bool step_to(const MixedState& old, const Eigen::VectorXd& step, double share,
               MixedState& state) const;
  bool correct(const Eigen::VectorXd& step, MixedState& state, Linear& linear,
               PointFilm::Outcome& outcome) const;
  bool change_nodes(const Linear& linear, MixedState& state) const;
  void measure(const Linear& linear, PointFilm::Outcome& outcome) const;

  PointProblem problem_;
  PointFilm film_;
  double sliding_speed_;  // [m/s]
  double film_scale_;     // [m] what errors of mass compare with
};

}  // namespace tabor::ehl
