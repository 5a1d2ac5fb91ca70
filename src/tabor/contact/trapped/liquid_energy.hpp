#pragma once

#include <vector>

#include "tabor/contact/trapped/pockets.hpp"

// Computes the energy of trapped liquid, and a bound on that of the whole contact.
namespace tabor::contact {

/// The contact with trapped liquid, minimise over pressures p and levels pi
///
///     1/2 <p, S p> - <p, h> + sum_k [ V_k pi_k^2/(2 K) - V_k pi_k ]
///     0 <= p <= p_sat, mean p = P, pi_k <= p on pocket k, 0 <= pi_k <= seal_k.
class LiquidEnergy {
 public:
  /// `bulk_modulus` K, `cap` p_sat [Pa] may be infinite; `load` is the sum of pressures [Pa].
  LiquidEnergy(const Pockets& pockets, double bulk_modulus, double cap, double load)
      : pockets_(pockets), bulk_modulus_(bulk_modulus), cap_(cap), load_(load) {}

  /// Returns the level that is best for given pressures: the lowest pressure of the pocket, within
  /// its seal and K [Pa].
  std::vector<double> best_levels(const Field& pressure, const std::vector<double>& seals) const;

  /// Returns the energy of the liquid, sum_k of the bracket [Pa m].
  double of_liquid(const std::vector<double>& levels) const;

  /// Returns the duality gap of pressures p that carry the load and levels, for the multiplier
  /// lambda [m] of the load, v = S p - h: it bounds the error of the energy from above, whatever
  /// lambda [Pa m],
  ///
  ///     G = <p, r> + sum phi_k - p_sat sum min(r, 0)
  ///         - sum_k min_{0 <= m <= seal_k} ( m (sum_k max(r, 0) - V_k) + V_k m^2/(2K) ),  r = v -
  ///         lambda.
  ///
  /// `near`: all pixels outside pockets with pressure or an r below zero, and any others. Infinite
  /// where lambda bounds nothing: an r below zero without a cap.
  double duality_gap(const Field& pressure, const Field& v, const PixelList& near, double lambda,
                     const std::vector<double>& levels, const std::vector<double>& seals) const;

 private:
  double most(std::size_t pocket, double seal) const;

  const Pockets& pockets_;
  double bulk_modulus_;
  double cap_;
  double load_;
};

}  // namespace tabor::contact
