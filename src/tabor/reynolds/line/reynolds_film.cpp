#include "tabor/reynolds/line/reynolds_film.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tabor/core/error.hpp"

namespace tabor::reynolds {

namespace {

constexpr int kMaxIterations = 200;
constexpr double kTolerance = 1e-12;  // of the mass balance
constexpr int kMaxHalvings = 8;
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

void check_size(const char* what, Index got, Index expected) {
  if (got != expected) {
    throw InputError(what, fmt::format("{} values", got), fmt::format("{} values", expected), "");
  }
}

void check(const FilmProblem& problem) {
  const Index n = problem.grid.n_cells();
  check_size("film", problem.film.size(), n + 2);
  if (!(problem.film.minCoeff() > 0)) {
    throw InputError("film", fmt::format("{} m", problem.film.minCoeff()), "more than zero", "");
  }
  if (problem.squeeze.size() > 0) check_size("squeeze", problem.squeeze.size(), n);
  if (problem.time_step > 0) check_size("old_mass", problem.old_mass.size(), n);
}

/// Residuals of the cells and the tridiagonal matrix of their derivatives by the unknowns: the
/// pressure of a cell, or its fill inside a mass-conserving cavity.
struct Balance {
  Eigen::ArrayXd residual, lower, diagonal, upper;
  double scale = 0;     ///< largest flow [kg/(m s)] or [kg/s]
  double rounding = 0;  ///< what rounding the pressures does to a flow

  explicit Balance(Index n)
      : residual(Eigen::ArrayXd::Zero(n)), lower(residual), diagonal(residual), upper(residual) {}

  double norm() const { return residual.matrix().norm(); }
  double error() const { return residual.abs().maxCoeff(); }
  double tolerance() const { return kTolerance * scale + 16 * rounding; }

  /// Thomas' algorithm; returns the Newton step.
  Eigen::ArrayXd step() const {
    const Index n = residual.size();
    Eigen::ArrayXd pivot = diagonal;
    Eigen::ArrayXd right = -residual;
    for (Index i = 1; i < n; ++i) {
      const double factor = lower[i] / pivot[i - 1];
      pivot[i] -= factor * upper[i - 1];
      right[i] -= factor * right[i - 1];
    }
    right[n - 1] /= pivot[n - 1];
    for (Index i = n - 2; i >= 0; --i) right[i] = (right[i] - upper[i] * right[i + 1]) / pivot[i];
    return right;
  }
};

class FilmSolver {
 public:
  explicit FilmSolver(const FilmProblem& problem)
      : problem_(problem),
        n_(problem.grid.n_cells()),
        pressure_(Eigen::ArrayXd::Constant(n_ + 2, problem.cavitation_pressure)),
        fill_(Eigen::ArrayXd::Ones(n_ + 2)),
        cavity_(static_cast<std::size_t>(n_), false) {
    pressure_[0] = problem.left_pressure;
    pressure_[n_ + 1] = problem.right_pressure;
    penalty_ = penalty_coefficient();
  }

  FilmSolution solve() {
    FilmSolution solution;
    Convergence& convergence = solution.convergence;
    while (convergence.iterations < kMaxIterations && convergence.failed()) {
      ++convergence.iterations;
      advance(balance());
      const bool changed = move_cavity();
      const Balance now = balance();
      convergence.certificate = now.error() / now.scale;
      convergence.tolerance = now.tolerance() / now.scale;
      if (!changed && now.error() <= now.tolerance()) convergence.status = Status::converged;
    }
    return finished(std::move(solution));
  }

 private:
  bool has_cavity() const {
    return problem_.cavitation == Cavitation::reynolds ||
           problem_.cavitation == Cavitation::mass_conserving;
  }
  bool conserves() const { return problem_.cavitation == Cavitation::mass_conserving; }
  bool in_cavity(Index cell) const { return cavity_[static_cast<std::size_t>(cell)]; }

