#include "tabor/ehl/line_inverse.hpp"

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

Eigen::ArrayXd LineBands::product(const Eigen::ArrayXd& x) const {
  const Index n = x.size();
  Eigen::ArrayXd y = diagonal * x;
  y.tail(n - 1) += lower.tail(n - 1) * x.head(n - 1);
  y.head(n - 1) += upper.head(n - 1) * x.tail(n - 1);
  return y;
}

LineInverse::LineInverse(const elastic::LineHalfSpace& elastic, const LineUnits& units,
                         const LineBands& by_pressure, const LineBands& by_film)
    : n_(elastic.size()),
      decay_(decays(n_)),
      block_(static_cast<Index>(decay_.size()) + 2),
      band_(n_ * block_, block_ + 1, block_ + 1),
      end_row_(n_),
      load_weight_(elastic.load_weight() * units.pressure / units.load) {
  // g_k tends to second_difference(far) far^2 / k^2.
  const double far = static_cast<double>(n_ - 1);
  const double unit = units.pressure / units.film;
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
    end_row_[i] = unit * elastic.influence(i);
    const Index p = i * block_ + block_ - 2;
    const LineBands* const bands[2] = {&by_pressure, &by_film};
    for (Index k = 0; k < 2; ++k) {
      band_.at(p, p + k) += bands[k]->diagonal[i];
      if (i > 0) band_.at(p, p + k - block_) += bands[k]->lower[i];
      if (i + 1 < n_) band_.at(p, p + k + block_) += bands[k]->upper[i];
    }
  }
  if (!band_.factorize()) return;
  Eigen::VectorXd one = Eigen::VectorXd::Zero(n_);
  one[0] = 1;
  by_first_ = solve_band(one, block_ - 1);
  by_last_ = solve_band(one.reverse(), block_ - 1);
  const Eigen::VectorXd last_row = end_row_.reverse();
  border_ << 1 - end_row_.dot(by_first_), -end_row_.dot(by_last_), -1,  //
      -last_row.dot(by_first_), 1 - last_row.dot(by_last_), -1,         //
      load_weight_ * by_first_.sum(), load_weight_ * by_last_.sum(), 0;
  ok_ = by_first_.allFinite() && by_last_.allFinite();
}

void LineInverse::add_elastic_rows(Index node) {
  const Index first = node * block_;
  const Index p = first + block_ - 2;
  const Index h = p + 1;
  const bool is_end = node == 0 || node + 1 == n_;
  // q = sum over j of exp(-decay |i - j|) p_j; beyond the ends it goes on decaying.
  for (std::size_t m = 0; m < decay_.size(); ++m) {
    const Index q = first + static_cast<Index>(m);
    const double scale = 1 / (2 * std::cosh(decay_[m]));
    band_.at(q, q) = is_end ? std::exp(decay_[m]) * scale : 1;
    if (node > 0) band_.at(q, q - block_) = -scale;
    if (node + 1 < n_) band_.at(q, q + block_) = -scale;
    band_.at(q, p) = -2 * std::sinh(decay_[m]) * scale;
    if (!is_end) band_.at(h, q) = -weight_[m];
  }
  band_.at(h, h) = is_end ? 1 : -2;
  if (is_end) return;
  band_.at(h, p) = -central_;
  for (const Index side : {-block_, block_}) {
    band_.at(h, h + side) = 1;
    band_.at(h, p + side) = -next_;
  }
}

Eigen::VectorXd LineInverse::solve_band(const Eigen::VectorXd& by_node, Index place_in_node) const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(n_ * block_);
  for (Index i = 0; i < n_; ++i) all[i * block_ + place_in_node] = by_node[i];
  band_.solve(all.data());
  Eigen::VectorXd pressure(n_);
  for (Index i = 0; i < n_; ++i) pressure[i] = all[i * block_ + block_ - 2];
  return pressure;
}

Eigen::VectorXd LineInverse::operator()(const Eigen::VectorXd& right) const {
  const Eigen::VectorXd given = solve_band(right.head(n_), block_ - 2);
  const Eigen::Vector3d lacking(end_row_.dot(given), end_row_.reverse().dot(given),
                                right[n_] - load_weight_ * given.sum());
  const Eigen::Vector3d ends = border_.partialPivLu().solve(lacking);
  Eigen::VectorXd result(n_ + 1);
  result << given + ends[0] * by_first_ + ends[1] * by_last_, ends[2];
  return result;
}

}  // namespace tabor::ehl
