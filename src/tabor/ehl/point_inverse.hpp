#pragma once

#include <Eigen/SparseLU>

#include "tabor/ehl/point_balance.hpp"

namespace tabor::ehl {

/// Love's coefficients of a grid in units of film over pressure, by distance in nodes.
using PointInfluence = Field;
inline constexpr Index kPointReach = 12;  ///< of what the inverse knows of them

/// Nearly inverts the linear equations of one Newton step of a point contact.
class PointInverse {
 public:
  PointInverse(const PointBalance& balance, const Mask& held, const PointInfluence& influence);

  bool ok() const { return ok_; }
  /// Residuals of the nodes in, pressures out; held nodes keep theirs.
  Field operator()(const Field& right) const;

 private:
  Mask held_;
  Eigen::Array<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> number_;  // -1: held
  Eigen::SparseLU<Eigen::SparseMatrix<double>> factors_;
  Index n_ = 0;
  bool ok_ = false;
};

}  // namespace tabor::ehl
