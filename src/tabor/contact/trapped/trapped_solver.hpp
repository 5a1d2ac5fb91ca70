#pragma once

#include <vector>

#include "tabor/contact/load_problem.hpp"
#include "tabor/contact/trapped/iterate.hpp"

// Solves the contact with given pockets of liquid and given seals.
namespace tabor::contact {

/// Contact with liquid: the state, and the pressure of each pocket.
struct SealedState {
  State contact;  ///< pressure of solids and liquid; gap and separation are of the last residual
  std::vector<double> levels;  ///< pi_k [Pa]
  bool is_start = false;       ///< what it started from is the solution already
};

/// Minimises the energy of liquid_energy.hpp by a projected gradient in two metrics: pixels of
/// solid contact move along the direction of the fast solver (Preconditioner, LongWaves), those at
/// the level of a pocket's liquid by the stiffness of a piston on its area,
/// t_k = 3 pi^(3/2) E*/(16 sqrt(area)). A share of the last step is added, so that both are
/// conjugate. The step is projected by Pouring and shortened to the minimum of the energy along it.
/// `start`: a state of the same load with these levels [Pa], whose
/// seals may have been higher. Not reaching the tolerance is returned, and so is being stopped.
SealedState solve_sealed(elastic::ElasticOperator& elasticity, const LoadProblem& problem,
                         const SealedPockets& liquid, const State& start,
                         const std::vector<double>& levels, const Observer& observer);

}  // namespace tabor::contact
