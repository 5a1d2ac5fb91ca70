#pragma once

#include <vector>

#include "tabor/forming/friction_table.hpp"

// Fits the friction law "modified Darmstad" of OpenRadioss to a friction table.
namespace tabor::forming {

/// Friction law that OpenRadioss calls modified Darmstad, Ifric = 2 (OpenRadioss Reference Guide,
/// /FRICTION), over pressure p and sliding speed v:
///   mu = constant + c1 e^(c2 v) p^2 + c3 e^(c4 v) p + c5 e^(c6 v)
struct DarmstadLaw {
  double constant = 0;  ///< the card's Fric
  double c1 = 0;        ///< [1/Pa^2]
  double c2 = 0;        ///< [s/m]
  double c3 = 0;        ///< [1/Pa]
  double c4 = 0;        ///< [s/m]
  double c5 = 0;
  double c6 = 0;  ///< [s/m]

  /// Returns the friction at a pressure [Pa] and a speed [m/s].
  double friction(double mean_pressure, double sliding_speed) const;
};

/// Law fitted to the numbers at one density.
struct DarmstadFit {
  double lubricant_density = 0;  ///< [kg/m^2]
  DarmstadLaw law;
  double largest_error = 0;  ///< of friction, over these numbers
};

/// Fits the law by least squares. c2, c4, c6 are 0 or so far below that a term has fallen to 1/e at
/// the largest speed: beyond it the term changes by less than 0.6 times what it changes up to
/// there. They are 0 where there is one speed alone, and equal where there are no more numbers than
/// the seven unknowns. There is no c1 for fewer than three pressures. Throws InputError for a layer
/// with one pressure.
DarmstadFit fit_darmstad(const DensityLayer& layer);

/// Fits one law for each density of the table.
std::vector<DarmstadFit> fit_darmstad(const FrictionTable& table);

}  // namespace tabor::forming
