#pragma once

#include <vector>

#include "tabor/ehl/point/point.hpp"

// Measures a film of a point contact: thickness, shares of load and area, friction.
namespace tabor::ehl {

/// What a user reads about a film. Shares of an area count nodes. Solids touch where no film is
/// left and where they flow: bonds of P_plast/6 leave no film there, whatever its thickness.
struct PointMeasures {
  double hertz_radius = 0;         ///< [m], geometric mean of the half axes
  double hertz_pressure = 0;       ///< [Pa]
  double central_film = 0;         ///< [m], film_at_centre, or mean_central_film with a roughness
  double mean_central_film = 0;    ///< [m], mean over the disc of 2a/3 (Hu & Zhu 2000)
  double film_at_centre = 0;       ///< [m] at the node nearest to (0, 0)
  double min_film = 0;             ///< [m]
  double max_pressure = 0;         ///< [Pa], of liquid and solid together
  double contact_load_share = 0;   ///< of what touching solids carry in the load
  double boundary_load_share = 0;  ///< of those that touch without flowing
  double solid_contact_fraction = 0;  ///< share of the Hertz area where solids touch
  double plastic_fraction = 0;        ///< share of the Hertz area with plastic_depth > 0
  double max_plastic_depth = 0;       ///< [m]
  double fluid_volume = 0;            ///< [m^3] of film over the Hertz area
  double friction_fluid = 0;          ///< shear of the film over load
  /// P_plast/6 on the plastic area and that of asperities elsewhere, over load; 0 where nothing
  /// slides, NaN where `asperities` does not say how what touches rubs.
  double friction_solid = 0;
  double friction_coefficient = 0;  ///< their sum
  double max_shear_stress = 0;      ///< [Pa] of the film
};

/// The film is sheared where it carries pressure and no solid touches or flows plastically; there
/// bonds of strength P_plast/6 are sheared instead, a sixth of the hardness (Redlich, Bartel &
/// Deters 2003, doi:10.1016/S0167-8922(03)80083-8, section 4.2).
PointMeasures measure_point(const PointProblem& problem, const PointResult& result);

/// True where solids touch, as PointMeasures counts it.
Mask touching_nodes(const PointResult& result);

/// Slice-plane graph (Redlich, Bartel & Deters 2003, fig. 10): share of the Hertz area where solids
/// touch or film <= level, for each level [m]. At level 0 it is the solid contact.
std::vector<double> slice_plane(const PointProblem& problem, const PointResult& result,
                                const std::vector<double>& levels);

/// True at the nodes of an ellipse with `scale` times the half axes of Hertz' dry contact.
Mask hertz_area(const PointProblem& problem, double scale = 1);

}  // namespace tabor::ehl