  double penalty_coefficient() const {
    if (problem_.cavitation != Cavitation::penalty) return 0;
    const LiquidState liquid =
        liquid_at(problem_.liquid, problem_.cavitation_pressure, problem_.density);
    const double widest = problem_.film.maxCoeff();
    const double length = problem_.grid.node[n_ + 1] - problem_.grid.node[0];
    return problem_.penalty * liquid.density * widest * widest * widest /
           (12 * liquid.viscosity * length * length);
  }

  FilmNode node_at(Index i, Index face) const {
    return {.pressure = pressure_[i],
            .film = problem_.film[i],
            .fill = fill_[i],
            .liquid = liquid_at(problem_.liquid, pressure_[i], problem_.density),
            .distance = std::abs(problem_.grid.face[face] - problem_.grid.node[i])};
  }

  /// Width times flow through a face; nothing where the width is zero (centre of a disc).
  FaceFlow flow_through(Index face) const {
    const double width = problem_.grid.width[face];
    if (width == 0) return {};
    FaceFlow flow = face_flow(node_at(face, face), node_at(face + 1, face), problem_.speed);
    for (double* value : {&flow.flow, &flow.couette, &flow.by_pressure[0], &flow.by_pressure[1]}) {
      *value *= width;
    }
    return flow;
  }

  double mass_at(Index cell) const {
    return liquid_at(problem_.liquid, pressure_[cell + 1], problem_.density).density *
           fill_[cell + 1] * problem_.film[cell + 1];
  }

  /// d(rho theta h)/dt times the volume of the cell.
  double storage(Index cell) const {
    if (problem_.time_step > 0) {
      return problem_.grid.volume[cell] * (mass_at(cell) - problem_.old_mass[cell]) /
             problem_.time_step;
    }
    if (problem_.squeeze.size() == 0) return 0;
    return problem_.grid.volume[cell] * problem_.squeeze[cell] * mass_at(cell) /
           problem_.film[cell + 1];
  }

  double storage_by_unknown(Index cell) const {
    const LiquidState liquid = liquid_at(problem_.liquid, pressure_[cell + 1], problem_.density);
    const double by_unknown =
        in_cavity(cell) ? liquid.density : liquid.density_slope * fill_[cell + 1];
    if (problem_.time_step > 0) {
      return problem_.grid.volume[cell] * problem_.film[cell + 1] * by_unknown / problem_.time_step;
    }
    if (problem_.squeeze.size() == 0) return 0;
    return problem_.grid.volume[cell] * problem_.squeeze[cell] * by_unknown;
  }

  double suction(Index cell) const {
    return std::min(0.0, pressure_[cell + 1] - problem_.cavitation_pressure);
  }

  Balance balance() const {
    Balance balance(n_);
    for (Index cell = 0; cell < n_; ++cell) {
      const double source = penalty_ * problem_.grid.volume[cell];
      balance.residual[cell] = storage(cell) + source * suction(cell);
      balance.diagonal[cell] = storage_by_unknown(cell) + (suction(cell) < 0 ? source : 0);
      balance.scale = std::max(balance.scale, std::abs(storage(cell)));
    }
    for (Index face = 0; face <= n_; ++face) add_face(face, balance);
    for (Index cell = 0; cell < n_; ++cell) {
      if (in_cavity(cell) && !conserves()) hold(cell, balance);
    }
    if (balance.scale == 0) balance.scale = 1;
    return balance;
  }

  /// In a Reynolds cavity the pressure is given and the balance is an inequality.
  static void hold(Index cell, Balance& balance) {
    balance.residual[cell] = 0;
    balance.lower[cell] = balance.upper[cell] = 0;
    balance.diagonal[cell] = 1;
  }

