#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "tabor/ehl/point/balance.hpp"
#include "tabor/ehl/point/levels.hpp"

// Solves the linear equations of one Newton step of a point contact.
namespace tabor::ehl {

/// The linear equations of one Newton step of a point contact: a row per node, bordered by the
/// separation as last unknown and the load as last row. Masks have shape (ny, nx).
struct PointLinear {
  PointBalance rows;  ///< residuals and derivatives
  Mask held;          ///< nodes at which nothing is unknown
  Mask deep;          ///< nodes whose unknown is a depth, their pressure being given
  double load = 0;    ///< (load carried - load) over its unit

  Mask pressed() const { return !held && !deep; }  ///< nodes whose pressure is unknown
};

/// Nearly inverts the rows of the nodes: residuals in, unknowns out.
using PointInverse = std::function<Field(const Field&)>;

/// Unknowns of all nodes and, last, the separation, each in its unit, by GMRES with the whole
/// elastic kernel of the film's own grid, `finest`; none if it does not get there. `n_products`
/// grows by the products with it.
std::optional<Eigen::VectorXd> solve_bordered(const PointLinear& linear, const PointLevel& finest,
                                              const PointUnits& units, const PointInverse& inverse,
                                              int& n_products);

}  // namespace tabor::ehl
