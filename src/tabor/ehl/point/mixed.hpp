#pragma once

#include "tabor/ehl/point/point.hpp"

namespace tabor::ehl {

/// A film whose solids may touch and flow plastically (PointFilm). From `start`, a result on any
/// grid, if there is one; where that fails, from smooth bodies at a speed whose film is thicker
/// than the roughness, which is raised before the speed is lowered. solve_point() calls this where
/// it is needed.
PointResult solve_point_mixed(const PointProblem& problem, const PointResult* start = nullptr,
                              const Observer& observer = {});

}  // namespace tabor::ehl
