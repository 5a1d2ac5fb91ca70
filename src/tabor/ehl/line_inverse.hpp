#pragma once

#include <Eigen/Core>
#include <vector>

#include "tabor/ehl/banded_lu.hpp"
#include "tabor/elastic/line.hpp"

namespace tabor::ehl {

/// Three bands of a matrix: lower[i] multiplies x[i - 1], upper[i] multiplies x[i + 1].
struct LineBands {
  Eigen::ArrayXd lower, diagonal, upper;

  explicit LineBands(Index n) : lower(Eigen::ArrayXd::Zero(n)), diagonal(lower), upper(lower) {}
  Eigen::ArrayXd product(const Eigen::ArrayXd& x) const;
};

/// Units of the unknowns, which make them numbers of order one.
struct LineUnits {
  double pressure = 1;  ///< [Pa]
  double film = 1;      ///< [m]
  double load = 1;      ///< [N/m]
};

/// Nearly inverts, in O(n), the linear equations of one Newton step of a line contact,
///
///   A p + B h = r ,   h = h0 + K p ,   load_weight sum p = f
///
/// with bands A and B and the dense elastic matrix K; all in the units given. Deflection stands in
/// differential form (Evans & Hughes 2000): h_(i-1) - 2 h_i + h_(i+1) = sum g_k p_(i-k). The kernel
/// g_k, which decays only as 1/k^2, is exact at k = 0 and 1 and beyond that a sum of exponentials,
/// each of which solves a difference equation of its own; nothing is cut off, and all unknowns of a
/// node together make a band. The values of h at both ends and the load are exact rows outside the
/// band.
class LineInverse {
 public:
  LineInverse(const elastic::LineHalfSpace& elastic, const LineUnits& units,
              const LineBands& by_pressure, const LineBands& by_film);

  bool ok() const { return ok_; }  ///< false: singular
  /// r (n) and f in, p (n) and h0 out.
  Eigen::VectorXd operator()(const Eigen::VectorXd& right) const;

 private:
  void add_elastic_rows(Index node);
  Eigen::VectorXd solve_band(const Eigen::VectorXd& by_node, Index place_in_node) const;

  Index n_;
  std::vector<double> decay_;      // lambda of each exponential
  std::vector<double> weight_;     // of each exponential in g
  double central_ = 0, next_ = 0;  // what the exponentials lack at k = 0 and 1
  Index block_;                    // unknowns per node: one per exponential, p, h
  BandedLu band_;
  Eigen::VectorXd end_row_;  // h at the first node by p
  double load_weight_;
  bool ok_ = false;
  Eigen::VectorXd by_first_, by_last_;  // pressures from a unit of h at the ends
  Eigen::Matrix3d border_;              // of h at both ends and h0
};

}  // namespace tabor::ehl
