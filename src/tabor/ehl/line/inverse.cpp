#include "tabor/ehl/line/inverse.hpp"

#include <Eigen/LU>

#include <cmath>

namespace tabor::ehl {
namespace {

// 1/k^2 is the integral of e^(2 s) exp(-k e^s) over s; the trapezoidal rule with this step is
// within 4 % of it, which leaves GMRES a handful of products.
constexpr double kStep = 1.5;
constexpr double kLargestDecay = 2.5;
constexpr double kSmallestDecay = 0.3;  // over the number of nodes

std::vector<double> decays(Index n) {
  std::vector<double> result;
  const double smallest = kSmallestDecay / static_cast<double>(n);
  double decay = kLargestDecay;
  while (decay > smallest) {
    result.push_back(decay);
    decay *= std::exp(-kStep);
  }
  return result;
}

}  // namespace

LineInverse::LineInverse(const LineSystem& system)
    : n_(system.n()),
      has_asperities_(system.has_asperities()),
      decay_(decays(n_)),
      block_(static_cast<Index>(decay_.size()) + (has_asperities_ ? 3 : 2)),
      band_(n_ * block_, block_ + (has_asperities_ ? 2 : 1), block_ + 1),
      end_row_(n_),
      load_weight_(system.elastic->load_weight() * system.units.pressure / system.units.load) {
  // g_k tends to second_difference(far) far^2 / k^2.
  const elastic::LineHalfSpace& elastic = *system.elastic;
  const double far = static_cast<double>(n_ - 1);
  const double unit = system.units.pressure / system.units.film;
  const double strength = unit * elastic.second_difference(n_ - 1) * far * far;
  central_ = unit * elastic.second_difference(0);
  next_ = unit * elastic.second_difference(1);
  for (const double decay : decay_) {
    weight_.push_back(strength * kStep * decay * decay);
    central_ -= weight_.back();
    next_ -= weight_.back() * std::exp(-decay);
  }
  for (Index i = 0; i < n_; ++i) {
    add_elastic_rows(i);
    add_film_rows(system, i);
    if (has_asperities_) add_touch_row(system.touch, i);
    end_row_[i] = unit * elastic.influence(i);
  }
  if (!band_.factorise()) return;
  by_first_ = solve_band(unit_film_at(0));
  by_last_ = solve_band(unit_film_at(n_ - 1));
  const Eigen::VectorXd first = totals(by_first_);
  const Eigen::VectorXd last = totals(by_last_);
  const Eigen::VectorXd last_row = end_row_.reverse();
  border_ << 1 - end_row_.dot(first), -end_row_.dot(last), -1,  //
      -last_row.dot(first), 1 - last_row.dot(last), -1,         //
      load_weight_ * first.sum(), load_weight_ * last.sum(), 0;
  ok_ = by_first_.allFinite() && by_last_.allFinite();
}

void LineInverse::add_film_rows(const LineSystem& system, Index node) {
  const Index p = node * block_ + block_ - 2;
  const LineBands* const bands[2] = {&system.by_pressure, &system.by_film};
  for (Index k = 0; k < 2; ++k) {
    band_.at(p, p + k) += bands[k]->diagonal[node];
    if (node > 0) band_.at(p, p + k - block_) += bands[k]->lower[node];
    if (node + 1 < n_) band_.at(p, p + k + block_) += bands[k]->upper[node];
  }
}

void LineInverse::add_touch_row(const TouchRows& touch, Index node) {
  const Index p = node * block_ + block_ - 2;
  band_.at(p - 1, p - 1) = touch.by_pressure[node];
  band_.at(p - 1, p + 1) = touch.by_film[node];
}

void LineInverse::add_elastic_rows(Index node) {
  const Index first = node * block_;
  const Index p = first + block_ - 2;
  const Index h = p + 1;
  const Index first_pressure = has_asperities_ ? p - 1 : p;
  const bool is_end = node == 0 || node + 1 == n_;
  // q = sum over j of exp(-decay |i - j|) p_j; beyond the ends it goes on decaying.
  for (std::size_t m = 0; m < decay_.size(); ++m) {
    const Index q = first + static_cast<Index>(m);
    const double scale = 1 / (2 * std::cosh(decay_[m]));
    band_.at(q, q) = is_end ? std::exp(decay_[m]) * scale : 1;
    if (node > 0) band_.at(q, q - block_) = -scale;
    if (node + 1 < n_) band_.at(q, q + block_) = -scale;
    for (Index k = first_pressure; k <= p; ++k) band_.at(q, k) = -2 * std::sinh(decay_[m]) * scale;
    if (!is_end) band_.at(h, q) = -weight_[m];
  }
  band_.at(h, h) = is_end ? 1 : -2;
  if (is_end) return;
  for (Index k = first_pressure; k <= p; ++k) {
    band_.at(h, k) = -central_;
    for (const Index side : {-block_, block_}) band_.at(h, k + side) = -next_;
  }
  for (const Index side : {-block_, block_}) band_.at(h, h + side) = 1;
}

Eigen::VectorXd LineInverse::unit_film_at(Index node) const {
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n_ * block_);
  right[node * block_ + block_ - 1] = 1;
  return right;
}

/// The pressures p, and P behind them, that solve the band with this right side.
Eigen::VectorXd LineInverse::solve_band(const Eigen::VectorXd& right) const {
  Eigen::VectorXd all = right;
  band_.solve(all.data());
  Eigen::VectorXd pressures(has_asperities_ ? 2 * n_ : n_);
  for (Index i = 0; i < n_; ++i) {
    const Index p = i * block_ + block_ - 2;
    pressures[i] = all[p];
    if (has_asperities_) pressures[n_ + i] = all[p - 1];
  }
  return pressures;
}

/// p + P.
Eigen::VectorXd LineInverse::totals(const Eigen::VectorXd& pressures) const {
  Eigen::VectorXd total = pressures.head(n_);
  if (has_asperities_) total += pressures.tail(n_);
  return total;
}

Eigen::VectorXd LineInverse::operator()(const Eigen::VectorXd& right) const {
  Eigen::VectorXd rows = Eigen::VectorXd::Zero(n_ * block_);
  for (Index i = 0; i < n_; ++i) {
    const Index p = i * block_ + block_ - 2;
    rows[p] = right[i];
    if (has_asperities_) rows[p - 1] = right[n_ + i];
  }
  const Eigen::VectorXd given = solve_band(rows);
  const Eigen::VectorXd total = totals(given);
  const Index h0 = right.size() - 1;
  const Eigen::Vector3d lacking(end_row_.dot(total), end_row_.reverse().dot(total),
                                right[h0] - load_weight_ * total.sum());
  const Eigen::Vector3d ends = border_.partialPivLu().solve(lacking);
  Eigen::VectorXd result(h0 + 1);
  result << given + ends[0] * by_first_ + ends[1] * by_last_, ends[2];
  return result;
}

}  // namespace tabor::ehl
