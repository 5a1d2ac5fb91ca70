#pragma once

#include "tabor/ehl/impact/impact.hpp"
#include "tabor/ehl/line/line.hpp"
#include "tabor/ehl/point/point.hpp"

// The solvers without what makes them fast: tests find the same films, benchmarks say how much
// longer it takes.
namespace tabor::ehl {

/// As solve_impact(), with one factorization in each Newton iteration.
ImpactResult solve_impact_plainly(const ImpactProblem& problem);

/// As solve_line(), with a full matrix that is factorized in each Newton iteration.
LineResult solve_line_plainly(const LineProblem& problem);

/// As solve_point(), with sparse factors of the local equations in each Newton iteration; of smooth
/// bodies that do not touch.
PointResult solve_point_plainly(const PointProblem& problem);

}  // namespace tabor::ehl
