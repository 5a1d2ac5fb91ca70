#include "tabor/ehl/point/equations.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "tabor/ehl/point/lines.hpp"

namespace tabor::ehl {
namespace {

constexpr Index kManyNodes = 40000;

}  // namespace

PointFilm::Equations::Equations(const PointFilm& film, const PointConditions& conditions,
                                const PointStorage& storage, PointState& state)
    : film_(film),
      conditions_(conditions),
      storage_(storage),
      state_(state),
      film_scale_(film.film_scale_at(conditions.speed)),
      linear_(linearize()) {
  outcome_.convergence.tolerance = conditions.tolerance;
}

/// The film [m] that liquid flows through: the boundary film where solids touch, and where they no
/// longer do but still overlap.
Field PointFilm::Equations::flowing_film() const {
  const Mask closed = touching() || state_.film < kTooThin * film_.boundary_film_;
  return closed.select(film_.boundary_film_, state_.film);
}

PointFlow PointFilm::Equations::flow_through(const Field& film) const {
  return {.grid = film_.grid_,
          .lubricant = conditions_.lubricant,
          .speed = conditions_.speed,
          .sliding_speed = conditions_.sliding_speed,
          .pressure = state_.pressure,
          .film = film};
}

/// Nodes at which nothing is unknown.
Mask PointFilm::Equations::held() const {
  Mask held = state_.nodes == PointNode::cavity || state_.nodes == PointNode::plastic_touching;
  held.row(0) = held.row(held.rows() - 1) = true;
  held.col(0) = held.col(held.cols() - 1) = true;
  return held;
}

PointFilm::Equations::Linear PointFilm::Equations::linearize() const {
  const Field film = flowing_film();
  Linear linear;
  linear.rows = point_balance(flow_through(film), storage_, film_.units_);
  // Films thinner than what flows: their balance goes on along its tangent.
  const Field lacking = touching().select(0, (state_.film - film) / film_.units_.film);
  linear.rows.by_film.add_product(lacking, linear.rows.residual);
  linear.gain = -linear.rows.residual;
  linear.held = held();
  linear.deep = state_.nodes == PointNode::plastic;
  for (Index k = 0; k < state_.nodes.size(); ++k) {
    if (touches(state_.nodes.data()[k])) set_contact_row(k, linear);
  }
  const double carried = film_.grid_.pixel_area() * state_.pressure.sum();
  linear.load = (carried - film_.problem_.load) / film_.units_.load;
  return linear;
}

/// The row of node k becomes h = h_b, and no flow depends on h there.
void PointFilm::Equations::set_contact_row(Index k, Linear& linear) const {
  for (std::size_t n = 0; n < kPointNeighbours.size(); ++n) {
    linear.rows.by_pressure.coefficient[n].data()[k] = 0;
    linear.rows.by_film.coefficient[n].data()[k] = 0;
    const Index row = k - kPointNeighbours[n].y * film_.grid_.nx - kPointNeighbours[n].x;
    const bool is_contact =
        row < 0 || row >= state_.nodes.size() || touches(state_.nodes.data()[row]);
    if (!is_contact) linear.rows.by_film.coefficient[n].data()[row] = 0;
  }
  linear.rows.by_film.coefficient[0].data()[k] = 1;
  linear.rows.residual.data()[k] =
      (state_.film.data()[k] - film_.boundary_film_) / film_.units_.film;
}

/// Coarser grids know nothing of plastic and touching nodes, so that multigrid serves badly where
/// there are many: factors of the local equations take its place, on large grids only where it
/// fails. Where no solids can touch it fails only far from any solution, and another start serves
/// better.
Eigen::VectorXd PointFilm::Equations::step() {
  nodes_before_ = state_.nodes;
  merit_before_ = merit();
  const int before = outcome_.convergence.operator_applications;
  const Mask touched = touching();
  const bool is_mixed = linear_.deep.any() || touched.any();
  std::optional<Eigen::VectorXd> step;
  if (!is_mixed) {
    step = step_by_multigrid({});
  } else if (film_.grid_.size() > kManyNodes) {
    step = step_by_multigrid({.depth = linear_.deep, .contact = touched});
  }
  if (!step && film_.options_.solids_touch) step = step_by_factors();
  outcome_.n_linear_iterations += outcome_.convergence.operator_applications - before;
  return step.value_or(Eigen::VectorXd());
}

std::optional<Eigen::VectorXd> PointFilm::Equations::step_by_multigrid(
    const PointExceptions& exceptions) {
  const Field film = flowing_film();
  const PointMultigrid inverse(film_.levels_, linear_.rows, linear_.held, flow_through(film),
                               storage_, film_.units_, exceptions);
  if (!inverse.ok()) return std::nullopt;
  return solve_bordered(linear_, film_.levels_.front(), film_.units_, std::cref(inverse),
                        outcome_.convergence.operator_applications);
}

std::optional<Eigen::VectorXd> PointFilm::Equations::step_by_factors() {
  const PointLevel& finest = film_.levels_.front();
  const PointDirect direct(PointLocal(linear_.rows, linear_.held, finest.elastic, linear_.deep));
  if (!direct.ok()) return std::nullopt;
  const auto inverse = [&](const Field& right) -> Field {
    return linear_.held.select(right, direct(right));
  };
  return solve_bordered(linear_, finest, film_.units_, inverse,
                        outcome_.convergence.operator_applications);
}

/// Norm of what is not yet balanced: of the film, of contact, and of cavity that gains liquid.
double PointFilm::Equations::merit() const {
  const Mask cavity = state_.nodes == PointNode::cavity;
  const Field open =
      linear_.held.select(cavity.select(linear_.gain.max(0), 0), linear_.rows.residual);
  const double relative = film_.units_.film / film_scale_;
  return std::sqrt(open.square().sum() * relative * relative / static_cast<double>(film_.grid_.nx) +
                   linear_.load * linear_.load);
}

bool PointFilm::Equations::measure() {
  const Field open = linear_.held.select(0, linear_.rows.residual);
  outcome_.mass_error = open.abs().maxCoeff() * film_.units_.film / film_scale_;
  outcome_.load_error = std::abs(linear_.load);
  outcome_.convergence.certificate = std::max(outcome_.mass_error, outcome_.load_error);
  return outcome_.convergence.certificate <= conditions_.tolerance;
}

}  // namespace tabor::ehl
