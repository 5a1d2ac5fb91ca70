#pragma once

#include <cstdint>
#include <vector>

#include "tabor/core/types.hpp"

/// Oil between a rough surface at rest and a smooth flat that slides along +x, on a patch that
/// repeats in x and y. docs/fluid_film.md has the equations.
namespace tabor::reynolds {

/// The gap and the liquid of one patch.
struct PatchProblem {
  Grid grid;
  Field gap;                      ///< h [m], shape (ny, nx); walls where it is <= thinnest_film
  Field viscosity_along = {};     ///< met by flow along x [Pa s]; empty: `viscosity`
  Field viscosity_across = {};    ///< met by flow along y
  double viscosity = 0;           ///< [Pa s], > 0
  double entrainment_speed = 0;   ///< u_m, half the sliding speed [m/s], >= 0
  double thinnest_film = 1e-9;    ///< [m]; a gap below it is closed to flow
  Mask reservoir = {};            ///< cells that are always full, at a given pressure; may be empty
  double reservoir_pressure = 0;  ///< [Pa]
  double vent_pressure = 101325;  ///< [Pa] at the widest place of a room, above which oil leaves
  double pressure_resolution = 0;  ///< [Pa]: smaller changes of the mean pressure do not matter
};

/// Where a cell's neighbours are; the patch wraps around.
struct Neighbours {
  Index left, right, up, down;
};

/// A patch in finite volumes. Flows are per area of a cell [m/s]: over the face to the right
///
///   carried(cell) * fill(cell) + conduct_x(cell) * (p(cell) - p(right))
///
/// and over the one below conduct_y(cell) * (p(cell) - p(below)). The gap at a face is the mean of
/// both cells': beside a contact, where it closes within a pixel, the two halves in series would
/// make the pressure a matter of how thin the last pixel happens to be.
struct PatchCells {
  Index nx = 0;
  Index ny = 0;
  Field gap;        ///< [m], 0 at walls
  Field conduct_x;  ///< [m/(s Pa)]
  Field conduct_y;
  Field carried;  ///< [m/s], of a full cell
  Mask reservoir;
  double reservoir_pressure = 0;
  double vent_pressure = 0;

  /// How many cells, walls too.
  Index size() const { return gap.size(); }
  /// Whether there is a gap, and not a wall.
  bool is_open(Index cell) const { return gap.data()[cell] > 0; }
  /// The four cells that share a face with this one; the patch is periodic.
  Neighbours around(Index cell) const;
};

/// Throws InputError for wrong shapes, NaN, invalid viscosities or speeds.
PatchCells patch_cells(const PatchProblem& problem);

/// The connected rooms of the gap.
struct Rooms {
  std::vector<std::int32_t> of;      ///< of each cell, from 0; -1 at walls
  std::vector<std::int32_t> widest;  ///< cell of each room, where the gap is largest

  /// How many rooms.
  Index count() const { return static_cast<Index>(widest.size()); }
};

/// Finds the rooms: cells with a gap that are connected by faces.
Rooms rooms_of(const PatchCells& cells);

}  // namespace tabor::reynolds
