#pragma once

#include <cstdint>
#include <vector>

#include "tabor/core/types.hpp"

/// Divides the gap between a rough surface at rest and a smooth flat that slides along +x into
/// finite volumes, on a patch that repeats in x and y. docs/fluid_film.md has the equations.
namespace tabor::reynolds {

/// Gap and liquid of one patch.
struct PatchProblem {
  Grid grid;
  Field gap;                    ///< h [m], shape (ny, nx); solid cells where it is <= thinnest_film
  Field viscosity_along = {};   ///< met by flow along x [Pa s]; empty: `viscosity`
  Field viscosity_across = {};  ///< met by flow along y
  double viscosity = 0;         ///< [Pa s], > 0
  double entrainment_speed = 0;   ///< u_m, half the sliding speed [m/s], >= 0
  double thinnest_film = 1e-9;    ///< [m]; a gap below it is closed to flow
  Mask reservoir = {};            ///< cells that are always full, at a given pressure; may be empty
  double reservoir_pressure = 0;  ///< [Pa]
  double vent_pressure = 101325;  ///< [Pa] at the widest place of a component; oil leaves above
  double pressure_resolution = 0;  ///< [Pa]: smaller changes of the mean pressure do not matter
};

/// Indices of a cell's neighbours; the patch wraps around.
struct Neighbours {
  Index left, right, up, down;
};

/// Patch in finite volumes. Flows are per area of a cell [m/s]: over the face to the right
///
///   carried(cell) * fill(cell) + conduct_x(cell) * (p(cell) - p(right))
///
/// and over the one below conduct_y(cell) * (p(cell) - p(below)). The gap at a face is the mean of
/// both cells': beside a contact, where it closes within a pixel, the two halves in series would
/// make the pressure a matter of how thin the last pixel happens to be.
struct PatchCells {
  Index nx = 0;
  Index ny = 0;
  Field gap;        ///< [m], 0 at solid cells
  Field conduct_x;  ///< [m/(s Pa)]
  Field conduct_y;
  Field carried;  ///< [m/s], of a full cell
  Mask reservoir;
  double reservoir_pressure = 0;
  double vent_pressure = 0;

  /// Returns the number of cells, solid cells included.
  Index size() const { return gap.size(); }
  /// True where there is a gap; false for a solid cell.
  bool is_open(Index cell) const { return gap.data()[cell] > 0; }
  /// Returns the four cells that share a face with this one; the patch is periodic.
  Neighbours around(Index cell) const;
};

/// Divides a patch into cells. Throws InputError for wrong shapes, NaN, invalid viscosities or
/// speeds.
PatchCells patch_cells(const PatchProblem& problem);

/// Connected components of the gap.
struct Components {
  std::vector<std::int32_t> of;      ///< of each cell, from 0; -1 at solid cells
  std::vector<std::int32_t> widest;  ///< cell of each component with the largest gap

  /// Returns the number of components.
  Index count() const { return static_cast<Index>(widest.size()); }
};

/// Finds the connected components: cells with a gap that are connected by faces.
Components components_of(const PatchCells& cells);

}  // namespace tabor::reynolds
