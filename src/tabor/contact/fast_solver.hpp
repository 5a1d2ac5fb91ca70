#pragma once

#include "tabor/contact/load_problem.hpp"

namespace tabor::contact {

/// Solves a contact by the preconditioned projected spectral gradient method: the fast solver
/// behind solve(). The problem must have passed solve()'s checks. State.gap and State.separation
/// are not set yet (see finish_state).
State solve_fast(elastic::ElasticOperator& elasticity, const LoadProblem& problem,
                 const Observer& observer);

}  // namespace tabor::contact
