#pragma once

#include <limits>

#include "tabor/contact/contact.hpp"

// Solves the contact of a surface with a rigid flat in which trapped pockets of liquid carry load.
namespace tabor::contact {

inline constexpr double kIncompressible = std::numeric_limits<double>::infinity();

/// Liquid in the gap before it is closed.
struct GapLiquid {
  const Field& film;            ///< [m], shape (ny, nx), >= 0
  double bulk_modulus = 1.5e9;  ///< K [Pa], > 0; kIncompressible allowed
  bool periodic = true;         ///< opposite borders of the map are neighbours
};

/// Numbers of the liquid in a contact.
struct LiquidSummary {
  Index n_pockets = 0;         ///< closed pockets that hold liquid
  Index n_squeezed = 0;        ///< of these, with pressure in the liquid that is left
  Index n_at_seal = 0;         ///< of these, at the pressure that opens their seal: they leak
  double load_share = 0;       ///< load that the liquid carries / load
  double max_pressure = 0;     ///< [Pa], largest liquid pressure
  double pocket_volume = 0;    ///< [m^3], liquid in pockets before closing
  double open_volume = 0;      ///< [m^3], liquid with a way out before closing
  double leaked_volume = 0;    ///< [m^3] at no pressure, that left the pockets
  double leaked_fraction = 0;  ///< leaked_volume / pocket_volume; 0 without pockets
  int seal_rounds = 0;         ///< solutions until no seal had to be lowered
  bool seals_settled = true;   ///< false: rounds ran out
};

/// A contact with pressure in its pockets of liquid.
struct TrappedState {
  State contact;  ///< pressure [Pa] of solids and liquid together; gap [m] >= 0 over pockets
  Field liquid_pressure;  ///< [Pa], pi of the pocket on its pixels, 0 outside pockets
  LiquidSummary liquid;
};

/// Solves the contact in which liquid that is trapped in closed pockets of the gap carries load.
/// The pressure p of solids and liquid, and the pressure pi_k of the liquid in each pocket B_k of
/// volume V_k, minimise
///
///     1/2 <p, S p> - <p, h> + sum_k [ V_k pi_k^2/(2 K) - V_k pi_k ]
///     0 <= p <= p_sat, mean p = P, pi_k <= p on B_k, 0 <= pi_k <= seal_k:
///
/// one convex problem whose optimality is the physics: solids touch where p > pi_k; the gap over
/// B_k holds V_k (1 - pi_k/K), or more and pi_k = 0, or less and pi_k = seal_k, and the rest has
/// leaked. Pockets are found in `dry`, the solution of the same problem without liquid; seals
/// first there, and where pi_k exceeds the seal of a solution its bound is lowered and the problem
/// is solved again. The certificate is the duality gap over P, the length scale of the contact and
/// its pixels, as without liquid (docs/trapped_liquid.md). Where no pocket is squeezed the state is
/// `dry`, to the bit. Throws InputError for invalid input and a given separation; not converging is
/// returned, and so is being stopped.
TrappedState solve_trapped(elastic::ElasticOperator& elasticity, const Problem& problem,
                           const GapLiquid& liquid, const State& dry,
                           const Observer& observer = {});

/// True where solids touch: where the pressure exceeds that of the liquid beside it.
Mask solid_contact(const TrappedState& state);

/// Summarises the contact of the solids alone, as summarise(). The state is changed while this
/// runs, and as before afterwards.
Summary summarise_solids(TrappedState& state, const Problem& problem, const Grid& grid,
                         bool periodic);

}  // namespace tabor::contact
