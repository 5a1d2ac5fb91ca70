#pragma once

#include <Eigen/Core>
#include <span>

#include "tabor/core/types.hpp"
#include "tabor/elastic/pressure_shape.hpp"

// Computes the displacement of an elastic half-space under a pressure that depends on the radius
// only.
namespace tabor::elastic {

/// Returns the displacement [m/Pa] at radius r [m] of an elastic half-space under a unit pressure
/// on the disc of radius c [m], measured from infinity (Johnson 1985, eqs. 3.29 and following).
double disc_displacement(double r, double c, double effective_modulus);

/// Returns n radii [m] from 0 to r_max, equally spaced.
Eigen::ArrayXd uniform_radii(Index n, double r_max);
/// Returns n radii [m] from 0 to r_max whose spacing grows in geometric progression, the last one
/// `spacing_ratio` times the first; 1 is uniform. n >= 3, r_max > 0, ratio > 0, else InputError.
Eigen::ArrayXd graded_radii(Index n, double r_max, double spacing_ratio);

/// Returns the n + 1 edges [m] of the rings around n radii: 0, midway between neighbours, and the
/// last radius. They are also the faces of finite volumes on these nodes.
Eigen::ArrayXd ring_edges(const Eigen::ArrayXd& radii);

/// Half-space under a pressure that varies with the radius only: u = matrix p at the nodes, u
/// measured from infinity. The matrix is dense and held: profiles have some hundred nodes, and the
/// solvers' Jacobians need it whole. Not symmetric, because nodes stand for rings of unequal area;
/// so this is no ElasticOperator.
class AxisymmetricHalfSpace {
 public:
  /// Computes the matrix. radii [m]: from 0, strictly increasing, at least 3; effective_modulus E*
  /// [Pa] > 0; else throws InputError. Beyond the last radius the pressure is zero.
  AxisymmetricHalfSpace(Eigen::ArrayXd radii, double effective_modulus,
                        PressureShape shape = PressureShape::uniform);

  Index size() const { return radii_.size(); }
  const Eigen::ArrayXd& radii() const { return radii_; }           ///< [m]
  double effective_modulus() const { return effective_modulus_; }  ///< E* [Pa]

  /// [m/Pa], shape (n, n), rows contiguous.
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Matrix& matrix() const { return matrix_; }

  /// Computes displacement [m] = matrix pressure [Pa]; spans of n values, not the same memory.
  void apply(std::span<const double> pressure, std::span<double> displacement) const;

  /// [m^2] load = 2 pi integral p r dr = sum of load_weights * pressure.
  const Eigen::ArrayXd& load_weights() const { return load_weights_; }

 private:
  Eigen::ArrayXd radii_;      // [m]
  double effective_modulus_;  // E* [Pa]
  Matrix matrix_;             // [m/Pa]
  Eigen::ArrayXd load_weights_;
};

}  // namespace tabor::elastic
