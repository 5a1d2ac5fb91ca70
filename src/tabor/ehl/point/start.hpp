#pragma once

#include <functional>
#include <optional>

#include "tabor/ehl/point/film.hpp"
#include "tabor/numerics/continuation.hpp"

// Finds a first film of a point contact, and the warnings of the last one.
namespace tabor::ehl {

/// The work of both, and what the second found.
PointFilm::Outcome operator+(const PointFilm::Outcome& before, PointFilm::Outcome now);

inline constexpr double kRoughly = 1e-2;  ///< tolerance where a solution is only a start

/// The problem on a grid of twice the spacing, to be solved roughly; none where that is too coarse.
std::optional<PointProblem> coarser(const PointProblem& problem);

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
