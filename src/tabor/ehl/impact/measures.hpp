#pragma once

#include "tabor/ehl/impact/impact.hpp"

// Measures an impact: extrema of its history, and the dimensionless groups.
namespace tabor::ehl {

/// Fills the scalars of a result from its history: maxima and minima by a parabola through three
/// instants, crossings by a straight line.
void measure(const ImpactProblem& problem, ImpactResult& result);

double highest_pressure(const ImpactResult& result);  ///< [Pa] anywhere, at any time

/// The seven groups of Larsson & Höglund 1994 (Journal of Tribology 116, 770) and its results; NaN
/// where there is none.
struct ImpactGroups {
  double layer = 0;             ///< H00 = h00 / R
  double speed = 0;             ///< V0 = eta0 v / (E' R), E' = 2 E*
  double mass = 0;              ///< M = m E' / (R eta0^2)
  double material = 0;          ///< G = alpha E'
  double force = 0;             ///< W = w / (E' R^2)
  double primary_pressure = 0;  ///< Pcl = p / E'
  double min_film = 0;          ///< Hmin = h / R
  double delay = 0;             ///< dT/Tr: (t of h_min - t of w_max) / (t of the end - t of w_max)
};

ImpactGroups groups_of(const ImpactProblem& problem, const ImpactResult& result);

}  // namespace tabor::ehl
