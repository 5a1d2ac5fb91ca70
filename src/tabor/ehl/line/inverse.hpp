#pragma once

#include <Eigen/Core>
#include <vector>

#include "tabor/ehl/line/system.hpp"
#include "tabor/numerics/banded_lu.hpp"

namespace tabor::ehl {

/// Nearly inverts a LineSystem in O(n). Deflection stands in differential form (Evans & Hughes
/// 2000): h_(i-1) - 2 h_i + h_(i+1) = sum g_k p_(i-k), with P beside p where solids touch. The
/// kernel g_k, which decays only as 1/k^2, is exact at k = 0 and 1 and beyond that a sum of
/// exponentials, each of which solves a difference equation of its own; nothing is cut off, and all
/// unknowns of a node together make a band. The values of h at both ends and the load are exact
/// rows outside the band.
class LineInverse {
 public:
  explicit LineInverse(const LineSystem& system);

  bool ok() const { return ok_; }  ///< false: singular
  /// A right side in, unknowns out.
  Eigen::VectorXd operator()(const Eigen::VectorXd& right) const;

 private:
  void add_elastic_rows(Index node);
  void add_film_rows(const LineSystem& system, Index node);
  void add_touch_row(const TouchRows& touch, Index node);
  Eigen::VectorXd solve_band(const Eigen::VectorXd& right) const;
  Eigen::VectorXd unit_film_at(Index node) const;
  Eigen::VectorXd totals(const Eigen::VectorXd& pressures) const;

  Index n_;
  bool has_asperities_;
  std::vector<double> decay_;      // lambda of each exponential
  std::vector<double> weight_;     // of each exponential in g
  double central_ = 0, next_ = 0;  // what the exponentials lack at k = 0 and 1
  Index block_;                    // unknowns per node: one per exponential, P if any, p, h
  numerics::BandedLu band_;
  Eigen::VectorXd end_row_;  // h at the first node by p
  double load_weight_;
  bool ok_ = false;
  Eigen::VectorXd by_first_, by_last_;  // p and P from a unit of h at the ends
  Eigen::Matrix3d border_;              // of h at both ends and h0
};

}  // namespace tabor::ehl
