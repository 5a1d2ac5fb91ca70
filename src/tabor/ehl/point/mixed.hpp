#pragma once

#include "tabor/ehl/point/point.hpp"

namespace tabor::ehl {

/// A film whose solids may touch and flow plastically (PointFilm). From `start`, a result on any
/// grid, if there is one; where that fails, at a speed whose film is about as thick as the
/// roughness is high, through coarser grids or from smooth bodies whose roughness is raised, and
/// then at lower speeds down to that of the problem. solve_point() calls this where it is needed.
PointResult solve_point_mixed(const PointProblem& problem, const PointResult* start = nullptr,
                              const Observer& observer = {});

}  // namespace tabor::ehl
