#pragma once

#include "tabor/core/types.hpp"

namespace tabor::elastic {

/// A linear map from surface pressure to normal surface displacement of a half-space; symmetric and
/// positive semi-definite. The only virtual interface of the contact solvers.
class ElasticOperator {
 public:
  virtual ~ElasticOperator() = default;

  virtual const Grid& grid() const = 0;
  virtual double effective_modulus() const = 0;  ///< E* [Pa]

  /// displacement [m] = S pressure [Pa], both shape (ny, nx).
  virtual void apply(const Field& pressure, Field& displacement) = 0;

  /// The same in single precision, for increments; relative error about 1e-6 of the largest value.
  virtual void apply(const FieldF& pressure, FieldF& displacement) = 0;

  /// True if a uniform pressure displaces nothing (periodic half-space, mean mode dropped).
  virtual bool drops_mean() const = 0;

  virtual double fft_seconds() const = 0;  ///< time spent in transforms so far
};

}  // namespace tabor::elastic
