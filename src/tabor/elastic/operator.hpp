#pragma once

#include <memory>

#include "tabor/core/types.hpp"
#include "tabor/elastic/border.hpp"

// Defines the interface of elastic operators.
namespace tabor::elastic {

/// A linear map from surface pressure to normal surface displacement of a half-space; symmetric and
/// positive semi-definite. The only virtual interface of the contact solvers.
class ElasticOperator {
 public:
  virtual ~ElasticOperator() = default;

  /// Shape of the maps that apply() takes.
  virtual const Grid& grid() const = 0;
  virtual double effective_modulus() const = 0;  ///< E* [Pa]

  /// Computes displacement [m] = S pressure [Pa], both of shape (ny, nx).
  virtual void apply(const Field& pressure, Field& displacement) = 0;

  /// Computes the same in single precision, for increments; relative error about 1e-6 of the
  /// largest value.
  virtual void apply(const FieldF& pressure, FieldF& displacement) = 0;

  /// Returns the same half-space sampled on another grid of the same extent (nested starts).
  virtual std::unique_ptr<ElasticOperator> on_grid(const Grid& grid) const = 0;

  /// Computes pressure = S^-1 displacement up to its mean, where that is one transform. Returns
  /// false where the operator has no such inverse (free half-space).
  virtual bool apply_inverse(const Field& displacement, Field& pressure) = 0;

  virtual Border border() const = 0;  ///< what lies beyond the map
  /// True if a uniform pressure displaces nothing: the mean mode of a half-space loaded everywhere
  /// is dropped.
  bool drops_mean() const { return border() != Border::ends; }

  /// Returns the operator of the first quarter of maps that consist of 2 x 2 mirror images, made at
  /// the first call; null where there is none. It belongs to this one, and its transforms count as
  /// this one's.
  virtual ElasticOperator* of_image() { return nullptr; }

  /// Gives back what apply() holds for its next call.
  virtual void free_memory() {}

  virtual double fft_seconds() const = 0;  ///< time spent in transforms so far
};

}  // namespace tabor::elastic
