#pragma once

#include "tabor/contact/trapped/pockets.hpp"
#include "tabor/contact/trapped_liquid.hpp"

namespace tabor::contact {

/// As solve_trapped(), with given pockets in place of those of the dry contact.
TrappedState solve_in_pockets(elastic::ElasticOperator& elasticity, const Problem& problem,
                              const Pockets& pockets, const GapLiquid& liquid, const State& dry,
                              const Observer& observer = {});

}  // namespace tabor::contact
