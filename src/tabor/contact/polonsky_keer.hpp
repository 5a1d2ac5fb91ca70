#pragma once

#include "tabor/contact/load_problem.hpp"

namespace tabor::contact {

/// Solves a contact by conjugate gradients on the contact set with restarts: the textbook baseline
/// behind solve() (Polonsky & Keer 1999, doi:10.1016/S0043-1648(99)00113-1), a pressure cap by
/// clipping (Almqvist et al. 2007, doi:10.1016/j.triboint.2005.11.008) and two operator
/// applications an iteration, all in double precision. Checks, certificate and load projection are
/// those of the fast solver.
State solve_polonsky_keer(elastic::ElasticOperator& elasticity, const LoadProblem& problem,
                          const Observer& observer);

}  // namespace tabor::contact
