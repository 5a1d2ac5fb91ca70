#include "tabor/ehl/impact/ball_film.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "tabor/numerics/newton.hpp"

namespace tabor::ehl {

namespace {

constexpr int kMaxNewton = 25;
constexpr double kLinearAccuracy = 1e-2;  // of each Newton correction
constexpr int kMaxHalvings = 6;
constexpr double kThinnest = 0.1;       // a step may leave this much of the thinnest film
constexpr double kTinyPressure = 1e-3;  // [Pa]: less than this is no pressure

/// Three bands: lower[i] multiplies x[i - 1], upper[i] multiplies x[i + 1].
struct Bands {
  Eigen::ArrayXd lower, diagonal, upper;

  explicit Bands(Index n) : lower(Eigen::ArrayXd::Zero(n)), diagonal(lower), upper(lower) {}

  void clear_row(Index i) { lower[i] = diagonal[i] = upper[i] = 0; }

  /// y += bands x; x has one value more than there are rows, or as many.
  void add_product(const Eigen::VectorXd& x, Eigen::Ref<Eigen::ArrayXd> y) const {
    const Index n = diagonal.size();
    y += diagonal * x.head(n).array();
    y.tail(n - 1) += lower.tail(n - 1) * x.head(n - 1).array();
    const Index m = std::min(n, x.size() - 1);
    y.head(m) += upper.head(m) * x.segment(1, m).array();
  }
};

/// Weights of rho h now, one and two steps ago in its time derivative, times the step.
struct BackwardDifference {
  double now = 1, one_ago = 1, two_ago = 0;

  static BackwardDifference second_order(double step, double step_before) {
    const double ratio = step / step_before;
    return {(1 + 2 * ratio) / (1 + ratio), 1 + ratio, ratio * ratio / (1 + ratio)};
  }
};

}  // namespace

Eigen::ArrayXd film_of(const BallFilm& ball, double separation, const Eigen::ArrayXd& pressure) {
  return ball.shape + separation + (ball.compliance * pressure.matrix()).array();
}

BallState completed(const BallFilm& ball, BallState state) {
  const Index n = ball.grid.n_cells();
  state.force = (ball.grid.volume * state.pressure).sum();
  state.film = film_of(ball, state.separation, state.pressure);
  state.film_mass.resize(n);
  for (Index i = 0; i < n; ++i) {
    state.film_mass[i] = ball.lubricant.density.at(state.pressure[i]).value * state.film[i];
  }
  return state;
}

/// The equations of one step and their linearization at the present iterate.
struct BallStepper::Trial {
  const BallFilm& ball;
  const BallState& now;
  double time_step;
  Index n;
  Eigen::ArrayXd old_mass;  // what rho h is compared with, BDF weights included [m]
  double mass_weight;       // BDF weight of the new rho h
  BallState state;
  Eigen::ArrayXd predicted_pressure;
  std::vector<bool> cavity;
  // Linearization; rows of the balances are lengths in units of the layer.
  Eigen::VectorXd residual;  // n + 1: balances, motion
  Bands by_pressure, by_film;
  material::NodeLaws laws;

  Trial(const BallFilm& ball_film, const BallState& state_now, const BallState* before, double step)
      : ball(ball_film),
        now(state_now),
        time_step(step),
        n(ball_film.grid.n_cells()),
        cavity(static_cast<std::size_t>(n), false),
        residual(n + 1),
        by_pressure(n),
        by_film(n) {
    const BackwardDifference difference =
        before ? BackwardDifference::second_order(step, now.time - before->time)
               : BackwardDifference{};
    mass_weight = difference.now;
    old_mass = difference.one_ago * now.film_mass;
    if (before) old_mass -= difference.two_ago * before->film_mass;
    predict(before);
    predicted_pressure = state.pressure;
  }

  bool in_cavity(Index i) const { return cavity[static_cast<std::size_t>(i)]; }

  /// First guess: the trend of the last step goes on.
  void predict(const BallState* before) {
    state.pressure = now.pressure;
    state.separation = now.separation + time_step * now.speed;
    if (before) {
      const double ratio = time_step / (now.time - before->time);
      state.pressure = (now.pressure + ratio * (now.pressure - before->pressure)).max(0);
      const double acceleration = (now.speed - before->speed) / (now.time - before->time);
      state.separation += acceleration * time_step * time_step / 2;
    }
    for (Index i = 0; i < n; ++i) {
      cavity[static_cast<std::size_t>(i)] = now.pressure[i] <= 0 && before != nullptr;
      if (in_cavity(i)) state.pressure[i] = 0;
    }
    state.film = film_of(ball, state.separation, state.pressure);
    if (state.film.minCoeff() <= 0) {  // the trend would close the gap: start where we are
      state.pressure = now.pressure;
      state.separation = now.separation;
      state.film = now.film;
    }
  }

