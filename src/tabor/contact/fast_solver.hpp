#pragma once

#include "tabor/contact/contact.hpp"

namespace tabor::contact {

/// The fast solver behind solve(): preconditioned projected spectral gradient. The problem must
/// have passed solve()'s checks. State.gap and State.separation are not set yet (see finish_state).
State solve_fast(elastic::ElasticOperator& elasticity, const Problem& problem,
                 const Observer& observer);

}  // namespace tabor::contact
