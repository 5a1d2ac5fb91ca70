#pragma once

#include <Eigen/Core>

#include "tabor/core/types.hpp"
#include "tabor/material/lubricant.hpp"

/// Reynolds' equation in one dimension by finite volumes, along a line or along the radius of a
/// disc:
///
///   1/w d/dx( w m ) + d(rho theta h)/dt = 0 ,  m = u rho theta h - rho h^3/(12 eta) dp/dx
///
/// with w = 1 (line) or 2 pi r (disc), the mean speed u of the walls and the fill theta (1 where
/// the gap is full). Every face has one flow, shared by its two cells, so mass is conserved to
/// round-off.
namespace tabor::reynolds {

enum class FilmShape { line, disc };

/// Grid of n cells between two boundary nodes: nodes 0 and n + 1 carry given pressures, node i lies
/// in cell i - 1, whose faces are i - 1 and i.
struct FilmGrid {
  FilmShape shape = FilmShape::line;
  Eigen::ArrayXd node;    ///< [m], n + 2, ascending
  Eigen::ArrayXd face;    ///< [m], n + 1
  Eigen::ArrayXd width;   ///< of faces: 1 (per unit length) or 2 pi r [m], n + 1
  Eigen::ArrayXd volume;  ///< of cells, per height: dx [m] or pi (r2^2 - r1^2) [m^2], n

  Index n_cells() const { return volume.size(); }
};

/// Makes n equal cells from begin to end, nodes in their centres. Throws InputError unless begin <
/// end and n >= 2.
FilmGrid line_grid(double begin, double end, Index n);

/// Makes nodes at 0, dr, .., (n - 1) dr, and the boundary node at radius = n dr; faces in the
/// middle, so the cell in the centre is half as wide. Nothing flows through the centre: the
/// boundary node 0 lies there too, and its pressure is not used. Throws InputError unless radius >
/// 0 and n >= 2.
FilmGrid disc_grid(double radius, Index n);

/// Liquid at one pressure, with its derivatives by pressure.
struct LiquidState {
  double density = 1;          ///< rho [kg/m^3]; 1 for flows by volume
  double density_slope = 0;    ///< [kg/(m^3 Pa)]
  double viscosity = 0;        ///< eta [Pa s], > 0
  double viscosity_slope = 0;  ///< [s]
};

/// Returns the liquid at one pressure [Pa]. density: rho0 [kg/m^3], 1 for flows by volume.
LiquidState liquid_at(const material::Lubricant& lubricant, double pressure, double density = 1);
/// Returns the liquid at node i of evaluated laws, for flows by volume.
LiquidState liquid_at(const material::NodeLaws& laws, Index i);

/// Returns a liquid of one viscosity [Pa s] and density.
material::Lubricant constant_liquid(double viscosity);

/// Values at one of the two nodes of a face, on which the flow through it depends.
struct FilmNode {
  double pressure = 0;  ///< p [Pa]
  double film = 0;      ///< h [m], > 0
  double fill = 1;      ///< theta, 0..1
  LiquidState liquid;
  double distance = 0;           ///< from the node to the face [m]
  double viscosity_by_film = 0;  ///< [Pa s/m] at the same pressure: shear thinning
};

/// Mass flow per width through a face, in the direction of x, and its derivatives.
struct FaceFlow {
  double flow = 0;     ///< m [kg/(m s)]
  double couette = 0;  ///< its part carried by the walls at theta = 1
  double by_pressure[2] = {0, 0};
  double by_film[2] = {0, 0};
};

/// Computes the flow between two nodes. A step of the film at the face is treated exactly, a smooth
/// film to second order; a viscosity that grows exponentially with pressure (Barus) is exact as
/// well, however steep the front between the nodes. The fill is that of the node upstream.
FaceFlow face_flow(const FilmNode& left, const FilmNode& right, double speed);

}  // namespace tabor::reynolds
