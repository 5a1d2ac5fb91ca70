#pragma once

#include <functional>

#include "tabor/ehl/point/film.hpp"
#include "tabor/numerics/continuation.hpp"

// Finds a first film of a point contact, and the warnings of the last one.
namespace tabor::ehl {

/// The work of both, and what the second found.
PointFilm::Outcome operator+(const PointFilm::Outcome& before, PointFilm::Outcome now);

inline constexpr double kRoughly = 1e-2;  ///< tolerance where a solution is only a start

/// The conditions of a film at the speeds of a problem and to its tolerance.
PointConditions conditions_of(const PointProblem& problem, const PointFilm& film);

/// Solves the film of a problem without a state to begin with.
using PointSolver = std::function<PointFilm::Outcome(const PointProblem&, const PointFilm&,
                                                     PointState&, const Observer&)>;

/// Solves the film of a problem from the film that `solve_coarse` finds on a grid of twice the
/// spacing; not converged where that grid would be too coarse.
PointFilm::Outcome solve_nested(const PointProblem& problem, const PointFilm& film,
                                const PointSolver& solve_coarse, PointState& state,
                                const Observer& observer = {});

/// A way from the conditions of a film at hand, share 0, to those asked for, share 1.
struct PointWay {
  std::function<PointConditions(double share)> conditions_at;
  numerics::ContinuationSteps steps = {};
};

/// Leads `state` to the end of the way; the films before the last are solved roughly.
PointFilm::Outcome follow(const PointFilm& film, const PointWay& way, PointState& state,
                          const Observer& observer = {});

/// Solves `film`, of smooth bodies, without a state to begin with: from Hertz' pressure on a coarse
/// grid, through grids of half the spacing each, to the grid of the film; where that fails, from
/// thicker and thinner first films, and from a viscosity that grows less with pressure.
PointFilm::Outcome solve_cold(const PointProblem& problem, const PointFilm& film, PointState& state,
                              const Observer& observer = {});

/// The state of a result, which may be of another grid.
PointState state_of(const PointFilm& film, const PointResult& result);

/// The result of a film without touching or plastic solids.
PointResult result_of(const PointProblem& problem, const PointFilm& film, const PointState& state,
                      const PointFilm::Outcome& outcome);

}  // namespace tabor::ehl
