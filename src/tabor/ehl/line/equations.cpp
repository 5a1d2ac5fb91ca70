#include "tabor/ehl/line/equations.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "tabor/ehl/line/inverse.hpp"
#include "tabor/numerics/gmres.hpp"
#include "tabor/reynolds/line/reynolds.hpp"

namespace tabor::ehl {
namespace {

constexpr double kLinearAccuracy = 1e-4;  // of each Newton correction
constexpr int kMaxProducts = 60;

/// The flow through the face between two nodes in the balances of both.
void add_face(LineLinear& linear, Index left, const reynolds::FaceFlow& face, double unit) {
  LineSystem& system = linear.system;
  LineBands* const bands[2] = {&system.by_pressure, &system.by_film};
  const double* const slopes[2] = {face.by_pressure, face.by_film};
  const double scales[2] = {system.units.pressure, system.units.film};
  for (int own = 0; own < 2; ++own) {
    const Index i = left + own;
    const double sign = own == 0 ? unit : -unit;  // the left node loses what the right one gains
    linear.residual[i] += sign * face.flow;
    for (int k = 0; k < 2; ++k) {
      Eigen::ArrayXd& other = own == 0 ? bands[k]->upper : bands[k]->lower;
      bands[k]->diagonal[i] += sign * slopes[k][own] * scales[k];
      other[i] += sign * slopes[k][1 - own] * scales[k];
    }
  }
}

}  // namespace

LineFilm::Equations::Equations(const LineFilm& film, const LineConditions& conditions,
                               const LineStorage& storage, LineState& state)
    : film_(film),
      conditions_(conditions),
      storage_(storage),
      state_(state),
      linear_(linearize()),
      cavity_before_(state.cavity) {
  outcome_.convergence.tolerance = kLineTolerance;
}

LineLinear LineFilm::Equations::linearize() const {
  const Index n = film_.n_;
  material::NodeLaws laws;
  material::evaluate(conditions_.lubricant, {state_.pressure.data(), static_cast<std::size_t>(n)},
                     laws);
  const auto node = [&](Index i) {
    return reynolds::FilmNode{.pressure = state_.pressure[i],
                              .film = state_.film[i],
                              .liquid = reynolds::liquid_at(laws, i),
                              .distance = film_.spacing_ / 2};
  };
  LineLinear linear{{&film_.elastic_, film_.units_, LineBands(n), LineBands(n)},
                    Eigen::VectorXd::Zero(n + 1)};
  LineBands& by_pressure = linear.system.by_pressure;
  LineBands& by_film = linear.system.by_film;
  const double unit = 1 / (film_.problem_.entrainment_speed * film_.units_.film);
  for (Index left = 0; left + 1 < n; ++left) {
    add_face(linear, left, reynolds::face_flow(node(left), node(left + 1), conditions_.speed),
             unit);
  }
  if (storage_.time_step > 0) {
    const double rate = unit * film_.spacing_ / storage_.time_step;
    linear.residual.head(n).array() += rate * (laws.density * state_.film - storage_.old_mass);
    by_film.diagonal += rate * laws.density * film_.units_.film;
    by_pressure.diagonal += rate * laws.density_by_pressure * state_.film * film_.units_.pressure;
  }
  if (film_.problem_.cavitation == LineCavitation::penalty) {
    const double strength = film_.problem_.penalty * film_.spacing_ / film_.units_.film;
    linear.residual.head(n).array() += strength * state_.pressure.min(0) / film_.units_.pressure;
    by_pressure.diagonal += strength * (state_.pressure < 0).cast<double>();
  }
  linear.load_residual() =
      (film_.elastic_.load_weight() * state_.pressure.sum() - film_.problem_.load) /
      film_.units_.load;
  if (touches()) add_touch(linear);
  return linear;
}

Eigen::VectorXd LineFilm::Equations::step() {
  cavity_before_ = state_.cavity;
  LineSystem system = linear_.system;
  system.hold(state_.cavity);
  Eigen::VectorXd right = -linear_.residual;
  for (Index i = 0; i < film_.n_; ++i) {
    if (state_.cavity[static_cast<std::size_t>(i)]) right[i] = 0;
  }
  if (film_.full_matrix_) return system.dense().partialPivLu().solve(right);
  const LineInverse inverse(system);
  if (!inverse.ok()) return {};
  const auto multiply = [&](const Eigen::VectorXd& step) { return system.product(step); };
  int& n_products = outcome_.convergence.operator_applications;
  return numerics::gmres(multiply, inverse, right, kLinearAccuracy, kMaxProducts, n_products)
      .value_or(Eigen::VectorXd());
}

double LineFilm::Equations::largest_share(const Eigen::VectorXd& step) const {
  return touches() ? share_before_touch(step) : 1;
}

/// False where the gap would close or a law would end. What falls below zero joins the cavity at
/// once.
bool LineFilm::Equations::move(const LineState& old, const Eigen::VectorXd& step, double share) {
  const Index n = film_.n_;
  const LineUnits& units = film_.units_;
  state_.pressure = old.pressure + share * units.pressure * step.head(n).array();
  state_.separation = old.separation + share * units.film * step[step.size() - 1];
  if (touches()) {
    state_.asperity_pressure =
        old.asperity_pressure + share * units.pressure * step.segment(n, n).array();
  }
  state_.cavity = old.cavity;
  for (Index k = 0; film_.problem_.cavitation == LineCavitation::reynolds && k < n; ++k) {
    if (state_.pressure[k] >= 0) continue;
    state_.cavity[static_cast<std::size_t>(k)] = true;
    state_.pressure[k] = 0;
  }
  state_.film = film_.film_of(state_, conditions_.shape);
  const material::PressureRange range = material::computable_range(conditions_.lubricant);
  return is_open(old) && range.contains(state_.pressure.maxCoeff()) &&
         range.contains(state_.pressure.minCoeff());
}

bool LineFilm::Equations::settle() {
  linear_ = linearize();
  const bool grows = state_.cavity != cavity_before_;
  const bool shrinks = refill();
  // A front that retreats node by node is made to go two at once; more would overshoot.
  reach_ = shrinks && !grows ? 2 : 1;
  return !grows && !shrinks;
}

/// Nodes of the cavity that gain liquid leave it, with those behind them within reach; true if
/// there are any. The ends stay.
bool LineFilm::Equations::refill() {
  const double surplus = kLineTolerance * film_.film_scale_ / film_.units_.film;
  Index last = -1;
  bool changed = false;
  for (Index i = 1; i + 1 < film_.n_; ++i) {
    if (!state_.cavity[static_cast<std::size_t>(i)]) continue;
    if (linear_.residual[i] < -surplus) last = i + reach_ - 1;
    if (i > last) continue;
    state_.cavity[static_cast<std::size_t>(i)] = false;
    changed = true;
  }
  return changed;
}

bool LineFilm::Equations::measure() {
  outcome_.mass_error = mass_error();
  outcome_.load_error = std::abs(linear_.load_residual());
  if (touches()) outcome_.contact_error = overlap_products().maxCoeff();
  outcome_.convergence.certificate = outcome_.mass_error;
  return is_balanced();
}

double LineFilm::Equations::mass_error() const {
  double imbalance = 0;
  for (Index i = 0; i < film_.n_; ++i) {
    if (state_.cavity[static_cast<std::size_t>(i)]) continue;
    imbalance = std::max(imbalance, std::abs(linear_.residual[i]));
  }
  return imbalance * film_.units_.film / film_.film_scale_;
}

}  // namespace tabor::ehl
