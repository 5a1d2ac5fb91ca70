#pragma once

#include <Eigen/Core>
#include <vector>

#include "tabor/elastic/line.hpp"

// Solves the linear equations of one Newton step of a line contact.
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

/// One equation per node for the pressure P of asperities: a dh + b dP = s.
struct TouchRows {
  Eigen::ArrayXd by_film, by_pressure;  ///< a, b; empty: nothing can touch
};

/// The linear equations of one Newton step of a line contact, in the units given:
///
///   A p + B h = r ,   h = h0 + K (p + P) ,   load_weight sum (p + P) = f
///
/// with bands A and B and the dense elastic matrix K. Where solids can touch, each node has a
/// TouchRow for its P. The unknowns are p (n), then P (n) if there are such rows, then h0; the
/// right side r, s, f likewise.
struct LineSystem {
  const elastic::LineHalfSpace* elastic;
  LineUnits units;
  LineBands by_pressure, by_film;  ///< A, B
  TouchRows touch = {};

  Index n() const { return elastic->size(); }
  bool has_asperities() const { return touch.by_film.size() > 0; }
  Index size() const { return (has_asperities() ? 2 : 1) * n() + 1; }

  /// Makes p itself the left side of the rows of these nodes.
  void hold(const std::vector<bool>& held);
  /// Matrix times unknowns, with the whole elastic kernel, by transforms.
  Eigen::VectorXd product(const Eigen::VectorXd& unknowns) const;
  /// The matrix, shape (size, size).
  Eigen::MatrixXd dense() const;
};

}  // namespace tabor::ehl
