#include "tabor/ehl/point/film.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "tabor/ehl/point/equations.hpp"
#include "tabor/numerics/newton.hpp"
#include "tabor/reference/hertz_ellipse.hpp"

namespace tabor::ehl {
namespace {

constexpr double kAllCavity = 1 - 1e-9;
constexpr double kFirstFilm = 2;  // boundary films that a start is lifted to

Field shape_of(const PointProblem& problem, const Eigen::ArrayXd& x, const Eigen::ArrayXd& y) {
  Field shape = (y.square() / (2 * problem.radius_y)).replicate(1, x.size()) +
                (x.square() / (2 * problem.radius_x)).transpose().replicate(y.size(), 1);
  if (problem.roughness.size() > 0) shape -= problem.roughness;
  return shape;
}

}  // namespace

bool touches(PointNode node) {
  return node == PointNode::touching || node == PointNode::plastic_touching;
}

bool is_plastic(PointNode node) {
  return node == PointNode::plastic || node == PointNode::plastic_touching;
}

PointNodes nodes_of(const Mask& cavity) {
  return cavity.unaryExpr([](bool is) { return is ? PointNode::cavity : PointNode::liquid; });
}

PointFilm::PointFilm(const PointProblem& problem, PointFilmOptions options)
    : problem_(problem),
      options_(options),
      grid_(point_grid(problem)),
      x_(point_x(problem)),
      y_(point_y(problem)),
      conditions_{.shape = shape_of(problem, x_, y_),
                  .lubricant = problem.lubricant,
                  .speed = problem.entrainment_speed,
                  .sliding_speed = problem.sliding_speed,
                  .tolerance = problem.tolerance},
      boundary_film_(options.solids_touch ? problem.asperities.boundary_film : 0),
      plastic_pressure_(options.solids_touch ? problem.plastic_pressure : kNoPlasticLimit) {
  problem_.roughness.resize(0, 0);
  const reference::HertzEllipse hertz = hertz_of(problem);
  const double film = film_scale();
  pressed_width_x_ = std::max(hertz.half_axis_x, std::sqrt(2 * problem.radius_x * film));
  pressed_width_y_ = std::max(hertz.half_axis_y, std::sqrt(2 * problem.radius_y * film));
  units_.pressure = 1.5 * problem.load / (std::numbers::pi * pressed_width_x_ * pressed_width_y_);
  units_.film = std::max(hertz.half_axis_x * hertz.half_axis_x / problem.radius_x, film);
  units_.load = problem.load;
  levels_ = point_levels(grid_, problem.effective_modulus, units_.pressure / units_.film,
                         options.coarsens);
}

/// What errors of mass compare with [m].
double PointFilm::film_scale_at(double speed) const {
  reference::PointContactFilm groups = film_groups_of(problem_);
  groups.entrainment_speed = speed;
  return groups.nijenbanning_central();
}

bool PointFilm::in_domain(Index k) const {
  const Index i = k % grid_.nx;
  const Index j = k / grid_.nx;
  return i > 0 && i + 1 < grid_.nx && j > 0 && j + 1 < grid_.ny;
}

PointState PointFilm::hertz_start(double min_film) const {
  // The cavity begins rather too far out: it grows at once but shrinks node by node.
  const double rupture = pressed_width_x_ + std::sqrt(2 * problem_.radius_x * film_scale());
  PointState state{.pressure = Field(grid_.ny, grid_.nx),
                   .plastic_depth = Field::Zero(grid_.ny, grid_.nx),
                   .film = {},
                   .nodes = PointNodes(grid_.ny, grid_.nx)};
  for (Index j = 0; j < y_.size(); ++j) {
    for (Index i = 0; i < x_.size(); ++i) {
      const double inside =
          1 - std::pow(x_[i] / pressed_width_x_, 2) - std::pow(y_[j] / pressed_width_y_, 2);
      state.pressure(j, i) = units_.pressure * std::sqrt(std::max(0.0, inside));
      state.nodes(j, i) = x_[i] >= rupture ? PointNode::cavity : PointNode::liquid;
    }
  }
  state.film = film_of(state, conditions_.shape);
  state.separation = min_film - state.film.minCoeff();
  state.film += state.separation;
  return state;
}

PointState PointFilm::resampled(const PointState& state, const Grid& from) const {
  const numerics::NodeTransfer transfer(grid_, from);
  const auto share_of = [&](const Mask& nodes) { return transfer.to_fine(nodes.cast<double>()); };
  PointState result{.pressure = transfer.to_fine(state.pressure),
                    .plastic_depth = {},
                    .separation = state.separation,
                    .film = {},
                    .nodes = nodes_of(share_of(state.nodes == PointNode::cavity) > kAllCavity)};
  const Mask flows =
      share_of(state.nodes.unaryExpr(&is_plastic)) > 0.5 && result.nodes == PointNode::liquid;
  result.pressure = flows.select(plastic_pressure_, result.pressure);
  result.plastic_depth = flows.select(transfer.to_fine(state.plastic_depth), 0);
  result.nodes =
      flows.select(PointNodes::Constant(grid_.ny, grid_.nx, PointNode::plastic), result.nodes);
  result.film = film_of(result, conditions_.shape);
  return result;
}

Field PointFilm::deflection(const Field& pressure) const {
  return units_.film * levels_.front().elastic(pressure / units_.pressure);
}

/// What the surfaces leave between them [m].
Field PointFilm::film_of(const PointState& state, const Field& shape) const {
  return deflection(state.pressure) + shape + state.separation + state.plastic_depth;
}

Field PointFilm::mass_of(const PointState& state) const {
  const auto& density = conditions_.lubricant.density;
  return state.film * state.pressure.unaryExpr([&](double p) { return density.at(p).value; });
}

Field PointFilm::first_mass(PointState state, const PointConditions& conditions) const {
  state.film = film_of(state, conditions.shape);
  open(state);
  return mass_of(state);
}

/// Raises solids that would run into each other before the first step; where they may not touch,
/// false instead.
bool PointFilm::open(PointState& state) const {
  if (!options_.solids_touch) return state.film.minCoeff() > 0;
  const Mask touching = state.nodes.unaryExpr(&touches);
  const double lacking =
      kFirstFilm * boundary_film_ - touching.select(state.film.maxCoeff(), state.film).minCoeff();
  if (lacking > 0) {
    state.separation += lacking;
    state.film += lacking;
  }
  return true;
}

PointFilm::Outcome PointFilm::solve(PointState& state, const PointConditions& conditions,
                                    const PointStorage& storage, const Observer& observer) const {
  for (Index k = 0; k < state.nodes.size(); ++k) {
    const bool is_given = !in_domain(k) || state.nodes.data()[k] == PointNode::cavity;
    if (is_given) state.pressure.data()[k] = 0;
  }
  state.film = film_of(state, conditions.shape);
  if (!open(state)) {
    return {.convergence = {.tolerance = conditions.tolerance, .status = Status::stalled}};
  }
  Equations equations(*this, conditions, storage, state);
  numerics::newton(equations,
                   {.max_iterations = problem_.max_iterations,
                    .stage = options_.solids_touch ? "mixed point contact" : "point contact"},
                   observer);
  return equations.outcome();
}

}  // namespace tabor::ehl