  void evaluate_laws() {
    // The node at the edge is outside the film: p = 0 there.
    std::vector<double> pressure(state.pressure.data(), state.pressure.data() + n);
    pressure.push_back(0);
    material::evaluate(ball.lubricant, pressure, laws);
  }

  reynolds::FilmNode node_at(Index i, Index face) const {
    return {.pressure = i < n ? state.pressure[i] : 0.0,
            .film = state.film[i],
            .liquid = reynolds::liquid_at(laws, i),
            .distance = std::abs(ball.grid.face[face] - ball.grid.node[i + 1])};
  }

  /// Balances of all cells; those of the cavity are left in `residual` too, as what they lack.
  void linearize() {
    evaluate_laws();
    by_pressure = Bands(n);
    by_film = Bands(n);
    residual.setZero();
    for (Index face = 1; face <= n; ++face) add_face(face);
    for (Index i = 0; i < n; ++i) add_storage(i);
    residual[n] = motion() / ball.length_scale;
  }

  /// Face f lies between the nodes f - 1 and f (counted from the centre).
  void add_face(Index face) {
    const reynolds::FaceFlow flow =
        reynolds::face_flow(node_at(face - 1, face), node_at(face, face), 0);
    for (Index cell = face - 1; cell <= std::min(face, n - 1); ++cell) {
      const double sign = cell < face ? 1 : -1;
      const double unit =
          sign * ball.grid.width[face] * time_step / (ball.grid.volume[cell] * ball.length_scale);
      residual[cell] += unit * flow.flow;
      const bool is_left = cell < face;
      by_pressure.diagonal[cell] += unit * flow.by_pressure[is_left ? 0 : 1];
      by_film.diagonal[cell] += unit * flow.by_film[is_left ? 0 : 1];
      Bands* const bands[2] = {&by_pressure, &by_film};
      const double other[2] = {flow.by_pressure[is_left ? 1 : 0], flow.by_film[is_left ? 1 : 0]};
      for (int k = 0; k < 2; ++k) {
        (is_left ? bands[k]->upper : bands[k]->lower)[cell] += unit * other[k];
      }
    }
  }

  void add_storage(Index i) {
    residual[i] +=
        (mass_weight * laws.density[i] * state.film[i] - old_mass[i]) / ball.length_scale;
    const double unit = mass_weight / ball.length_scale;
    by_pressure.diagonal[i] += unit * laws.density_by_pressure[i] * state.film[i];
    by_film.diagonal[i] += unit * laws.density[i];
  }

  /// h0 after the step less what the trapezoidal rule says it is [m].
  double motion() const {
    const double force = (ball.grid.volume * state.pressure).sum();
    return state.separation - now.separation - time_step * now.speed +
           time_step * time_step * (ball.gravity / 2 - (force + now.force) / (4 * ball.mass));
  }

  /// Cells whose pressure fell below zero join the cavity; true if there are any.
  bool drop_suction() {
    bool changed = false;
    for (Index i = 0; i < n; ++i) {
      if (state.pressure[i] >= 0) continue;
      cavity[static_cast<std::size_t>(i)] = true;
      state.pressure[i] = 0;
      changed = true;
    }
    return changed;
  }

  /// Cells of the cavity that gain liquid leave it; true if there are any.
  bool refill() {
    bool changed = false;
    for (Index i = 0; i < n; ++i) {
      if (!in_cavity(i) || residual[i] >= -kBallTolerance) continue;
      cavity[static_cast<std::size_t>(i)] = false;
      changed = true;
    }
    return changed;
  }

  Eigen::VectorXd right_hand_side() const {
    Eigen::VectorXd right = -residual;
    for (Index i = 0; i < n; ++i) {
      if (in_cavity(i)) right[i] = 0;
    }
    return right;
  }

  /// Largest residual of the equations in force, the motion included.
  double error() const { return right_hand_side().lpNorm<Eigen::Infinity>(); }

