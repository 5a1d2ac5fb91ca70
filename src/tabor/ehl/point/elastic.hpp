#pragma once

#include <memory>

#include "tabor/core/types.hpp"
#include "tabor/elastic/half_space.hpp"

namespace tabor::ehl {

/// The half-space under the nodes of a film: elastic::make_free on a grid that is a little larger
/// where that makes the transforms fast. Not safe for concurrent calls.
class PointElastic {
 public:
  /// `unit`: of pressures over that of displacements; 1 for [Pa] and [m].
  PointElastic(const Grid& film, double effective_modulus, double unit);

  /// Displacement by pressures on all nodes, in their units.
  Field operator()(const Field& pressure) const;
  /// Displacement (dy, dx) nodes away from one with the pressure 1.
  double influence(Index dy, Index dx) const;
  /// The same for a pressure 1 at that node and -1/4 at each of its four neighbours: decays as
  /// 1/distance^3, where a single pressure's decays as 1/distance.
  double dipole_influence(Index dy, Index dx) const;

 private:
  Grid film_;
  double effective_modulus_, unit_;
  std::unique_ptr<elastic::ElasticOperator> space_;
};

}  // namespace tabor::ehl
