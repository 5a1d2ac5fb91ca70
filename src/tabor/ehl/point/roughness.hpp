#pragma once

#include "tabor/ehl/point/point.hpp"

// Puts bumps and maps of heights onto the nodes of a point contact.
namespace tabor::ehl {

/// Heights s [m] at the nodes, asperities up: one round bump in the middle of rings,
/// height 10^(-10 r^2/lambda^2) cos(2 pi r/lambda) (Redlich, Bartel & Deters 2003, eq. 1), its top
/// at (centre_x, centre_y) [m]. Throws InputError if the grid has less than 8 nodes in a wavelength
/// lambda.
Field point_bump(const PointProblem& problem, double height, double wavelength, double centre_x = 0,
                 double centre_y = 0);

/// A measured or generated surface: heights on a regular grid, row 0 at the smallest y.
struct PointMap {
  Field height;          ///< [m], asperities up, levelled by the caller
  double spacing_x = 0;  ///< [m]
  double spacing_y = 0;  ///< [m]
  double centre_x = 0;   ///< [m] where the middle of the map lies
  double centre_y = 0;   ///< [m]
};

/// How far beyond the Hertz ellipse, in its half axes from its centre, a map must reach.
inline constexpr double kMapReach = 1.25;

/// Heights s [m] at the nodes, between points of the map by cubic convolution (Keys 1981,
/// doi:10.1109/TASSP.1981.1163711), which keeps more of the short waves than straight lines; where
/// the map is finer than the nodes, means over their cells, so that waves shorter than two nodes do
/// not pass for longer ones. Toward the map's border, in the outer fifth of the way there from its
/// centre, heights go to zero as a squared cosine; beyond it the surface is smooth. A centred map
/// that is just large enough is so left whole in the Hertz ellipse. Throws InputError for holes and
/// for a map that does not reach kMapReach half axes from the centre of the contact on every side.
Field point_map(const PointProblem& problem, const PointMap& map);

}  // namespace tabor::ehl