  /// The unknowns are p / pressure_scale and h0 / length_scale.
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
    const Eigen::VectorXd pressure = ball.pressure_scale * x.head(n);
    Eigen::VectorXd film = ball.compliance * pressure;
    film.array() += ball.length_scale * x[n];
    Eigen::ArrayXd product = Eigen::ArrayXd::Zero(n);
    by_pressure.add_product(pressure, product);
    by_film.add_product(film, product);
    y.resize(n + 1);
    for (Index i = 0; i < n; ++i) y[i] = in_cavity(i) ? x[i] : product[i];
    y[n] = x[n] - force_share() * (ball.grid.volume * pressure.array()).sum();
  }

  double force_share() const { return time_step * time_step / (4 * ball.mass * ball.length_scale); }

  void assemble(Eigen::MatrixXd& matrix) const {
    const Eigen::MatrixXd& d = ball.compliance;
    for (Index i = 0; i < n; ++i) {
      if (in_cavity(i)) {
        matrix(i, i) = 1;
        continue;
      }
      auto row = matrix.row(i);
      row.head(n) = by_film.diagonal[i] * d.row(i) + by_film.upper[i] * d.row(i + 1);
      if (i > 0) row.head(n) += by_film.lower[i] * d.row(i - 1);
      row[i] += by_pressure.diagonal[i];
      if (i > 0) row[i - 1] += by_pressure.lower[i];
      if (i + 1 < n) row[i + 1] += by_pressure.upper[i];
      row.head(n) *= ball.pressure_scale;
      row[n] = ball.length_scale * (by_film.lower[i] + by_film.diagonal[i] + by_film.upper[i]);
    }
    matrix.row(n).head(n) = -force_share() * ball.pressure_scale * ball.grid.volume.matrix();
    matrix(n, n) = 1;
  }
};

/// The same for Newton's method.
struct BallStepper::Equations {
  Trial& trial;
  numerics::LaggedFactorisation& solver;
  Convergence account;

  BallState& state() { return trial.state; }
  Convergence& convergence() { return account; }

  Eigen::VectorXd step() {
    return solver.solve(
        trial.right_hand_side(), kLinearAccuracy,
        [&](const Eigen::VectorXd& in, Eigen::VectorXd& out) { trial.multiply(in, out); },
        [&](Eigen::MatrixXd& matrix) { trial.assemble(matrix); });
  }
  double largest_share(const Eigen::VectorXd&) const { return 1; }

  /// False where the gap would close or a law would end.
  bool move(const BallState& old, const Eigen::VectorXd& step, double share) {
    const BallFilm& ball = trial.ball;
    BallState& state = trial.state;
    state.pressure = old.pressure + share * ball.pressure_scale * step.head(trial.n).array();
    state.separation = old.separation + share * ball.length_scale * step[trial.n];
    state.film = film_of(ball, state.separation, state.pressure.max(0));
    const double floor = kThinnest * std::min(old.film.minCoeff(), trial.now.film.minCoeff());
    return state.film.minCoeff() > floor &&
           state.pressure.maxCoeff() < material::computable_range(ball.lubricant).highest;
  }

  bool settle() {
    const bool grows = trial.drop_suction();
    trial.linearize();
    const bool shrinks = trial.refill();
    return !grows && !shrinks;
  }

  bool measure() {
    account.certificate = trial.error();
    return account.certificate <= kBallTolerance;
  }
};

BallStepper::BallStepper(const BallFilm& ball, bool refactor_always)
    : ball_(ball), solver_(refactor_always) {}

StepCount BallStepper::count() const {
  return {newton_iterations_, solver_.n_factorisations(), solver_.n_products()};
}

std::optional<BallState> BallStepper::step(const BallState& now, const BallState* before,
                                           double time_step) {
  Trial trial(ball_, now, before, time_step);
  trial.linearize();
  Equations equations{trial, solver_, {.certificate = error_, .tolerance = kBallTolerance}};
  numerics::newton(equations, {.max_iterations = kMaxNewton, .max_halvings = kMaxHalvings});
  newton_iterations_ += equations.account.iterations;
  error_ = equations.account.certificate;
  if (!equations.account.converged()) return std::nullopt;
  prediction_error_ = (trial.state.pressure - trial.predicted_pressure).abs().maxCoeff() /
                      std::max(trial.state.pressure.maxCoeff(), kTinyPressure);
  BallState state = completed(ball_, std::move(trial.state));
  state.time = now.time + time_step;
  state.speed = 2 * (state.separation - now.separation) / time_step - now.speed;
  return state;
}

}  // namespace tabor::ehl
