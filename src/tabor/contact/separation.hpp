#pragma once

#include "tabor/contact/load_problem.hpp"

// Solves the contact with a flat at a given separation.
namespace tabor::contact {

/// Solves with the flat at this separation [m], on heights that do not lie far from zero: finds the
/// mean pressure, ln P by secants and bisection, first on coarser grids and to a rough certificate;
/// each solution starts from the one before. The state has exactly this separation, so that its
/// gap_error tells how far the pressure is from it. The mean pressure of the problem is not used.
State solve_separation(elastic::ElasticOperator& elasticity, const LoadProblem& problem,
                       double separation, Solver solver, const Observer& observer);

}  // namespace tabor::contact
