#pragma once

#include <array>

#include "tabor/core/types.hpp"
#include "tabor/material/lubricant.hpp"

// Balances the flow through the cells of a point contact.
namespace tabor::ehl {

/// Nodes that the balance of a cell depends on: itself, two upstream, one downstream, one to
/// either side.
struct PointOffset {
  Index x, y;
};
inline constexpr std::array<PointOffset, 6> kPointNeighbours{
    {{0, 0}, {-1, 0}, {-2, 0}, {1, 0}, {0, -1}, {0, 1}}};

/// A sparse matrix on a map: coefficient[k](j, i) multiplies the node at kPointNeighbours[k] from
/// (j, i).
struct PointStencil {
  std::array<Field, kPointNeighbours.size()> coefficient;

  PointStencil() = default;
  PointStencil(Index ny, Index nx) { coefficient.fill(Field::Zero(ny, nx)); }
  /// y += this x, on inner nodes.
  void add_product(const Field& x, Field& y) const;
};

/// Units of the unknowns, which make them numbers of order one.
struct PointUnits {
  double pressure = 1;  ///< [Pa]
  double film = 1;      ///< [m]
  double load = 1;      ///< [N]
};

/// An implicit Euler step of the film; none for a steady one.
struct PointStorage {
  double time_step = 0;  ///< [s], 0: steady
  Field old_mass = {};   ///< rho/rho0 h [m] a step ago
};

/// What flows out of each cell beyond what flows in, over u_m, the unit of film and the width of
/// the cell, and its derivatives by pressures and films in their units. Border nodes have none.
struct PointBalance {
  Field residual;
  PointStencil by_pressure, by_film;
};

/// What the balances are made of. Arrays have shape (ny, nx).
struct PointFlow {
  const Grid& grid;
  const material::Lubricant& lubricant;
  double speed = 0;          ///< u_m [m/s], > 0
  double sliding_speed = 0;  ///< [m/s]
  const Field& pressure;     ///< [Pa]
  const Field& film;         ///< [m], > 0
};

/// Finite volumes: every face has one flow, shared by its two cells, so mass is conserved to
/// round-off. Along x the walls carry rho h at the face, extrapolated from two nodes upstream
/// (second order; Venner & Lubrecht, Multilevel Methods in Lubrication, 2000, section 6.2), held
/// positive where the film drops abruptly; pressure drives the flow of reynolds::face_flow(),
/// through the viscosities along and across the sliding direction.
PointBalance point_balance(const PointFlow& flow, const PointStorage& storage,
                           const PointUnits& units);

}  // namespace tabor::ehl
