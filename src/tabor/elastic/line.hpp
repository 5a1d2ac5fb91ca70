#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>

#include "tabor/elastic/operator.hpp"
#include "tabor/elastic/pressure_shape.hpp"
#include "tabor/spectral/fft.hpp"

// Computes the displacement of an elastic half-space in plane strain under a pressure profile along
// x.
namespace tabor::elastic {

/// Plane-strain half-space under a pressure that varies along x only, at n nodes `spacing` apart:
///
///   u(x) = -(2 / (pi E*)) integral p(x') ln(|x - x'| / datum) dx'     (Johnson 1985, section 2.4)
///
/// A line load displaces all points within any distance infinitely, so u is relative: a line force
/// displaces nothing at the distance `datum`, the length of the profile. Symmetric and positive
/// definite. This is no ElasticOperator, because profiles are plain vectors and their solvers need
/// coefficients (rows of a Jacobian) beside products; make_line() is one, for the contact solvers.
class LineHalfSpace {
 public:
  /// Prepares the transforms. n_nodes >= 3, spacing [m] > 0, effective_modulus E* [Pa] > 0, else
  /// throws InputError.
  LineHalfSpace(Index n_nodes, double spacing, double effective_modulus,
                PressureShape shape = PressureShape::uniform);

  Index size() const { return n_nodes_; }
  double spacing() const { return spacing_; }                                ///< [m]
  double effective_modulus() const { return effective_modulus_; }            ///< E* [Pa]
  double datum() const { return spacing_ * static_cast<double>(n_nodes_); }  ///< [m]

  /// [m/Pa] displacement of the node `offset` nodes away from a unit pressure at one node.
  double influence(Index offset) const;
  /// [m/Pa] influence(offset - 1) - 2 influence(offset) + influence(offset + 1): decays as
  /// 1 / offset^2 and does not know the datum (Evans & Hughes 2000, Proceedings of the
  /// Institution of Mechanical Engineers C 214, 563).
  double second_difference(Index offset) const;

  /// Returns all coefficients, shape (n, n) [m/Pa]: u = matrix p.
  Eigen::MatrixXd matrix() const;
  /// Returns the matrix of the same displacement in differential form: rows 0 and n - 1 give u
  /// there, row i in between u_(i-1) - 2 u_i + u_(i+1). Its large coefficients lie near the
  /// diagonal.
  Eigen::MatrixXd differential_matrix() const;

  /// Computes displacement [m] = matrix pressure [Pa], by transforms: O(n log n). Spans of n
  /// values.
  void apply(std::span<const double> pressure, std::span<double> displacement) const;
  /// Computes differences [m] = differential_matrix pressure, by transforms.
  void apply_differential(std::span<const double> pressure, std::span<double> differences) const;

  /// [m] Weights of the load per width: load = sum of weight p = load_weight() * sum of p.
  double load_weight() const { return spacing_; }

 private:
  void convolve(std::span<const double> pressure, const Eigen::ArrayXd& spectrum,
                std::span<double> result) const;
  template <typename Coefficient>
  Eigen::ArrayXd spectrum_of(const Coefficient& coefficient) const;

  Index n_nodes_;
  double spacing_;            // [m]
  double effective_modulus_;  // E* [Pa]
  PressureShape shape_;
  spectral::RealFft2d<double> transform_;  // one row, padded against wrapping round
  Eigen::ArrayXd spectrum_;                // of influence() [m/Pa]
  Eigen::ArrayXd difference_spectrum_;     // of second_difference() [m/Pa]
};

/// Computes displacement[i] [m] from the values of apply_differential(): sums them up between the
/// exact ends. Spans of the same length, which may be the same memory.
void displacement_from_differences(std::span<const double> differences,
                                   std::span<double> displacement);

/// Makes the same half-space, with pressure uniform around each node, for the contact solvers: maps
/// of one row. Throws InputError for a grid of more than one row, or as LineHalfSpace.
std::unique_ptr<ElasticOperator> make_line(const Grid& grid, double effective_modulus);

}  // namespace tabor::elastic
