#include "tabor/ehl/point/mixed_film.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "tabor/ehl/point/lines.hpp"
#include "tabor/ehl/point/multigrid.hpp"
#include "tabor/ehl/point/start.hpp"

namespace tabor::ehl {
namespace {

constexpr Index kManyNodes = 40000;
constexpr int kMaxHalvings = 8;
constexpr double kThinnest = 0.1;  // a step may leave this much of a film
constexpr double kThin = 10;       // films thinner than this many boundary films may touch at once
constexpr double kTooThin = 0.3;   // of the boundary film: touches whatever the flow says
constexpr double kMayGrow = 1.5;   // the norm of the residual, in a step that is taken
/// Boundary films that count as touching in results: a boundary film that left a pressure of GPa is
/// thicker by the ratio of densities, at most 1.35 by Dowson & Higginson.
constexpr double kTouchingFilm = 1.5;
constexpr double kFirstFilm = 2;  // boundary films that a start is lifted to

}  // namespace

bool touches(MixedNode node) {
  return node == MixedNode::touching || node == MixedNode::plastic_touching;
}

bool is_plastic(MixedNode node) {
  return node == MixedNode::plastic || node == MixedNode::plastic_touching;
}

/// Rows of flow or, where solids touch, of contact.
struct MixedFilm::Linear : PointLinear {
  Field gain;  // of liquid at every node: minus the imbalance of the flow
};

MixedFilm::MixedFilm(const PointProblem& problem)
    : tolerance(problem.tolerance), problem_(problem), film_(problem) {
  if (problem_.roughness.size() == 0) {
    problem_.roughness = Field::Zero(film_.grid().ny, film_.grid().nx);
  }
  set_speed(problem.entrainment_speed);
}

void MixedFilm::set_speed(double speed) {
  film_.speed = speed;
  sliding_speed_ = problem_.sliding_speed * speed / problem_.entrainment_speed;
  reference::PointContactFilm groups = film_groups_of(problem_);
  groups.entrainment_speed = speed;
  film_scale_ = groups.nijenbanning_central();
}

bool MixedFilm::in_domain(Index k) const {
  const Index nx = film_.grid().nx;
  const Index i = k % nx;
  const Index j = k / nx;
  return i > 0 && i + 1 < nx && j > 0 && j + 1 < film_.grid().ny;
}

/// What the surfaces leave between them [m].
Field MixedFilm::gap_of(const MixedState& state) const {
  return film_.deflection(state.pressure) + film_.shape +
         (1 - share_of_roughness) * problem_.roughness + state.separation + state.plastic_depth;
}

MixedState MixedFilm::state_from(const PointState& film) const {
  MixedState state{.pressure = film.pressure.min(problem_.plastic_pressure),
                   .plastic_depth = Field::Zero(film.pressure.rows(), film.pressure.cols()),
                   .separation = film.separation,
                   .film = {},
                   .nodes = {}};
  state.nodes.resize(film.pressure.rows(), film.pressure.cols());
  for (Index k = 0; k < state.nodes.size(); ++k) {
    const bool open = in_domain(k) && !film.cavity.data()[k];
    state.nodes.data()[k] = open ? MixedNode::liquid : MixedNode::cavity;
  }
  state.film = gap_of(state);
  return state;
}

MixedState MixedFilm::state_from(const PointResult& result) const {
  Field pressure = result.pressure;
  if (result.contact_pressure.size() > 0) pressure += result.contact_pressure;
  const bool same_grid = result.grid == film_.grid();
  if (!same_grid) pressure = numerics::NodeTransfer(film_.grid(), result.grid).to_fine(pressure);
  MixedState state = state_from(PointState{
      .pressure = pressure, .separation = result.separation, .film = {}, .cavity = pressure <= 0});
  if (!same_grid) return state;
  if (result.plastic_depth.size() > 0) state.plastic_depth = result.plastic_depth;
  for (Index k = 0; k < state.nodes.size(); ++k) {
    if (!in_domain(k) || state.nodes.data()[k] == MixedNode::cavity) continue;
    const bool touching = result.film.data()[k] <= 0;
    const bool plastic = state.plastic_depth.data()[k] > 0;
    state.nodes.data()[k] = plastic ? (touching ? MixedNode::plastic_touching : MixedNode::plastic)
                                    : (touching ? MixedNode::touching : MixedNode::liquid);
  }
  state.film = gap_of(state);
  return state;
}

PointResult MixedFilm::result_of(const MixedState& state, const PointFilm::Outcome& outcome) const {
  const Mask touching = state.nodes != MixedNode::cavity &&
                        state.film < kTouchingFilm * problem_.asperities.boundary_film;
  const PointState liquid{.pressure = touching.select(0, state.pressure),
                          .separation = state.separation,
                          .film = touching.select(0, state.film),
                          .cavity = {}};
  PointResult result = ehl::result_of(problem_, film_, liquid, outcome);
  const Mask solid = touching || state.plastic_depth > 0;
  if (solid.any()) result.contact_pressure = solid.select(state.pressure, 0);
  result.pressure = solid.select(0, result.pressure);
  if (std::isfinite(problem_.plastic_pressure)) result.plastic_depth = state.plastic_depth;
  result.entrainment_speed = film_.speed;
  return result;
}

PointFlow MixedFilm::flow_of(const MixedState& state, const Field& film) const {
  return {.grid = film_.grid(),
          .lubricant = film_.lubricant,
          .speed = film_.speed,
          .sliding_speed = sliding_speed_,
          .pressure = state.pressure,
          .film = film};
}

MixedFilm::Linear MixedFilm::linearize(const MixedState& state) const {
  const Mask touching = state.nodes.unaryExpr(&touches);
  const Field film = touching.select(problem_.asperities.boundary_film, state.film);
  Linear linear;
  linear.rows = point_balance(flow_of(state, film), {}, film_.units());
  linear.gain = -linear.rows.residual;
  linear.held.resize(touching.rows(), touching.cols());
  linear.deep = state.nodes == MixedNode::plastic;
  for (Index k = 0; k < touching.size(); ++k) {
    const MixedNode node = state.nodes.data()[k];
    linear.held.data()[k] =
        !in_domain(k) || node == MixedNode::cavity || node == MixedNode::plastic_touching;
    if (touches(node)) set_contact_row(state, k, linear);
  }
  linear.load =
      (film_.grid().pixel_area() * state.pressure.sum() - film_.load) / film_.units().load;
  return linear;
}

/// The row of node k becomes h = h_b, and no flow depends on h there.
void MixedFilm::set_contact_row(const MixedState& state, Index k, Linear& linear) const {
  for (std::size_t n = 0; n < kPointNeighbours.size(); ++n) {
    linear.rows.by_pressure.coefficient[n].data()[k] = 0;
    linear.rows.by_film.coefficient[n].data()[k] = 0;
    const Index row = k - kPointNeighbours[n].y * film_.grid().nx - kPointNeighbours[n].x;
    const bool is_contact =
        row < 0 || row >= state.nodes.size() || touches(state.nodes.data()[row]);
    if (!is_contact) linear.rows.by_film.coefficient[n].data()[row] = 0;
  }
  linear.rows.by_film.coefficient[0].data()[k] = 1;
  linear.rows.residual.data()[k] =
      (state.film.data()[k] - problem_.asperities.boundary_film) / film_.units().film;
}

/// Empty if the linear equations cannot be solved. Coarser grids know nothing of plastic and
/// touching nodes, so that multigrid serves badly where there are many: factors of the local
/// equations take its place, on large grids only where it fails.
Eigen::VectorXd MixedFilm::newton_step(const Linear& linear, const MixedState& state,
                                       PointFilm::Outcome& outcome) const {
  const Mask touching = state.nodes.unaryExpr(&touches);
  const bool is_mixed = linear.deep.any() || touching.any();
  int& n_products = outcome.convergence.operator_applications;
  const int before = n_products;
  const auto solve = [&](const PointInverse& inverse) {
    return solve_bordered(linear, film_.levels().front(), film_.units(), inverse, n_products);
  };
  std::optional<Eigen::VectorXd> step;
  if (!is_mixed || film_.grid().size() > kManyNodes) {
    const Field film = touching.select(problem_.asperities.boundary_film, state.film);
    const PointMultigrid inverse(film_.levels(), linear.rows, linear.held, flow_of(state, film), {},
                                 film_.units(), {.depth = linear.deep, .contact = touching});
    if (inverse.ok()) step = solve(std::cref(inverse));
  }
  if (!step) {
    const PointDirect direct(
        PointLocal(linear.rows, linear.held, film_.levels().front().elastic, linear.deep));
    const auto inverse = [&](const Field& right) -> Field {
      return linear.held.select(right, direct(right));
    };
    if (direct.ok()) step = solve(inverse);
  }
  outcome.n_linear_iterations += n_products - before;
  return step.value_or(Eigen::VectorXd());
}

/// Norm of what is not yet balanced: of the film, of contact, and of cavity that gains liquid.
double MixedFilm::merit(const Linear& linear, const MixedState& state) const {
  const Mask cavity = state.nodes == MixedNode::cavity;
  const Field open = linear.held.select(cavity.select(linear.gain.max(0), 0), linear.rows.residual);
  const double relative = film_.units().film / film_scale_;
  return std::sqrt(open.square().sum() * relative * relative /
                       static_cast<double>(film_.grid().nx) +
                   linear.load * linear.load);
}

/// Adds a change to the unknown of a node; what passes a bound of it changes its equation at once.
void MixedFilm::move_node(Index k, double change, MixedState& state) const {
  MixedNode& node = state.nodes.data()[k];
  double& pressure = state.pressure.data()[k];
  double& depth = state.plastic_depth.data()[k];
  if (node == MixedNode::plastic) {
    depth += film_.units().film * change;
    if (depth >= 0) return;
    depth = 0;
    node = MixedNode::liquid;
  } else if (node == MixedNode::plastic_touching) {
    depth = 0;  // follows from the gap
  } else if (node != MixedNode::cavity) {
    pressure += film_.units().pressure * change;
    if (pressure < 0) {
      node = MixedNode::cavity;
    } else if (pressure > problem_.plastic_pressure) {
      node = touches(node) ? MixedNode::plastic_touching : MixedNode::plastic;
    }
    pressure = std::clamp(pressure, 0.0, problem_.plastic_pressure);
  }
}

/// Gives a node the depth or the contact that its gap asks for. False where a film was lost too
/// fast to believe.
bool MixedFilm::settle_node(Index k, double old_film, MixedState& state) const {
  const double boundary = problem_.asperities.boundary_film;
  MixedNode& node = state.nodes.data()[k];
  double& film = state.film.data()[k];
  double& depth = state.plastic_depth.data()[k];
  if (node == MixedNode::touching) return true;
  if (node == MixedNode::plastic_touching) {
    if (film > boundary) {  // the solids would have to pull
      node = MixedNode::touching;
      return true;
    }
  } else if (film >= kTooThin * boundary) {
    return film >= kThinnest * old_film || old_film <= kThin * boundary;
  } else if (old_film > kThin * boundary) {
    return false;
  } else if (node != MixedNode::plastic) {
    node = MixedNode::touching;
    return true;
  }
  node = MixedNode::plastic_touching;
  depth += boundary - film;
  film = boundary;
  return true;
}

bool MixedFilm::step_to(const MixedState& old, const Eigen::VectorXd& step, double share,
                        MixedState& state) const {
  const Index n = film_.grid().size();
  state = old;
  state.separation += share * film_.units().film * step[n];
  for (Index k = 0; k < n; ++k) {
    if (in_domain(k)) move_node(k, share * step[k], state);
  }
  const auto range = material::computable_range(film_.lubricant);
  if (!range.contains(state.pressure.maxCoeff())) return false;
  state.film = gap_of(state);
  bool ok = true;
  for (Index k = 0; k < n && ok; ++k) ok = settle_node(k, old.film.data()[k], state);
  return ok;
}

/// Applies a Newton correction, halved until it can be believed. False if that does not help.
bool MixedFilm::correct(const Eigen::VectorXd& step, MixedState& state, Linear& linear,
                        PointFilm::Outcome& outcome) const {
  if (step.size() == 0 || !step.allFinite()) return false;
  const MixedState old = state;
  const double before = merit(linear, old);
  double share = 1;
  for (int i = 0; i <= kMaxHalvings; ++i, share /= 2) {
    ++outcome.convergence.operator_applications;
    if (!step_to(old, step, share, state)) continue;
    linear = linearize(state);
    if (merit(linear, state) <= kMayGrow * before) return true;
  }
  state = old;
  return false;
}

/// Cavities that gain liquid fill; of nodes about as thin as the boundary film, those touch that
/// lose more liquid than the film is above it. True if any changed.
bool MixedFilm::change_nodes(const Linear& linear, MixedState& state) const {
  const double surplus = 0.1 * tolerance * film_scale_ / film_.units().film;
  bool changed = false;
  const auto change = [&](MixedNode& node, MixedNode to) {
    node = to;
    changed = true;
  };
  for (Index k = 0; k < state.nodes.size(); ++k) {
    if (!in_domain(k)) continue;
    MixedNode& node = state.nodes.data()[k];
    const double gain = linear.gain.data()[k];
    const double room =
        (state.film.data()[k] - problem_.asperities.boundary_film) / film_.units().film;
    const bool thickens = gain + room > surplus;
    if (node == MixedNode::cavity) {
      if (gain > surplus) change(node, MixedNode::liquid);
    } else if (touches(node)) {
      if (thickens) change(node, is_plastic(node) ? MixedNode::plastic : MixedNode::liquid);
    } else if (room < 0 && gain + room < 0) {
      change(node, is_plastic(node) ? MixedNode::plastic_touching : MixedNode::touching);
    }
  }
  return changed;
}

void MixedFilm::measure(const Linear& linear, PointFilm::Outcome& outcome) const {
  const Field open = linear.held.select(0, linear.rows.residual);
  outcome.mass_error = open.abs().maxCoeff() * film_.units().film / film_scale_;
  outcome.load_error = std::abs(linear.load);
  outcome.convergence.certificate = std::max(outcome.mass_error, outcome.load_error);
}

/// Raises bodies that would run into each other before the first step.
void MixedFilm::lift(MixedState& state) const {
  state.film = gap_of(state);
  const Mask touching = state.nodes.unaryExpr(&touches);
  const double lacking = kFirstFilm * problem_.asperities.boundary_film -
                         touching.select(state.film.maxCoeff(), state.film).minCoeff();
  if (!(lacking > 0)) return;
  state.separation += lacking;
  state.film += lacking;
}

PointFilm::Outcome MixedFilm::solve(MixedState& state, const Observer& observer) const {
  PointFilm::Outcome outcome;
  Convergence& convergence = outcome.convergence;
  convergence.tolerance = tolerance;
  lift(state);
  Linear linear = linearize(state);
  if (asks_to_stop(observer, {.stage = "mixed point contact"})) {
    convergence.status = Status::stopped;
  }
  while (convergence.status == Status::iteration_limit &&
         convergence.iterations < problem_.max_iterations) {
    ++convergence.iterations;
    const MixedNodes before = state.nodes;
    if (!correct(newton_step(linear, state, outcome), state, linear, outcome)) {
      convergence.status = Status::stalled;
      break;
    }
    measure(linear, outcome);
    if (change_nodes(linear, state)) linear = linearize(state);
    if ((state.nodes == before).all() && outcome.mass_error <= tolerance &&
        outcome.load_error <= tolerance) {
      convergence.status = Status::converged;
    }
    if (asks_to_stop(observer, {.stage = "mixed point contact", .convergence = &convergence})) {
      convergence.status = Status::stopped;
    }
  }
  return outcome;
}

}  // namespace tabor::ehl