  void add_face(Index face, Balance& balance) const {
    const FaceFlow flow = flow_through(face);
    balance.scale = std::max(balance.scale, std::abs(flow.flow));
    for (int side = 0; side < 2; ++side) {
      balance.rounding = std::max(
          balance.rounding, kEpsilon * std::abs(flow.by_pressure[side] * pressure_[face + side]));
    }
    const bool upstream_is_left = problem_.speed >= 0;
    for (int side = 0; side < 2; ++side) {
      const Index cell = face - 1 + side;  // the cell of the node on that side
      if (cell < 0 || cell >= n_) continue;
      // The left cell loses what the right one gains.
      balance.residual[cell] += side == 0 ? flow.flow : -flow.flow;
      const double sign = side == 0 ? 1 : -1;
      for (int other = 0; other < 2; ++other) {
        const Index column = face - 1 + other;
        if (column < 0 || column >= n_) continue;
        const double by_fill = (other == 0) == upstream_is_left ? flow.couette : 0.0;
        const double value = sign * (in_cavity(column) ? by_fill : flow.by_pressure[other]);
        Eigen::ArrayXd& band =
            other == side ? balance.diagonal : (other > side ? balance.upper : balance.lower);
        band[cell] += value;
      }
    }
  }

  double& unknown(Index cell) {
    return in_cavity(cell) && conserves() ? fill_[cell + 1] : pressure_[cell + 1];
  }

  /// One Newton step, halved while it makes the balance worse.
  void advance(const Balance& before) {
    const Eigen::ArrayXd step = before.step();
    double share = 1;
    for (Index cell = 0; cell < n_; ++cell) unknown(cell) += step[cell];
    for (int i = 0; i < kMaxHalvings; ++i) {
      const double norm = balance().norm();
      if (norm <= before.norm() || before.error() <= before.tolerance()) return;
      share /= 2;
      for (Index cell = 0; cell < n_; ++cell) unknown(cell) -= share * step[cell];
    }
  }

  /// Moves cells into and out of the cavity; true if any did.
  bool move_cavity() {
    if (!has_cavity()) return false;
    const Eigen::ArrayXd demand = conserves() ? Eigen::ArrayXd() : liquid_demand();
    bool changed = false;
    for (Index cell = 0; cell < n_; ++cell) {
      const bool fills = conserves() ? fill_[cell + 1] > 1 : false;
      const bool should_be = in_cavity(cell) ? (conserves() ? !fills : demand[cell] >= 0)
                                             : pressure_[cell + 1] < problem_.cavitation_pressure;
      if (should_be == in_cavity(cell)) continue;
      changed = true;
      cavity_[static_cast<std::size_t>(cell)] = should_be;
      pressure_[cell + 1] = problem_.cavitation_pressure;
      fill_[cell + 1] = 1;
    }
    return changed;
  }

  /// What the cells of a Reynolds cavity lack to stay full: their balance without a pressure.
  Eigen::ArrayXd liquid_demand() const {
    Balance balance(n_);
    for (Index cell = 0; cell < n_; ++cell) balance.residual[cell] = storage(cell);
    for (Index face = 0; face <= n_; ++face) add_face(face, balance);
    return balance.residual + kEpsilon * balance.scale + balance.rounding;
  }

  FilmSolution finished(FilmSolution solution) const {
    solution.pressure = pressure_;
    solution.fill = fill_;
    solution.mass.resize(n_);
    solution.face_flow.resize(n_ + 1);
    for (Index cell = 0; cell < n_; ++cell) solution.mass[cell] = mass_at(cell);
    for (Index face = 0; face <= n_; ++face) solution.face_flow[face] = flow_through(face).flow;
    solution.load = (problem_.grid.volume * pressure_.segment(1, n_)).sum();
    return solution;
  }

  const FilmProblem& problem_;
  Index n_;
  Eigen::ArrayXd pressure_, fill_;
  std::vector<bool> cavity_;
  double penalty_ = 0;
};

}  // namespace

FilmSolution solve_film(const FilmProblem& problem) {
  check(problem);
  return FilmSolver(problem).solve();
}

}  // namespace tabor::reynolds
