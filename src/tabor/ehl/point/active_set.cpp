#include <algorithm>

#include "tabor/ehl/point/equations.hpp"

// How the nodes of a film change from one equation to another: at once where a step leads an
// unknown past a bound, after it where the flow asks for it.
namespace tabor::ehl {
namespace {

constexpr double kThinnest = 0.1;  // a step may leave this much of a film
constexpr double kThin = 10;       // films thinner than this many boundary films may touch at once
constexpr double kMayGrow = 1.5;   // the norm of the residual, in a step that is taken

}  // namespace

/// False where the gap would close or a law would end, and where the residual would grow much.
bool PointFilm::Equations::move(const PointState& old, const Eigen::VectorXd& step, double share) {
  ++outcome_.convergence.operator_applications;
  const Index n = film_.grid_.size();
  state_ = old;
  state_.separation += share * film_.units_.film * step[n];
  for (Index k = 0; k < n; ++k) {
    if (film_.in_domain(k)) move_node(k, share * step[k]);
  }
  const auto range = material::computable_range(conditions_.lubricant);
  if (!range.contains(state_.pressure.maxCoeff())) return false;
  state_.film = film_.film_of(state_, conditions_.shape);
  if (!settle_gap(old)) return false;
  linear_ = linearize();
  return merit() <= kMayGrow * merit_before_;
}

/// Adds a change to the unknown of a node; what passes a bound of it changes its equation at once.
void PointFilm::Equations::move_node(Index k, double change) {
  PointNode& node = state_.nodes.data()[k];
  double& pressure = state_.pressure.data()[k];
  double& depth = state_.plastic_depth.data()[k];
  if (node == PointNode::plastic) {
    depth += film_.units_.film * change;
    if (depth >= 0) return;
    depth = 0;
    node = PointNode::liquid;
  } else if (node == PointNode::plastic_touching) {
    depth = 0;  // follows from the gap
  } else if (node != PointNode::cavity) {
    pressure += film_.units_.pressure * change;
    if (pressure < 0) {
      node = PointNode::cavity;
    } else if (pressure > film_.plastic_pressure_) {
      node = touches(node) ? PointNode::plastic_touching : PointNode::plastic;
    }
    pressure = std::clamp(pressure, 0.0, film_.plastic_pressure_);
  }
}

/// Gives nodes the depth or the contact that their gap asks for. False where a film was lost too
/// fast to believe.
bool PointFilm::Equations::settle_gap(const PointState& old) {
  for (Index k = 0; k < state_.film.size(); ++k) {
    if (!settle_node(k, old.film.data()[k])) return false;
  }
  return true;
}

/// The same for one node.
bool PointFilm::Equations::settle_node(Index k, double old_film) {
  const double boundary = film_.boundary_film_;
  PointNode& node = state_.nodes.data()[k];
  double& film = state_.film.data()[k];
  double& depth = state_.plastic_depth.data()[k];
  if (node == PointNode::touching) return true;
  if (node == PointNode::plastic_touching) {
    if (film > boundary) {  // the solids would have to pull
      node = PointNode::touching;
      return true;
    }
  } else if (film >= kTooThin * boundary) {
    return film >= kThinnest * old_film || old_film <= kThin * boundary;
  } else if (old_film > kThin * boundary) {
    return false;
  } else if (node != PointNode::plastic) {
    node = PointNode::touching;
    return true;
  }
  node = PointNode::plastic_touching;
  depth += boundary - film;
  film = boundary;
  return true;
}

bool PointFilm::Equations::settle() {
  const Mask touched = touching();
  if (change_nodes()) {
    // Only contact makes other rows of a node than flow.
    if ((touching() != touched).any()) {
      linear_ = linearize();
    } else {
      linear_.held = held();
    }
  }
  return (state_.nodes == nodes_before_).all();
}

/// Cavities that gain liquid fill; of nodes about as thin as the boundary film, those touch that
/// lose more liquid than the film is above it. True if any changed.
bool PointFilm::Equations::change_nodes() {
  const double unit = film_.units_.film;
  const double surplus = 0.1 * conditions_.tolerance * film_scale_ / unit;
  bool changed = false;
  const auto change = [&](PointNode& node, PointNode to) {
    node = to;
    changed = true;
  };
  for (Index k = 0; k < state_.nodes.size(); ++k) {
    if (!film_.in_domain(k)) continue;
    PointNode& node = state_.nodes.data()[k];
    const double gain = linear_.gain.data()[k];
    const double clearance = (state_.film.data()[k] - film_.boundary_film_) / unit;
    const bool thickens = gain + clearance > surplus;
    if (node == PointNode::cavity) {
      if (gain > surplus) change(node, PointNode::liquid);
    } else if (touches(node)) {
      if (thickens) change(node, is_plastic(node) ? PointNode::plastic : PointNode::liquid);
    } else if (clearance < 0 && gain + clearance < 0) {
      change(node, is_plastic(node) ? PointNode::plastic_touching : PointNode::touching);
    }
  }
  return changed;
}

}  // namespace tabor::ehl
