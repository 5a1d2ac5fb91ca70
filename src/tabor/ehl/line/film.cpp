#include "tabor/ehl/line/film.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tabor/ehl/line/equations.hpp"
#include "tabor/numerics/newton.hpp"

namespace tabor::ehl {
namespace {

double spacing_of(const Eigen::ArrayXd& x) {
  return (x[x.size() - 1] - x[0]) / static_cast<double>(x.size() - 1);
}

Eigen::ArrayXd shape_of(const LineProblem& problem) {
  const Eigen::ArrayXd smooth = line_nodes(problem).square() / (2 * problem.radius);
  return problem.roughness.size() > 0 ? Eigen::ArrayXd(smooth - problem.roughness) : smooth;
}

}  // namespace

LineFilm::LineFilm(const LineProblem& problem, bool full_matrix)
    : problem_(problem),
      full_matrix_(full_matrix),
      n_(problem.nodes),
      x_(line_nodes(problem)),
      spacing_(spacing_of(x_)),
      elastic_(n_, spacing_, problem.effective_modulus),
      conditions_{shape_of(problem), problem.lubricant, problem.entrainment_speed} {
  const reference::HertzLineContact hertz = hertz_of(problem);
  film_scale_ = std::max(film_groups_of(problem).moes_min_film(), problem.asperities.boundary_film);
  pressed_width_ = std::max(hertz.half_width, std::sqrt(2 * problem.radius * film_scale_));
  units_.pressure = 2 * problem.load / (std::numbers::pi * pressed_width_);
  units_.film = std::max(hertz.half_width * hertz.half_width / problem.radius, film_scale_);
  units_.load = problem.load;
}

LineState LineFilm::hertz_start(double min_film, const LineConditions& conditions) const {
  // Rather too far out: a cavity grows at once but shrinks node by node.
  const double rupture = pressed_width_ + std::sqrt(2 * problem_.radius * film_scale_);
  LineState state;
  state.cavity.assign(static_cast<std::size_t>(n_), false);
  state.pressure.resize(n_);
  for (Index i = 0; i < n_; ++i) {
    const double place = x_[i] / pressed_width_;
    state.pressure[i] = units_.pressure * std::sqrt(std::max(0.0, 1 - place * place));
    state.cavity[static_cast<std::size_t>(i)] = x_[i] >= rupture;
  }
  state.separation = min_film - (deflection(state.pressure) + conditions.shape).minCoeff();
  return state;
}

Eigen::ArrayXd LineFilm::deflection(const Eigen::ArrayXd& pressure) const {
  Eigen::ArrayXd result(n_);
  const auto n = static_cast<std::size_t>(n_);
  elastic_.apply({pressure.data(), n}, {result.data(), n});
  return result;
}

Eigen::ArrayXd LineFilm::film_of(const LineState& state, const Eigen::ArrayXd& shape) const {
  const bool touches = state.asperity_pressure.size() > 0;
  const Eigen::ArrayXd total =
      touches ? Eigen::ArrayXd(state.pressure + state.asperity_pressure) : state.pressure;
  return deflection(total) + shape + state.separation;
}

Eigen::ArrayXd LineFilm::mass_of(const LineState& state) const {
  Eigen::ArrayXd mass(n_);
  for (Index i = 0; i < n_; ++i) {
    mass[i] = conditions_.lubricant.density.at(state.pressure[i]).value * state.film[i];
  }
  return mass;
}

LineFilm::Outcome operator+(const LineFilm::Outcome& before, LineFilm::Outcome now) {
  now.convergence = after(before.convergence, now.convergence);
  return now;
}

LineFilm::Outcome LineFilm::solve(LineState& state, const LineConditions& conditions,
                                  const LineStorage& storage, int max_iterations,
                                  const Observer& observer) const {
  state.cavity.front() = state.cavity.back() = true;
  state.pressure[0] = state.pressure[n_ - 1] = 0;
  state.film = film_of(state, conditions.shape);
  Equations equations(*this, conditions, storage, state);
  numerics::newton(equations, {.max_iterations = max_iterations, .stage = "line contact"},
                   observer);
  return equations.outcome();
}

}  // namespace tabor::ehl
